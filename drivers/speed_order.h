#pragma once

#include <cstdint>
#include <optional>

#include "world/digest.h"
#include "world/transition.h"
#include "world/units.h"

namespace reprise::drivers {

/// What a scenario told a driver about its speed. The later word wins.
class SpeedOrder {
  public:
    /// What is wanted over a tick.
    struct Wish {
        double speed = world::infinity;  ///< [m/s] at its begin
        double acceleration = 0;         ///< [m/s^2] over it
    };

    /// The driver's own choice again.
    void free() { *this = {}; }

    /// Likewise where it holds or brakes; a cap stays.
    void end_hold();
    void end_brake();

    /// No faster than that, from now on or reached evenly in `change.duration`, its `to`. Negative
    /// is 0.
    void cap(world::Transition change);

    /// Exactly that, whatever comes. Without a duration as fast as the driver likes.
    void hold(world::Transition change);

    /// At so many m/s^2 until it stands, and then it stands.
    void brake(double deceleration);

    /// Is it told a speed to keep to, whoever is in the way?
    bool reacts_to_nothing() const { return kind_ == Kind::hold || kind_ == Kind::brake; }

    bool brakes() const { return kind_ == Kind::brake; }

    /// Does its speed change by a profile in this tick?
    bool is_changing(std::uint64_t tick, double step) const;

    /// [m/s] where it ends; infinity where nothing is said.
    double target() const;

    /// What was said since the last tick begins at this speed.
    void begin(std::uint64_t tick, double speed, double step);

    /// For the tick after this one. `step` [s]
    Wish wish(std::uint64_t tick, double step) const;

    void add_to(world::Hasher& hasher) const;

  private:
    enum class Kind : std::uint8_t { none, cap, hold, brake };

    double speed_after(double seconds) const;

    Kind kind_ = Kind::none;
    world::Transition change_;
    double deceleration_ = 0;
    bool has_begun_ = true;
    std::uint64_t start_ = 0;  ///< tick
};

}  // namespace reprise::drivers
