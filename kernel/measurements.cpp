#include "kernel/measurements.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "kernel/nearest_ahead.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

struct FootprintShares {
    double opposite_lane = 0;
    double sidewalk = 0;
};

/// What lies under one point of a vehicle that heads `ahead`.
struct Under {
    bool opposite_lane = false;
    bool sidewalk = false;
};

/// Opposite: a lane for cars is there that runs against the heading, and none that runs with it
/// (lanes overlap inside junctions). `near`: the lanes around.
Under look_under(const world::TownT& town,
                 const world::LaneMap& lanes,
                 std::span<const std::uint32_t> near,
                 const Eigen::Vector3d& p_world,
                 const Eigen::Vector3d& ahead) {
    bool with = false;
    bool against = false;
    const auto found = lanes.at(p_world, near);
    for (const auto& [lane, at] : found) {
        const double yaw = world::point_at(town.lanes[lane], at.s).yaw;
        const bool same = ahead.x() * std::cos(yaw) + ahead.y() * std::sin(yaw) > 0;
        with = with || same;
        against = against || !same;
    }
    return {against && !with, found.empty() && !lanes.walkable_at(p_world, near).empty()};
}

/// Samples the footprint on a grid of 7 x 3 points; of a vehicle whose four corners are where they
/// belong, on the corners alone: nearly all vehicles, nearly always.
FootprintShares footprint_shares(const world::TownT& town,
                                 const world::LaneMap& lanes,
                                 const world::VehicleModel& model,
                                 const Eigen::Isometry3d& pose_world_vehicle) {
    constexpr int along = 7;
    constexpr int across = 3;
    const Eigen::Vector3d ahead = pose_world_vehicle.linear().col(0);
    const Eigen::Vector3d middle(model.length / 2 - model.rear_overhang, 0, 0);
    const std::vector<std::uint32_t> near =
        lanes.near(pose_world_vehicle * middle, std::hypot(model.length, model.width) / 2);
    const auto under = [&](int i, int j) {
        const double x = -model.rear_overhang + model.length * (i + 0.5) / along;
        const double y = model.width * ((j + 0.5) / across - 0.5);
        return look_under(town, lanes, near, pose_world_vehicle * Eigen::Vector3d(x, y, 0), ahead);
    };
    const auto is_corner = [](int i, int j) {
        return (i == 0 || i == along - 1) && (j == 0 || j == across - 1);
    };
    FootprintShares shares;
    const auto add = [&](bool corners) {
        for (int i = 0; i < along; ++i)
            for (int j = 0; j < across; ++j) {
                if (is_corner(i, j) != corners)
                    continue;
                const Under point = under(i, j);
                shares.opposite_lane += point.opposite_lane ? 1 : 0;
                shares.sidewalk += point.sidewalk ? 1 : 0;
            }
    };
    add(true);
    if (shares.opposite_lane == 0 && shares.sidewalk == 0)
        return shares;
    add(false);
    shares.opposite_lane /= along * across;
    shares.sidewalk /= along * across;
    return shares;
}

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
