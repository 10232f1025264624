#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "remote/polling.h"
#include "remote/wire_generated.h"
#include "world/external/rig.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::remote {

class FrameChannel;

/// The driver's end of the wire, for drivers in C++: examples/pid_driver.cpp is one.
///
///     remote::Client run;                       // finds the run that started this program
///     while (const auto tick = run.next())
///         run.say({.throttle = 0.4});
class Client {
  public:
    /// What a driver says; see world.Control for units and ranges.
    struct Wheel {
        double throttle = 0;
        double brake = 0;
        double steer = 0;
        bool hand_brake = false;
        bool reverse = false;
        std::uint16_t lamps = 0;
    };

    /// Connects, and waits for the run's hello. `address` is a socket's path or HOST:PORT, or what
    /// the variable REPRISE_DRIVER says where it is empty. Throws world::Error, also when the place
    /// is taken.
    /// `polling`: [s] for so long it looks again and again for each tick before it sleeps, and the
    /// run need not wake it; less often where somebody else wants its processor. 0: it always
    /// sleeps; see docs/drivers.md.
    explicit Client(const std::string& address = {}, double polling = usual_polling);

    /// Of a connection that is open: waits for hello.
    explicit Client(FrameChannel channel, double polling = usual_polling);
    ~Client();
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    std::uint32_t actor() const;      ///< whom it drives: id in the ticks
    const std::string& name() const;  ///< the same, as the scenario calls it
    double step() const;              ///< [s] of simulated time between ticks
    const world::TownT& town() const;
    const world::EpisodeT& episode() const;  ///< without the script's text

    /// Of a driver that takes over: the scenario's set_route with the stops that are left. Later
    /// ones are in the ticks.
    const std::optional<world::CommandT>& route() const;

    /// The next tick; nothing when the run is over. It lives until the next call. Throws
    /// world::Error when the run is gone without a word, or says what went wrong.
    std::optional<world::TickView> next();

    /// Ticks since the one before, of a driver that is shown each few only: what was said and what
    /// happened in them. In their order; they live as long as the last tick.
    std::vector<const world::Tick*> passed() const;

    /// How the run ended, once next() gave nothing.
    const world::Outcome& outcome() const;

    /// What the vehicle carries; empty without a rig.
    const world::SensorRig& sensors() const;

    /// A frame: `pixels` as world/external/sensor.h has them, in memory that the renderer writes
    /// into. They stay until the answer to the tick after theirs.
    struct Picture {
        const world::SensorSpec* sensor = nullptr;
        std::span<const std::uint8_t> pixels;
    };

    /// What a camera saw at the last tick; nothing when it was not due. Throws world::Error for a
    /// sensor that the vehicle does not carry, or that is no camera.
    std::optional<Picture> picture(std::string_view sensor) const;

    /// What a sensor measured that is no camera: rows as world/external/point_fields.h has them,
    /// which stay as pixels do.
    struct Rows {
        const world::SensorSpec* sensor = nullptr;
        std::size_t count = 0;
        std::span<const std::uint8_t> bytes;

        /// A number of a row, by its column.
        double at(std::size_t row, std::size_t column) const;
    };

    /// At the last tick; nothing when it was not due. Throws world::Error for a sensor that the
    /// vehicle does not carry, or that is a camera.
    std::optional<Rows> rows(std::string_view sensor) const;

    /// The way to the goal that the scenario gave, as the planner of the CARLA paper says it.
    struct Way {
        Turning turning = Turning::none;  ///< at the next junction; none: no goal was given
        double to_goal = 0;               ///< [m] along the shortest way
    };

    /// At the last tick.
    Way way() const;

    /// The answer to the last tick: from the next one on.
    void say(const Wheel& wheel);

    /// In place of it: ends the run, which is nobody's failure (verdict ended).
    void leave(const std::string& reason);

  private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace reprise::remote
