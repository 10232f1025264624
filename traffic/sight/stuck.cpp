#include "traffic/sight/stuck.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "traffic/sight/way_ahead.h"
#include "world/frames.h"
#include "world/models/actors.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

// Two in a bend, each with its body in the other one's way, stood before an ego for 26 minutes.
constexpr double for_ever = 200;             // [s] of standing for another car
constexpr double far_too_long_facing = 100;  // [s] of standing nose to nose with one with mass
// Nobody waits so long beside one with mass, which it would hit.
constexpr double far_too_long_wedged = 50;  // [s] of standing
// Beside a fast road nobody lets in who stands where his lane ends; an ego stood behind one.
constexpr double far_too_long_at_an_end = 50;  // [s] of standing
// Two who stand with a corner in each other, in a bend, and neither has a way out.
constexpr double far_too_long_in_another = 12;  // [s] of standing of both together,
constexpr double stands_in_another = 3;         // [s] of each
// A bus in a bend and the queue beside it, before a wreck that waited for those behind the bus,
// stood so for 200 s. Where lanes are narrow some do before a light, and would drive on.
constexpr double far_too_long_in_oncoming = 60;  // [s] of standing of both

/// With room at both ends. [m]
BodyBox body_of(const Eigen::Vector2d& rear,
                const Eigen::Vector2d& ahead,
                std::uint16_t model,
                double room = 0) {
    const world::Extent extent = world::extent_of(world::vehicle_models()[model]);
    return {rear + (extent.middle() + room / 2) * ahead,
            ahead,
            (extent.front - extent.rear + room) / 2,
            extent.half_width};
}

}  // namespace

bool waits_for_ever(const Car& car, double step) {
    return car.stuck_ticks * step > for_ever && !car.waits_for.empty();
}

bool is_wedged(const Car& car, double step, std::uint64_t tick) {
    return car.stuck_ticks * step > far_too_long_wedged && car.wedged_until > tick;
}

bool is_at_an_end(const Car& car, double step, const world::TownT& town) {
    constexpr double near = 15;  // [m]
    const world::LaneT& lane = town.lanes[car.lane];
    return car.stuck_ticks * step > far_too_long_at_an_end && !world::leads_on(town, lane) &&
           lane.kind == world::LaneKind::driving && lane.sumo_length - car.lane_position < near;
}

bool faces_one_who_stands(const Car& car, double step, const world::TickView& last) {
    constexpr double near = 3;       // [m] of both, ahead: he leaves room to get around him
    constexpr double stands = 0.1;   // [m/s]
    constexpr double facing = -0.5;  // cosine
    if (car.stuck_ticks * step < far_too_long_facing)
        return false;
    const BodyBox own = body_of(car.rear.head<2>(), car.ahead, car.model, near);
    const auto vehicles = last.vehicles();
    return std::any_of(vehicles.begin(), vehicles.end(), [&](const world::VehicleState& other) {
        const Eigen::Vector2d ahead =
            (world::to_eigen(other.orientation()) * Eigen::Vector3d::UnitX()).head<2>();
        return std::hypot(other.velocity().x(), other.velocity().y()) < stands &&
               std::abs(other.position().z() - car.rear.z()) < world::level_clearance &&
               ahead.dot(car.ahead) < facing &&
               overlap(own, body_of(world::in_plan(other.position()), ahead, other.model(), near));
    });
}

bool lies_in_one_who_stands(const Car& car,
                            std::span<const Car> cars,
                            double step,
                            const world::TownT& town) {
    constexpr std::uint32_t once_in = 20;  // ticks: who stands can wait for the answer
    constexpr double touching = 0.02;      // [m] less is rounding
    constexpr double oncoming = -0.5;      // cosine
    const auto is_inside = [&](const Car& one) {
        return town.lanes[one.lane].kind == world::LaneKind::internal;
    };
    if (car.stuck_ticks % once_in != 0 || car.lane == world::none)
        return false;
    const bool in_junction = is_inside(car);
    const double least = in_junction ? stands_in_another : far_too_long_in_oncoming;
    const auto stands = [&](const Car& one) {
        return one.origin == Origin::demand && one.lane != world::none &&
               one.stuck_ticks * step > least;
    };
    if (!stands(car))
        return false;
    const BodyBox own = body_of(car.rear.head<2>(), car.ahead, car.model);
    return std::any_of(cars.begin(), cars.end(), [&](const Car& other) {
        if (other.id == car.id || !stands(other) ||
            (car.stuck_ticks + other.stuck_ticks) * step < far_too_long_in_another ||
            (!in_junction && other.ahead.dot(car.ahead) > oncoming))
            return false;
        const bool goes_first =
            (is_inside(other) || !in_junction) &&
            std::pair(other.stuck_ticks, car.id) > std::pair(car.stuck_ticks, other.id);
        return !goes_first && std::abs(other.rear.z() - car.rear.z()) < world::level_clearance &&
               depth(own, body_of(other.rear.head<2>(), other.ahead, other.model)) > touching;
    });
}

}  // namespace reprise::traffic
