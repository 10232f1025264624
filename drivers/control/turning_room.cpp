#include "drivers/control/turning_room.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Core>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::drivers {

namespace {

/// What a body covers, seen from above.
struct Footprint {
    Eigen::Vector2d centre;
    Eigen::Vector2d ahead;  // of length 1
    double half_length;     // [m]
    double half_width;      // [m]
};

Footprint footprint_of(const Eigen::Vector2d& rear_axle,
                       const Eigen::Vector2d& ahead,
                       const world::VehicleModel& model) {
    const double half = model.length / 2;
    return {rear_axle + (half - model.rear_overhang) * ahead, ahead, half, model.width / 2};
}

/// How far two are apart, as the largest gap along a side of one of them: never more than the true
/// distance, and negative where they reach into each other. [m]
double gap_between(const Footprint& one, const Footprint& other) {
    const Eigen::Vector2d apart = other.centre - one.centre;
    const auto extent = [](const Footprint& of, const Eigen::Vector2d& along) {
        return of.half_length * std::abs(of.ahead.dot(along)) +
               of.half_width * std::abs(world::turned_left(of.ahead).dot(along));
    };
    double gap = -1e9;
    for (const Eigen::Vector2d& axis :
         {one.ahead, world::turned_left(one.ahead), other.ahead, world::turned_left(other.ahead)})
        gap = std::max(gap, std::abs(apart.dot(axis)) - extent(one, axis) - extent(other, axis));
    return gap;
}

/// The car now, and at so many places on its way, the last one at its end.
constexpr std::size_t places = 5;

std::array<Footprint, places> way_of(const Ego& ego, double distance, double steering_angle) {
    const double curvature = std::tan(steering_angle) / ego.model->wheelbase;
    std::array<Footprint, places> way;
    for (std::size_t i = 0; i < places; ++i) {
        const double driven = distance * static_cast<double>(i) / (places - 1);
        const double turn = curvature * driven;
        const Eigen::Vector2d rear_axle =
            ego.position.head<2>() + driven * world::ahead_of(ego.yaw + turn / 2);
        way[i] = footprint_of(rear_axle, world::ahead_of(ego.yaw + turn), *ego.model);
    }
    return way;
}

bool is_in_the_way(const std::array<Footprint, places>& way, const Footprint& other, double clear) {
    constexpr double noise = 0.01;  // [m]
    double nearest = 1e9;
    for (std::size_t i = 1; i < places; ++i)
        nearest = std::min(nearest, gap_between(way[i], other));
    return nearest < clear && nearest < gap_between(way[0], other) - noise;
}

}  // namespace

bool comes_near(const world::TickView& last,
                const Ego& ego,
                double distance,
                double steering_angle,
                double clear) {
    constexpr double far = 15;             // [m]
    constexpr double half_a_person = 0.4;  // [m] and some more: they move
    const auto way = way_of(ego, distance, steering_angle);
    const auto near = [&](const world::Vec3& position) {
        return (world::to_eigen(position) - ego.position).squaredNorm() < far * far;
    };
    const auto meets = [&](const world::Vec3& p, double yaw, const world::VehicleModel& model) {
        return near(p) &&
               is_in_the_way(
                   way, footprint_of(world::in_plan(p), world::ahead_of(yaw), model), clear);
    };
    for (const world::VehicleState& other : last.vehicles()) {
        const Ego seen = ego_of(other);
        if (seen.id != ego.id && meets(other.position(), seen.yaw, *seen.model))
            return true;
    }
    for (const world::CarState& car : last.cars())
        if (meets(car.position(),
                  static_cast<double>(car.yaw()),
                  world::vehicle_models()[car.model()]))
            return true;
    return std::any_of(
        last.walkers().begin(), last.walkers().end(), [&](const world::WalkerState& one) {
            const Footprint person{
                world::in_plan(one.position()), {1, 0}, half_a_person, half_a_person};
            return near(one.position()) && is_in_the_way(way, person, clear);
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
               std::abs(position.z() - ego.position.z()) < 3 && !comes && !leaves;
    };
    for (const world::VehicleState& other : last.vehicles())
        if (other.id() != ego.id && turns(other.position(), ego_of(other).yaw))
            return true;
    return std::any_of(last.cars().begin(), last.cars().end(), [&](const world::CarState& car) {
        return turns(car.position(), static_cast<double>(car.yaw()));
    });
}

}  // namespace reprise::drivers
