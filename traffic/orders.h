#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/road_graph.h"
#include "traffic/route_planner.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

// SUMO's lane change mode of scripted cars: 1 changes lanes where the route asks for it and no
// order speaks against it; 256 carries an order out as soon as nobody is hit by it. No changes for
// speed, courtesy or the keep-right rule: a scenario's car stays where it was put.
inline constexpr int carries_orders_out = 256;
inline constexpr int changes_as_told = 1 + carries_orders_out;

/// What a scenario tells cars that SUMO drives: speeds, lane changes, routes.
class Orders {
  public:
    /// All of them must outlive this.
    Orders(const world::EpisodeT& episode,
           const world::TownT& town,
           const RoadGraph& graph,
           const RoutePlanner& routes);

    /// Takes a command for this car in the tick being made. Throws world::Error, with the script's
    /// line, for a route to a lane that cannot be reached.
    void give(const world::CommandT& command, Car& car, std::uint64_t tick) const;

    /// A car whose speed was held for a tick goes on as it was told before.
    void release(Car& car, std::uint64_t tick) const;

    /// [m/s] that its order wants at the end of this tick.
    double ordered_speed(const Car& car, std::uint64_t tick) const;

    /// SUMO's speed mode of a car without an order that must brake as hard as it can.
    int braking_mode(const Car& car) const;

    /// A car that was held back goes on as it was told before, or as it likes.
    void let_go(const Car& car, std::uint64_t tick) const;

    /// Asks of SUMO what the orders want in this tick; ends those that are carried out.
    /// `may_change(car)`: is nothing in the way of a change of lanes that begins now?
    void follow(Cars& cars,
                const std::function<bool(const Car&)>& may_change,
                std::uint64_t tick) const;

  private:
    void take_speed(const world::CommandT& command, Car& car, std::uint64_t tick) const;
    void take_braking(const world::CommandT& command, Car& car, std::uint64_t tick) const;
    void take_offset(const world::CommandT& command, Car& car, std::uint64_t tick) const;
    void free_speed(Car& car) const;
    void take_lane(const world::CommandT& command, Car& car, std::uint64_t tick) const;
    void keep_lane(Car& car, bool keep) const;
    void take_route(const world::CommandT& command, Car& car) const;
    std::vector<std::uint32_t> way_to(const world::CommandT& command, Car& car) const;
    std::vector<std::uint32_t> way_on_lane(const world::CommandT& command, Car& car) const;
    void follow_lane_order(Car& car,
                           const std::function<bool(const Car&)>& may_change,
                           std::uint64_t tick) const;
    bool is_off_its_route(const Car& car) const;
    bool waits_in_the_wrong_lane(const Car& car) const;

    const world::EpisodeT* episode_;
    const world::TownT* town_;
    const RoadGraph* graph_;
    const RoutePlanner* routes_;
    double step_;  ///< [s]
};

}  // namespace reprise::traffic
