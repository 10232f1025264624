// What it must do: read SUMO's cars after its step, and write them into the tick.
// What it assumes: between two steps a car moves by speed times step along its lane (SUMO's Euler
//   update), unless it changes lanes.
// How it goes: libsumo's getters, about 30 ns each, and none for what cannot have changed.
// What it keeps: nothing beside the cars.
#include "traffic/car_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <libsumo/libsumo.h>

#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::none;
using world::rounded;

std::vector<bool> only_lanes_of_their_roads(const world::TownT& town) {
    std::map<std::string_view, int> lanes_of_edge;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind != world::LaneKind::sidewalk)
            ++lanes_of_edge[lane.edge];
    std::vector<bool> alone;
    alone.reserve(town.lanes.size());
    for (const world::LaneT& lane : town.lanes)
        alone.push_back(lanes_of_edge[lane.edge] == 1);
    return alone;
}

/// SUMO's bits: 1 right indicator, 2 left indicator, 8 brake light.
std::uint16_t lamps_of(int signals) {
    int lamps = 0;
    if ((signals & 1) != 0)
        lamps |= world::lamp_right;
    if ((signals & 2) != 0)
        lamps |= world::lamp_left;
    if ((signals & 8) != 0)
        lamps |= world::lamp_brake;
    return static_cast<std::uint16_t>(lamps);
}

/// SUMO's cars jump when they change lanes on a curve (position along the lane is kept, though the
/// lanes are not equally long) and when a change is cut short by a junction. Such a jump becomes a
/// slip, which the car works off while it drives. It is measured along `lane_yaw`, the lane's
/// direction there: along the car's own, a slip that is longer than the car would turn it ever
/// further. Returns the bumper's place to show.
Eigen::Vector3d smooth(
    Car& car, const Eigen::Vector3d& sumo_front, bool new_lane, double lane_yaw, double step) {
    const Eigen::Vector2d ahead(std::cos(lane_yaw), std::sin(lane_yaw));
    const Eigen::Vector2d left(-ahead.y(), ahead.x());
    if (new_lane) {
        const double driven = car.speed * step;
        const Eigen::Vector2d jump = (sumo_front - car.sumo_front).head<2>() - ahead * driven;
        // A bend moves the bumper sideways, too: what one tick of driving can do is no jump.
        const double along = jump.dot(ahead);
        const double across = jump.dot(left);
        constexpr double farthest = 8;  // [m]; further is a new place, not a jump
        if (std::abs(along) > 0.05 + 0.1 * driven && jump.norm() < farthest)
            car.slip.x() -= along;
        if (std::abs(across) > 0.15 + 0.3 * driven && jump.norm() < farthest)
            car.slip.y() -= across;
    }
    car.sumo_front = sumo_front;
    if (car.slip.isZero(0))
        return sumo_front;
    // Shares of the speed, so that a standing car stands.
    const double along = std::min(std::abs(car.slip.x()), 0.15 * car.speed * step);
    const double across = std::min(std::abs(car.slip.y()), 0.10 * car.speed * step);
    car.slip.x() -= std::copysign(along, car.slip.x());
    car.slip.y() -= std::copysign(across, car.slip.y());
    const Eigen::Vector2d shift = ahead * car.slip.x() + left * car.slip.y();
    return sumo_front + Eigen::Vector3d(shift.x(), shift.y(), 0);
}

}  // namespace

CarReader::CarReader(const world::TownT& town,
                     const RoadGraph& graph,
                     double step,
                     std::uint64_t seed)
    : town_(&town),
      graph_(&graph),
      step_(step),
      seed_(seed),
      only_lane_of_road_(only_lanes_of_their_roads(town)) {
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        lanes_by_name_.emplace(town.lanes[i].name, i);
}

/// Onto the lane of this name. What lies behind is no longer part of the car's route.
void CarReader::enter_lane(Car& car, std::string_view lane) const {
    const auto found = lanes_by_name_.find(lane);
    car.lane = found == lanes_by_name_.end() ? none : found->second;
    const std::uint32_t edge = car.lane == none ? none : graph_->edge_of(car.lane);
    const auto here = std::find(car.route.begin(), car.route.end(), edge);
    if (here != car.route.end())
        car.route.erase(car.route.begin(), here);
}

/// The front bumper as SUMO has it, at the height of the town's road.
Eigen::Vector3d CarReader::bumper_of(const Car& car) const {
    // SUMO writes a height only where the network has one; elsewhere it is a number of its own.
    const libsumo::TraCIPosition p = Vehicle::getPosition3D(car.sumo);
    const bool has_height = p.z != libsumo::INVALID_DOUBLE_VALUE;
    Eigen::Vector3d front(p.x, p.y, has_height ? p.z : 0.0);
    // Where paths cross, the town's road is not the network's: see ground/mesh/level_paths.h.
    if (has_height && car.lane != none &&
        town_->lanes[car.lane].kind == world::LaneKind::internal) {
        const world::LaneT& path = town_->lanes[car.lane];
        front.z() = world::point_at(path, world::project(path, front).s).position.z();
    }
    return front;
}

