#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "traffic/cars/cars.h"
#include "traffic/mirrors.h"
#include "traffic/roads/road_graph.h"
#include "world/digest.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Traffic makes way for vehicles that have their blue lamps on, whoever drives them: "callers".
///
/// MUST    drive aside in its lane before a caller that comes from behind, and slow down where that
///         can pass (a vehicle with mass can drive between two) or leave its lane to it (SUMO's
///         cannot); where there is one lane a direction, those who come towards it as well; and let
///         it have the junction that it comes to.
/// ASSUMES that a caller's way is its route, or that which Mirrors took for the likeliest.
/// GOES    on roads of several lanes the outermost drives to its outer edge, the others to theirs;
///         else everybody away from oncoming traffic. By offset orders, which are carried out as a
///         car drives: who stands does not move. Cars that the scenario holds in speed, place or
///         lane do as they were told. Nobody makes way for one who has stood for long.
/// KEEPS   with each car, whether it is aside; for how long callers stand.
class RescueLane {
  public:
    /// All of them must outlive this. `step` [s] of a tick.
    RescueLane(const world::TownT& town,
               const world::LaneMap& lanes,
               const RoadGraph& graph,
               double step)
        : town_(&town),
          lanes_(&lanes),
          graph_(&graph),
          step_(step) {}

    /// Before SUMO's step, behind the orders. Where nobody has his blue lamps on it costs a look at
    /// every lamp.
    void advance(const world::TickView& last,
                 Cars& cars,
                 const Mirrors& mirrors,
                 std::uint64_t tick);

    /// Nothing where nobody is on call.
    void add_to(world::Hasher& hasher) const;

  private:
    /// An edge of a caller's way. [m] from its bumper
    struct Stretch {
        std::uint32_t edge = world::none;
        double start = 0;
    };

    /// For how long one of them stands.
    struct Halt {
        std::uint32_t id = 0;
        std::uint32_t ticks = 0;
    };

    struct Caller {
        std::uint32_t id = 0;
        double length = 0;  ///< [m]
        double speed = 0;
        bool has_mass = false;
        std::uint32_t lane = world::none;
        std::vector<Stretch> way;
        std::vector<std::uint32_t> junctions;  ///< that it is in, or will be in a moment
    };

    /// What one car does about them.
    struct Wish {
        bool aside = false;
        bool leaves_lane = false;
        double speed = world::infinity;  ///< [m/s] at most
    };

    void find_callers(const world::TickView& last, Cars& cars, const Mirrors& mirrors);
    void add_caller(Caller caller,
                    std::uint32_t lane,
                    double s,
                    std::span<const std::uint32_t> edges);
    bool stands_for_long(std::uint32_t id, double speed);
    Wish wish_of(const Car& car) const;
    void make_way(const Car& car, const Caller& caller, Wish& wish) const;
    void let_through(const Car& car, const Caller& caller, Wish& wish) const;
    void leave_lane(const Car& car) const;
    double aside_of(const Car& car) const;
    bool is_alone(const world::LaneT& lane) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    const RoadGraph* graph_;
    double step_;  ///< [s]
    std::vector<Caller> callers_;
    std::vector<Halt> halts_;
    std::vector<Halt> next_halts_;
};

}  // namespace reprise::traffic
