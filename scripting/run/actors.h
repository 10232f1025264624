#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scripting/run/footprint.h"
#include "world/lanes/route_progress.h"
#include "world/lanes/stop_lines.h"
#include "world/tick.h"

namespace reprise::world {
class Hasher;
}

namespace reprise::scripting {

/// What a scenario's actor has touched since it was spawned.
struct Contacts {
    bool vehicle = false;
    bool walker = false;
    bool fixed = false;  ///< the static world
    bool prop = false;
    std::set<std::uint32_t> others;  ///< ids of the actors among them
};

/// An actor's body at a tick: the recorded nouns, brought to one form.
struct Body {
    Eigen::Vector3d position{0, 0, 0};  ///< world; vehicles: on the ground below the rear axle
    double yaw = 0;                     ///< [rad] counter-clockwise from east
    double speed = 0;                   ///< [m/s] ahead
    double acceleration = 0;            ///< [m/s^2] ahead; walkers: 0
    double front = 0;                   ///< [m] from the position to the front bumper
    double rear = 0;                    ///< [m] from the position to the rear bumper
    double half_width = 0;
    std::uint32_t lane = world::none;  ///< in Town.lanes, where the tick names it
    std::optional<double> lane_s;      ///< [m] of the position along it, where the tick holds it
    std::optional<double> lane_t;      ///< [m] left of it, likewise
    std::optional<double> odometer;    ///< [m] where the tick holds it

    Eigen::Vector3d ahead() const;
    /// Of the bounding box, on the ground.
    Eigen::Vector3d centre() const;
    Footprint footprint() const;
};

/// Somebody that the scenario spawned.
struct Actor {
    enum class Presence : std::uint8_t { coming, here, gone };

    std::uint32_t id = 0;
    std::string name;
    world::Driver driver = world::Driver::autopilot;
    world::Pilot pilot = world::Pilot::idm;
    std::uint16_t model = 0;     ///< in the catalogue of its kind
    std::uint32_t line = 0;      ///< of its spawn in the scenario
    std::uint64_t asked_at = 0;  ///< tick in which the scenario asked for it
    Presence presence = Presence::coming;
    std::uint64_t gone_at = 0;
    double travelled = 0;                            ///< [m] since spawn
    Eigen::Vector3d position{0, 0, 0};               ///< where it was last seen, world
    std::optional<Eigen::Vector3d> p_world_asked{};  ///< where it is to come, if that was said
    Footprint asked{};                               ///< and what it will cover there
    bool is_leaving = false;                         ///< a despawn was said
    bool keeps_lane = false;                         ///< changes lanes when it is told to only
    bool walks = false;                              ///< was told to
    std::uint8_t open_doors = 0;                     ///< as told last: bit i, see world::Door
    std::uint64_t follows_until = 0;  ///< last tick of its trajectory; 0: follows none
    std::uint64_t displaced_at = 0;   ///< tick in which the scenario last put it elsewhere
    Contacts contacts;
    world::RedLightWatch lights{};
    std::optional<world::RouteProgress> route{};  ///< that it was told last
    Body body{};                                  ///< where it was last seen
    std::uint64_t body_at = 0;                    ///< tick of that; 0: never

    bool is_walker() const { return driver == world::Driver::walker; }

    bool is_prop() const { return driver == world::Driver::prop; }

    /// Has a body of its own in physics.
    bool is_driven() const {
        return driver == world::Driver::autopilot || driver == world::Driver::manual ||
               driver == world::Driver::external;
    }
};

Body body_of(const world::TickView& tick, const world::VehicleState& vehicle);
Body body_of(const world::CarState& car);
Body body_of(const world::WalkerState& walker);
Body body_of(const world::PropState& prop);

/// None when the actor is not in the tick. O(log n); of the tick that was observed last O(1).
std::optional<Body> body_of(const world::TickView& tick, const Actor& actor);

/// Everybody that the scenario spawned, in the order of their ids: 1, 2, 3, ...
class Actors {
  public:
    Actor& add(Actor actor);

    Actor& at(std::uint32_t id) { return actors_.at(id - 1); }

    std::uint32_t next_id() const { return static_cast<std::uint32_t>(actors_.size()) + 1; }

    /// How many are there, or about to be.
    struct Count {
        std::size_t present = 0;
        std::size_t driven = 0;  ///< of them
    };

    Count present() const { return present_; }

    /// Vehicles, or props, that are or are about to come within so many metres. O(actors).
    std::size_t count_near(const Eigen::Vector3d& p_world, double radius, bool props) const;

    /// Who stands in the way of one who is to cover this, in the tick or spawned since.
    struct Obstructor {
        const Actor* actor = nullptr;  ///< null: nobody
        double depth = 0;              ///< [m] see overlap()
    };

    /// The first of them but for `self`. O(actors).
    Obstructor obstructor(const world::TickView& tick,
                          const Footprint& wanted,
                          std::uint32_t self) const;

    /// Null when nobody has that name.
    const Actor* find(const std::string& name) const;

    std::vector<std::string> names() const { return {names_.begin(), names_.end()}; }

    bool has_name(const std::string& name) const { return names_.count(name) != 0; }

    /// "sedan", then "sedan_2", ...
    std::string free_name(const std::string& model);

    /// Reads a tick once, in their order: who is there, how far they came, whom they touched. Those
    /// who are there are shown to `watch`, with what they drove since the last tick [m].
    using Watch = std::function<void(Actor&, const Body&, double driven)>;
    void observe(const world::TickView& tick, double step, const Watch& watch);

    void digest(world::Hasher& hasher) const;

  private:
    void observe_contacts(const world::TickView& tick);
    void touch(const world::TickView& tick, std::uint32_t actor, std::uint32_t other);
    void leave(Actor& actor, std::uint64_t tick);

    std::vector<Actor> actors_;
    Count present_;
    std::set<std::string> names_;
    std::map<std::string, int> next_number_;  ///< where the search for a free name goes on
};

}  // namespace reprise::scripting
