#include "traffic/insertion.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/sumo.h"

namespace reprise::traffic {

namespace {

/// The way that a front bumper has come to this place: along the lane, straight on before it.
std::vector<Eigen::Vector3d> way_to(const world::LaneT& lane, double s, double length) {
    std::vector<Eigen::Vector3d> way;
    const double start = s - length;
    const world::LanePoint first = world::point_at(lane, std::max(0.0, start));
    if (start < 0)
        way.push_back(first.position + start * Eigen::Vector3d(std::cos(first.yaw),
                                                               std::sin(first.yaw),
                                                               std::tan(first.pitch)));
    constexpr double spacing = 1;
    for (double at = std::max(0.0, start); at < s; at += spacing)
        way.push_back(world::point_at(lane, at).position);
    way.push_back(world::point_at(lane, s).position);
    return way;
}

}  // namespace

void Insertion::insert(Car& car, const InsertionPoint& point, const std::string& type) const {
    using libsumo::Vehicle;
    const world::LaneT& lane = town_->lanes[point.lane];
    routes_->start(point.lane, car);
    car.sumo = sumo_id(car.id);
    if (car.entries++ > 0)
        car.sumo += fmt::format(".{}", car.entries);
    car.in_sumo = nullptr;
    libsumo::Route::add(car.sumo, graph_->names(car.route));
    Vehicle::add(car.sumo, car.sumo, type, "now");
    // Put there by force: SUMO's own insertion waits in a queue for as long as it likes.
    car.lane = point.lane;
    car.lane_position = std::clamp(point.s / lane.length, 0.0, 1.0) * lane.sumo_length;
    Vehicle::moveTo(car.sumo, lane.name, car.lane_position);
    Vehicle::setPreviousSpeed(car.sumo, car.speed);
    car.aside_limit = -1;
    car.bend_limit = 0;
    car.skips = 0;
    car.lane_change_mode = -1;
    car.trail.start(way_to(lane, point.s, origin_to_front(car.model)), origin_to_front(car.model));
    car.rear = car.trail.rear();
    car.sumo_front = car.trail.front();
    const Eigen::Vector3d body = car.trail.front() - car.rear;
    car.turn_to(std::atan2(body.y(), body.x()));
}

}  // namespace reprise::traffic
