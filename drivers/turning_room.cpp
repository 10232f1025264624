#include "drivers/turning_room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "drivers/bodies.h"
#include "drivers/control/wide_turn.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::drivers {

namespace {

/// How far two are apart, as the largest gap along a side of one of them: never more than the true
/// distance, and negative where they reach into each other. [m]
double gap_between(const Body& one, const Body& other) {
    const Eigen::Vector2d apart = other.centre - one.centre;
    const auto extent = [](const Body& of, const Eigen::Vector2d& along) {
        return of.half_length * std::abs(of.direction.dot(along)) +
               of.half_width * std::abs(world::turned_left(of.direction).dot(along));
    };
    double gap = -1e9;
    for (const Eigen::Vector2d& axis : {one.direction,
                                        world::turned_left(one.direction),
                                        other.direction,
                                        world::turned_left(other.direction)})
        gap = std::max(gap, std::abs(apart.dot(axis)) - extent(one, axis) - extent(other, axis));
    return gap;
}

/// The car now, and at so many places on its way, the last one at its end.
constexpr std::size_t places = 5;

std::array<Body, places> way_of(const Ego& ego, double distance, double steering_angle) {
    const double curvature = std::tan(steering_angle) / ego.model->wheelbase;
    std::array<Body, places> way;
    for (std::size_t i = 0; i < places; ++i) {
        const double driven = distance * static_cast<double>(i) / (places - 1);
        const double turn = curvature * driven;
        const Eigen::Vector2d rear_axle =
            ego.position.head<2>() + driven * world::ahead_of(ego.yaw + turn / 2);
        way[i].direction = world::ahead_of(ego.yaw + turn);
        way[i].half_length = ego.model->length / 2;
        way[i].half_width = ego.model->width / 2;
        way[i].centre =
            rear_axle + (way[i].half_length - ego.model->rear_overhang) * way[i].direction;
    }
    return way;
}

bool is_in_the_way(const std::array<Body, places>& way, const Body& other, double clear) {
    constexpr double noise = 0.01;  // [m]
    double nearest = 1e9;
    for (std::size_t i = 1; i < places; ++i)
        nearest = std::min(nearest, gap_between(way[i], other));
    return nearest < clear && nearest < gap_between(way[0], other) - noise;
}

constexpr double beside = 9;         // [m] from the end of our lane to the start of theirs
constexpr double least_turn = 0.9;   // [rad] over the junction
constexpr double against_us = -0.6;  // cosine
constexpr double in_sight = 40;      // [m] from our line
constexpr int most_inside = 4;       // lanes of one way over a junction

struct Exit {
    std::uint32_t lane = world::none;
    double turn = 0;  ///< [rad] until there, to the left
};

/// Where a way over a junction leads to.
Exit exit_of(const world::TownT& town, std::uint32_t internal) {
    Exit exit;
    for (int i = 0; i < most_inside && !town.lanes[internal].links.empty(); ++i) {
        const world::LaneT& lane = town.lanes[internal];
        exit.turn += world::wrap_angle(world::point_at(lane, lane.length).yaw -
                                       world::point_at(lane, 0).yaw);
        exit.lane = lane.links.front().to();
        if (town.lanes[exit.lane].kind != world::LaneKind::internal)
            return exit;
        internal = exit.lane;
    }
    return {};
}

}  // namespace

bool comes_near(const world::TickView& last,
                const Ego& ego,
                double distance,
                double steering_angle,
                double clear) {
    constexpr double more_for_people = 0.1;  // [m]: they move
    const auto way = way_of(ego, distance, steering_angle);
    world::Box around;
    for (const Body& place : way)
        around.take(place.centre, place.radius() + clear);
    std::vector<Body> bodies;
    collect_bodies(last, ego.id, around, 0, bodies);
    return std::any_of(bodies.begin(), bodies.end(), [&](const Body& other) {
        return std::abs(other.z - ego.position.z()) < world::level_clearance &&
               is_in_the_way(
                   way, other, clear + (other.kind == BodyKind::walker ? more_for_people : 0));
    });
}

bool turns_around_at(const world::TickView& last,
                     const Ego& ego,
                     const Eigen::Vector2d& place,
                     double yaw) {
    constexpr double near = 9;        // [m] from the rear axle
    constexpr double aligned = 0.35;  // [rad] with the lane that it comes from
    constexpr double off_lane = 0.8;  // [m] beside the one that it turns into
    const Eigen::Vector2d along = world::ahead_of(yaw);
    const auto turns = [&](const world::Vec3& position, double its_yaw) {
        const Eigen::Vector2d offset = world::in_plan(position) - place;
        const bool comes = std::cos(its_yaw - yaw) < -std::cos(aligned);
        const bool leaves = std::cos(its_yaw - yaw) > std::cos(aligned) &&
                            std::abs(world::cross(along, offset)) < off_lane;
        return offset.squaredNorm() < near * near &&
               std::abs(position.z() - ego.position.z()) < world::level_clearance && !comes &&
               !leaves;
    };
    for (const world::VehicleState& other : last.vehicles())
        if (other.id() != ego.id && turns(other.position(), ego_of(other).yaw))
            return true;
    return std::any_of(last.cars().begin(), last.cars().end(), [&](const world::CarState& car) {
        return turns(car.position(), static_cast<double>(car.yaw()));
    });
}

bool turns_in_beside(const world::TickView& last,
                     const world::TownT& town,
                     const Gate& gate,
                     std::uint32_t self) {
    const world::LaneT& from = town.lanes[gate.from];
    const world::LanePoint line = world::point_at(from, from.length);
    const auto turns_in =
        [&](const world::VehicleModel& model, const world::Vec3& position, std::uint32_t lane) {
            if (!WideTurnPlan::is_needed(model) || lane >= town.lanes.size() ||
                town.lanes[lane].kind != world::LaneKind::internal ||
                std::hypot(position.x() - line.position.x(), position.y() - line.position.y()) >
                    in_sight)
                return false;
            const Exit exit = exit_of(town, lane);
            if (exit.lane == world::none || std::abs(exit.turn) < least_turn)
                return false;
            const world::LanePoint start = world::point_at(town.lanes[exit.lane], 0);
            return (start.position - line.position).norm() < beside &&
                   world::ahead_of(start.yaw).dot(world::ahead_of(line.yaw)) < against_us;
        };
    for (const world::CarState& car : last.cars())
        if (turns_in(world::vehicle_models()[car.model()], car.position(), car.lane()))
            return true;
    for (const world::VehicleState& other : last.vehicles()) {
        const world::Measurement* measured = world::find(last.measurements(), other.id());
        if (other.id() != self && measured != nullptr &&
            turns_in(world::vehicle_models()[other.model()], other.position(), measured->lane()))
            return true;
    }
    return false;
}

}  // namespace reprise::drivers