/// As its order wants it, and as the car drives: a standing car stands.
void CarReader::move_aside(Car& car, std::uint64_t tick) const {
    constexpr double steepest = 0.5;  // metres aside for each metre driven
    const OffsetOrder& order = *car.offset_order;
    const double seconds = static_cast<double>(tick - order.start) * step_;
    const double most = steepest * car.speed * step_;
    car.offset += std::clamp(order.change.value(seconds) - car.offset, -most, most);
    if (car.offset == 0 && order.change.to == 0 && seconds >= order.change.duration)
        car.offset_order.reset();
}

/// The pose that the car shows, after its bumper.
void CarReader::move_body(Car& car, bool new_lane) const {
    const Eigen::Vector3d front = bumper_of(car);
    double lane_yaw = car.yaw;
    if (car.lane != none && (new_lane || !car.slip.isZero(0) || car.offset != 0)) {
        const world::LaneT& on = town_->lanes[car.lane];
        lane_yaw = world::point_at(on, car.lane_position * on.length / on.sumo_length).yaw;
    }
    Eigen::Vector3d shown = smooth(car, front, new_lane, lane_yaw, step_);
    if (car.offset != 0)
        shown += car.offset * Eigen::Vector3d(-std::sin(lane_yaw), std::cos(lane_yaw), 0);
    car.trail.advance(shown);
    car.rear = car.trail.rear();
    const Eigen::Vector3d body = car.trail.front() - car.rear;
    car.yaw = std::atan2(body.y(), body.x());
    car.pitch = body.z() == 0 ? 0 : std::atan2(body.z(), body.head<2>().norm());
}

void CarReader::read_car(Car& car, std::uint64_t tick) const {
    const double speed = Vehicle::getSpeed(car.sumo);
    const double position = Vehicle::getLanePosition(car.sumo);
    // On a road of one lane: a car that did not move is where it was, and one that moved by just
    // its speed is on the same lane (entering another one would take off the length of the last).
    const bool alone = car.lane != none && only_lane_of_road_[car.lane];
    const bool stands = alone && speed == 0 && car.speed == 0 && position == car.lane_position;
    const bool keeps_lane = alone && std::abs(position - car.lane_position - speed * step_) < 1e-6;
    car.lane_position = position;
    // Lamps can wait: a quarter of the cars is asked in each tick, so they are at most 0.2 s old.
    if (car.lane == none || (tick + car.id) % 4 == 0)
        car.lamps = lamps_of(Vehicle::getSignals(car.sumo));
    car.acceleration = (speed - car.speed) / step_;
    car.speed = speed;
    car.standing_ticks = speed < 0.1 ? car.standing_ticks + 1 : 0;
    if (stands)
        return;
    if (car.offset_order)
        move_aside(car, tick);
    const std::string lane =
        keeps_lane ? town_->lanes[car.lane].name : Vehicle::getLaneID(car.sumo);
    const bool new_lane = car.lane == none || town_->lanes[car.lane].name != lane;
    if (new_lane)
        enter_lane(car, lane);
    move_body(car, new_lane);
}

void CarReader::read(Cars& cars, std::uint64_t tick) const {
    for (Car& car : cars.all())
        if (car.origin != Origin::parked && !car.sumo.empty())
            read_car(car, tick);
}

void CarReader::write(const Cars& cars, world::TickDraft& next) const {
    constexpr double per_metre = 1024;
    constexpr double per_radian = 8192;
    constexpr double per_acceleration = 64;  // a lamp and a plot need no more
    auto& out = next.traffic.cars;
    auto& looks = next.traffic.looks;
    out.clear();
    looks.clear();
    out.reserve(cars.size());
    looks.reserve(cars.size());
    for (const Car& car : cars.all()) {
        double lane_s = 0;
        if (car.lane != none)
            lane_s = car.lane_position * town_->lanes[car.lane].length /
                     town_->lanes[car.lane].sumo_length;
        double yaw = rounded(car.yaw, per_radian);
        if (yaw > std::acos(-1.0) || yaw <= -std::acos(-1.0))
            yaw = std::floor(std::acos(-1.0) * per_radian) / per_radian;
        out.emplace_back(world::Vec3(rounded(car.rear.x(), per_metre),
                                     rounded(car.rear.y(), per_metre),
                                     rounded(car.rear.z(), per_metre)),
                         static_cast<float>(yaw),
                         static_cast<float>(rounded(car.pitch, per_radian)),
                         static_cast<float>(rounded(car.speed, per_metre)),
                         static_cast<float>(rounded(lane_s, per_metre)),
                         car.id,
                         car.lane,
                         car.model,
                         car.lamps,
                         static_cast<float>(rounded(car.acceleration, per_acceleration)));
        looks.push_back(world::drawn_look(seed_, car.id));
    }
}

}  // namespace reprise::traffic
