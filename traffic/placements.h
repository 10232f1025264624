#pragma once

#include <cstdint>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/insertion.h"
#include "traffic/roads/road_graph.h"
#include "traffic/route_planner.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Where a car is by the scenario's word, not by SUMO's: put elsewhere, or on a trajectory.
///
/// MUST    show the car exactly where it was put; let everybody else react to it meanwhile.
/// ASSUMES SUMO drives on lanes only.
/// GOES    a car on a trajectory leaves SUMO, which sees it as it sees physics vehicles (see
///         mirrors.h). Behind the end it enters SUMO again, on the lane under it; what it stands
///         beside that lane's middle it works off while it drives (see smooth() in car_reader.cpp).
///         Orders that are given meanwhile wait. Off every lane it stands where it is.
/// KEEPS   nothing beside the cars.
class Placements {
  public:
    /// [m] from a lane's centre line: a car that is further off is on no lane.
    static constexpr double reach = 4;

    /// All of them must outlive this.
    Placements(const world::EpisodeT& episode,
               const world::TownT& town,
               const world::LaneMap& lanes,
               const RoadGraph& graph,
               const RoutePlanner& routes,
               const Insertion& insertion)
        : town_(&town),
          lanes_(&lanes),
          graph_(&graph),
          routes_(&routes),
          insertion_(&insertion),
          step_(world::seconds(1, episode.step_ns)) {}

    /// Carries out follow, teleport, set_velocity in the tick being made.
    void give(const world::CommandT& command, Car& car, std::uint64_t tick) const;

    /// A pose as a command says it: on a lane, or anywhere; the height is the road's.
    struct Pose {
        Eigen::Vector3d rear;  ///< the origin: ground below the rear axle
        double yaw = 0;
        double pitch = 0;
    };

    Pose pose_of(const world::CommandT& command) const;

    /// Puts a car into SUMO that is there, at its speed. False: it is on no lane.
    bool enter_sumo(Car& car, std::uint64_t tick) const;

    /// Puts it there.
    void stand(Car& car, const Pose& pose) const;

    /// Before SUMO's step: cars on a trajectory where they will be at the end of the tick; those
    /// whose trajectory has ended into SUMO. Returns for the mirrors who is to be shown to SUMO,
    /// sorted by id. Cars whose `waiting` orders can be given now are listed in `freed`.
    std::vector<world::VehicleState> advance(Cars& cars,
                                             std::uint64_t tick,
                                             std::vector<std::uint32_t>& freed) const;

  private:
    void leave_sumo(Car& car) const;
    void follow(Car& car, std::uint64_t tick) const;
    void hold_speed(Car& car, std::uint64_t tick) const;
    void look_for_lane(Car& car) const;
    std::vector<std::uint32_t> way_on(std::uint32_t lane, const Car& car) const;
    world::VehicleState shown(const Car& car) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    const RoadGraph* graph_;
    const RoutePlanner* routes_;
    const Insertion* insertion_;
    double step_;  ///< [s]
};

}  // namespace reprise::traffic
