#include "traffic/blue_lamps.h"

#include <algorithm>
#include <cmath>

#include "traffic/cars/fleet.h"
#include "traffic/sight/braking.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double crossing = 5;       // [m/s] over a junction where others have the right of way
constexpr double careful_from = 40;  // [m] before it
constexpr double approach_braking = 2.5;  // [m/s^2]
constexpr double comes_within = 3.5;      // [s] of others who come to the junction
constexpr double on_its_way = 0.5;        // [m/s]

}  // namespace

bool BlueLamps::has_right_of_way(const Car& car, const world::TickView& last) const {
    const auto signals = last.signals();
    for (const world::Link& link : town_->lanes[car.lane].links) {
        if (car.route.size() < 2 || graph_->edge_of(link.to()) != car.route[1])
            continue;
        if (link.signal() < signals.size())
            return signals[link.signal()] == world::SignalColor::green;
        return !link.yields();
    }
    return true;
}

/// Who is on his way through the junction, or comes there and would not stop.
bool BlueLamps::would_meet_anybody(const Car& car,
                                   const Cars& cars,
                                   const world::TickView& last) const {
    const std::uint32_t junction = town_->lanes[car.lane].junction;
    const auto comes = [&](std::uint32_t on, double s, double speed, double braking) {
        if (on == none || town_->lanes[on].junction != junction || speed < on_its_way ||
            graph_->edge_of(on) == graph_->edge_of(car.lane))
            return false;
        const world::LaneT& lane = town_->lanes[on];
        const double left = lane.length - s - 1;
        return lane.kind == world::LaneKind::internal ||
               (braking > 0 ? speed * speed / (2 * braking) > left : left < comes_within * speed);
    };
    for (const Car& other : cars.all()) {
        if (other.id == car.id || other.lane == none)
            continue;
        const world::LaneT& lane = town_->lanes[other.lane];
        if (comes(other.lane,
                  other.lane_position / lane.sumo_length * lane.length,
                  other.speed,
                  comfortable_braking(other.model)))
            return true;
    }
    for (const world::VehicleState& other : last.vehicles()) {
        const Eigen::Vector3d ahead =
            world::to_eigen(other.orientation()) * Eigen::Vector3d::UnitX();
        const auto on =
            lanes_->best(world::to_eigen(other.position()) + origin_to_front(other.model()) * ahead,
                         std::atan2(ahead.y(), ahead.x()),
                         4);
        if (on &&
            comes(on->lane, on->at.s, std::hypot(other.velocity().x(), other.velocity().y()), 0))
            return true;
    }
    return false;
}

/// [m/s] towards one where others have the right of way: it waits until they let it through.
double BlueLamps::before_junction(const Car& car,
                                  const Cars& cars,
                                  const world::TickView& last) const {
    const world::LaneT& lane = town_->lanes[car.lane];
    if (lane.kind != world::LaneKind::driving || lane.junction == none)
        return world::infinity;
    const double left = (1 - std::min(car.lane_position / lane.sumo_length, 1.0)) * lane.length;
    if (left > careful_from || has_right_of_way(car, last))
        return world::infinity;
    if (!would_meet_anybody(car, cars, last))
        return std::sqrt(crossing * crossing + 2 * approach_braking * left);
    const Braking braking{
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    return braking.speed_before(left, Braking::least_gap, 0);
}

void BlueLamps::advance(const world::TickView& last, Cars& cars, std::uint64_t tick) const {
    for (Car& car : cars.all()) {
        const bool is_driven = !car.sumo.empty() && car.lane != none;
        const bool goes = is_driven && car.on_call && !car.speed_order && !car.trajectory;
        if (!goes && !car.goes_first)
            continue;
        if (car.goes_first != goes) {
            car.goes_first = goes;
            if (is_driven)
                orders_->let_go(car, tick);
        }
        if (goes)
            car.way_speed = before_junction(car, cars, last);
    }
}

}  // namespace reprise::traffic
