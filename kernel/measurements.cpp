#include "kernel/measurements.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "kernel/footprint.h"
#include "kernel/nearest_ahead.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

struct Impulses {
    double vehicles = 0;
    double walkers = 0;
    double fixed = 0;
};

Impulses impulses_of(std::uint32_t actor,
                     const world::Measurement* before,
                     std::span<const Impact> impacts,
                     const world::TickDraft& next) {
    Impulses sum;
    if (before != nullptr)
        sum = {before->impulse_vehicles(), before->impulse_walkers(), before->impulse_static()};
    for (const Impact& impact : impacts) {
        if (impact.actor != actor)
            continue;
        const bool walker = std::any_of(
            next.traffic.walkers.begin(),
            next.traffic.walkers.end(),
            [&](const world::WalkerState& state) { return state.id() == impact.other; });
        const bool prop = std::any_of(
            next.tick.props.begin(), next.tick.props.end(), [&](const world::PropState& state) {
                return state.id() == impact.other;
            });
        const bool fixed = impact.other == 0 || prop;
        (fixed ? sum.fixed : walker ? sum.walkers : sum.vehicles) += impact.impulse;
    }
    return sum;
}

}  // namespace

void measure(const world::TownT& town,
             const world::LaneMap& lanes,
             double step_seconds,
             std::span<const Impact> impacts,
             const world::TickView& last,
             world::TickDraft& next) {
    for (const world::VehicleState& vehicle : next.tick.vehicles) {
        const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
        const Eigen::Isometry3d pose_world_vehicle =
            world::pose(vehicle.position(), vehicle.orientation());
        const Eigen::Vector3d ahead = pose_world_vehicle.linear().col(0);
        const double speed = ahead.dot(world::to_eigen(vehicle.velocity()));
        const world::Measurement* before = find(last.measurements(), vehicle.id());
        const double acceleration =
            before == nullptr ? 0.0 : (speed - before->speed()) / step_seconds;
        const auto lane =
            lanes.best(pose_world_vehicle.translation(), std::atan2(ahead.y(), ahead.x()));
        const FootprintShares shares = footprint_shares(town, lanes, model, pose_world_vehicle);
        const Impulses sums = impulses_of(vehicle.id(), before, impacts, next);
        next.tick.measurements.emplace_back(speed,
                                            acceleration,
                                            lane ? lane->at.s : 0.0,
                                            lane ? lane->at.t : 0.0,
                                            shares.opposite_lane,
                                            shares.sidewalk,
                                            sums.vehicles,
                                            sums.walkers,
                                            sums.fixed,
                                            nearest_ahead(vehicle, next).gap,
                                            vehicle.id(),
                                            lane ? lane->lane : world::none,
                                            std::uint64_t{0},  // halted: see note_blockages
                                            lane ? town.lanes[lane->lane].speed_limit : 0.0,
                                            -1.0);  // no goal
    }
}

}  // namespace reprise::kernel
