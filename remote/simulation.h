#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "remote/client.h"
#include "world/external/sensor.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::remote {

/// Where a task begins or ends.
struct Drawn {};  ///< by the seed

struct OnLane {
    std::string lane;  ///< for cars; the network's id
    double s = 10;     ///< [m] along it
};

struct AtSpawnPoint {
    std::uint32_t index = 0;  ///< in the town's spawn points, one for cars
};

using TaskPlace = std::variant<Drawn, OnLane, AtSpawnPoint>;

/// A sensor of a task's vehicle.
struct TaskCamera {
    world::SensorSpec sensor;
    std::uint32_t every = 0;  ///< [ticks] between frames; 0: in each tick that is shown
};

/// What an episode starts from: a task, unless a scenario is named. Equal plans give equal ticks.
struct EpisodePlan {
    std::string town = "town1";
    std::uint32_t cars = 0;
    std::uint32_t walkers = 0;                   ///< people on foot in the background
    std::optional<std::uint64_t> walker_seed{};  ///< who they are; without one: `seed`
    std::optional<std::uint64_t> seed{};         ///< without one: the scenario's own
    std::string weather = "clear_noon";
    std::string model = "sedan";
    TaskPlace start = Drawn{};
    std::optional<TaskPlace> goal{};  ///< none: it drives until the time is over
    std::vector<TaskCamera> rig{};
    std::uint32_t every = 1;  ///< [ticks] from one that is shown, and answered, to the next

    std::string file{};    ///< a scenario in the server's folder, in place of the task; or
    std::string source{};  ///< a scenario's text; it spawns 'ego' with driver = 'external'
    std::vector<std::pair<std::string, std::string>> settings{};  ///< of its parameters, as --set

    double seconds = 0;   ///< the limit; 0: the scenario's own, of a task two hours
    std::string trace{};  ///< a name in the server's folder, such as a.mcap; empty: none is written
};

/// Episodes that this program begins itself and drives the vehicle 'ego' in, in lockstep.
///
///     remote::Simulation sim({.folder = "runs"});
///     auto tick = sim.reset({.town = "town1", .cars = 100, .seed = 7});
///     while (tick)
///         tick = sim.step({.throttle = 0.4});
class Simulation {
  public:
    /// Who plays the episodes.
    struct Server {
        std::string address{};  ///< of a `reprise serve`, a socket's path or HOST:PORT; empty: one
                                ///< of our own, which ends with us
        std::string token{};    ///< where it wants one
        std::string folder = ".";  ///< of our own: where scenarios are, and traces go
        std::string program{};     ///< of our own; empty: what the variable REPRISE names, or the
                                   ///< first `reprise` in PATH
        double polling = usual_polling;  ///< [s] as of Client
    };

    /// Throws world::Error.
    explicit Simulation(const Server& server);

    Simulation() : Simulation(Server()) {}

    /// Leaves; an episode that runs ends.
    ~Simulation();
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Begins an episode, in place of one that runs: what its first tick shows; nothing where it
    /// ended in that tick. The tick lives until the next call. Throws world::Error for what cannot
    /// be, such as "my.lua:3: ..." for a mistake in the scenario; another reset may follow.
    std::optional<world::TickView> reset(const EpisodePlan& plan);

    /// `every` ticks with this at the wheel: what the next one shows; nothing when the episode is
    /// over. Throws world::Error.
    std::optional<world::TickView> step(const Client::Wheel& wheel);

    /// How the last episode ended, once there was no next tick.
    const world::Outcome& outcome() const { return outcome_; }

    /// The episode that runs, or the last one: town, whom we drive, pictures. Throws world::Error
    /// before the first.
    const Client& run() const;

  private:
    struct Connection;
    std::optional<world::TickView> look();

    std::unique_ptr<Connection> connection_;
    std::unique_ptr<Client> run_;
    bool runs_ = false;
    world::Outcome outcome_;
};

}  // namespace reprise::remote
