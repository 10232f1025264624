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

/// Bodies at rest tremble by some 1e-12 m a tick; what creeps like that for an hour is elsewhere by
/// less than the millimetre to which footprints are cut.
bool has_stood_still(const world::VehicleState& before, const world::VehicleState& now) {
    constexpr double still = 1e-10;  // [m], and of a quaternion's parts
    const Eigen::Vector3d way =
        world::to_eigen(now.position()) - world::to_eigen(before.position());
    const Eigen::Quaterniond one = world::to_eigen(before.orientation());
    const Eigen::Quaterniond other = world::to_eigen(now.orientation());
    return before.model() == now.model() && way.cwiseAbs().maxCoeff() < still &&
           (other.coeffs() - one.coeffs()).cwiseAbs().maxCoeff() < still;
}

/// Of its footprint, which is cut exactly: some 50 us. Who stands still has them already.
FootprintShares shares_of(const world::TownT& town,
                          const world::LaneMap& lanes,
                          const world::VehicleState& vehicle,
                          const Eigen::Isometry3d& pose_world_vehicle,
                          const world::TickView& last) {
    const world::VehicleState* stood = find(last.vehicles(), vehicle.id());
    const world::Measurement* before = find(last.measurements(), vehicle.id());
    if (stood != nullptr && before != nullptr && has_stood_still(*stood, vehicle))
        return {before->on_opposite_lane(), before->on_sidewalk()};
    return footprint_shares(
        town, lanes, world::vehicle_models()[vehicle.model()], pose_world_vehicle);
}

}  // namespace

void measure(const world::TownT& town,
             const world::LaneMap& lanes,
             double step_seconds,
             std::span<const Impact> impacts,
             const world::TickView& last,
             world::TickDraft& next) {
    for (const world::VehicleState& vehicle : next.tick.vehicles) {
        const Eigen::Isometry3d pose_world_vehicle =
            world::pose(vehicle.position(), vehicle.orientation());
        const Eigen::Vector3d ahead = pose_world_vehicle.linear().col(0);
        const double speed = ahead.dot(world::to_eigen(vehicle.velocity()));
        const world::Measurement* before = find(last.measurements(), vehicle.id());
        const double acceleration =
            before == nullptr ? 0.0 : (speed - before->speed()) / step_seconds;
        const auto lane =
            lanes.best(pose_world_vehicle.translation(), std::atan2(ahead.y(), ahead.x()));
        const FootprintShares shares = shares_of(town, lanes, vehicle, pose_world_vehicle, last);
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
