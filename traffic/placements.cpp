#include "traffic/placements.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/orders.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::CommandKind;
using world::none;

Eigen::Vector3d ahead_of(const Placements::Pose& pose) {
    return {std::cos(pose.yaw), std::sin(pose.yaw), std::tan(pose.pitch)};
}

}  // namespace

Placements::Pose Placements::pose_of(const world::CommandT& command) const {
    if (!command.has_pose) {
        const world::LanePoint at = world::point_at(town_->lanes.at(command.lane), command.s);
        const Eigen::Vector3d left(-std::sin(at.yaw), std::cos(at.yaw), 0);
        return {at.position + command.offset * left, at.yaw, at.pitch};
    }
    Pose pose{world::to_eigen(command.target), command.heading, 0};
    if (const auto found = lanes_->best(pose.rear, pose.yaw)) {
        const world::LanePoint at = world::point_at(town_->lanes[found->lane], found->at.s);
        pose.rear.z() = at.position.z();
        pose.pitch = at.pitch;
    }
    return pose;
}

void Placements::stand(Car& car, const Pose& pose) const {
    const double length = origin_to_front(car.model);
    car.rear = pose.rear;
    car.turn_to(pose.yaw);
    car.pitch = pose.pitch;
    const Eigen::Vector3d ahead = ahead_of(pose);
    car.trail.start(car.rear + ahead * length, -ahead, length);
    car.slip.setZero();
    look_for_lane(car);
}

/// The lane under its front bumper, and the place on it.
void Placements::look_for_lane(Car& car) const {
    const Eigen::Vector3d front =
        car.rear + origin_to_front(car.model) * ahead_of({car.rear, car.yaw, car.pitch});
    const auto found = lanes_->best(front, car.yaw, reach);
    const bool on_road = found && graph_->edge_of(found->lane) != none;
    car.lane = on_road ? found->lane : none;
    if (!on_road)
        return;
    const world::LaneT& lane = town_->lanes[car.lane];
    car.lane_position = std::min(found->at.s / lane.length, 1.0) * lane.sumo_length;
}

void Placements::leave_sumo(Car& car) const {
    if (!car.sumo.empty())
        Vehicle::remove(car.sumo);
    car.sumo.clear();
    car.in_sumo = nullptr;
    car.slip.setZero();
    car.lane_order.reset();
}

/// What is left of its way, or to the stops of its route that it had not passed; else it wanders.
std::vector<std::uint32_t> Placements::way_on(std::uint32_t lane, const Car& car) const {
    const std::uint32_t edge = graph_->edge_of(lane);
    const auto here = std::find(car.route.begin(), car.route.end(), edge);
    if (here != car.route.end())
        return {here, car.route.end()};
    std::vector<std::uint32_t> way{edge};
    for (const std::uint32_t stop : car.stops) {
        if (std::find(car.route.begin(), car.route.end(), stop) == car.route.end())
            continue;
        const std::vector<std::uint32_t> leg = graph_->shortest(way.back(), stop);
        if (leg.empty())
            break;
        way.insert(way.end(), leg.begin() + 1, leg.end());
    }
    return way;
}

bool Placements::enter_sumo(Car& car, std::uint64_t tick) const {
    look_for_lane(car);
    if (car.lane == none)
        return false;
    const Pose shown{car.rear, car.yaw, car.pitch};
    const std::vector<std::uint32_t> way = way_on(car.lane, car);
    const std::uint32_t last_lane = car.last_lane;
    const world::LaneT& lane = town_->lanes[car.lane];
    const double s = car.lane_position / lane.sumo_length * lane.length;
    insertion_->insert(car, {car.lane, s}, scripted_type(car.model));
    Vehicle::setLaneChangeMode(car.sumo, car.keeps_lane ? carries_orders_out : changes_as_told);
    if (way.size() > 1 && graph_->leads_to(car.lane, way[1])) {
        car.route = way;
        car.last_lane = std::find(way.begin(), way.end(), graph_->edge_of(last_lane)) != way.end()
                            ? last_lane
                            : graph_->edge(way.back()).lanes.front();
        routes_->extend(car);
        routes_->send(car);
    }
    // It is shown where it was put; what SUMO has elsewhere, it works off.
    const double length = origin_to_front(car.model);
    const Eigen::Vector3d ahead = ahead_of(shown);
    const Eigen::Vector3d front = shown.rear + ahead * length;
    car.slip = (front - car.sumo_front).head<2>();
    car.trail.start(front, -ahead, length);
    car.rear = shown.rear;
    car.turn_to(shown.yaw);
    car.pitch = shown.pitch;
    hold_speed(car, tick);
    return true;
}

/// SUMO's driver takes over behind this tick: in it the car goes on as fast as it is.
void Placements::hold_speed(Car& car, std::uint64_t tick) const {
    Vehicle::setPreviousSpeed(car.sumo, car.speed);
    Vehicle::setSpeedMode(car.sumo, 0);
    Vehicle::setSpeed(car.sumo, car.speed);
    car.held_in = tick;
    if (car.speed_order)  // begins anew from this speed
        car.speed_order = SpeedOrder{car.speed, car.speed_order->to, 0, 0};
}

void Placements::give(const world::CommandT& command, Car& car, std::uint64_t tick) const {
    switch (command.kind) {
        case CommandKind::follow:
            car.trajectory.reset();
            if (command.path.empty())
                break;  // enters SUMO with those whose trajectory has ended
            leave_sumo(car);
            car.trajectory.emplace(command.path, command.has_pose);
            car.trajectory_start = tick - 1;  // what the scenario saw
            break;
        case CommandKind::teleport:
            car.trajectory.reset();
            leave_sumo(car);
            stand(car, pose_of(command));
            car.speed = command.speed;
            break;
        case CommandKind::set_velocity:
            car.speed = command.speed;
            if (!car.sumo.empty())
                hold_speed(car, tick);
            break;
        default:
            break;
    }
}

void Placements::follow(Car& car, std::uint64_t tick) const {
    const double time = static_cast<double>(tick - car.trajectory_start) * step_;
    const world::Trajectory::State state = car.trajectory->at(time);
    Pose pose{car.rear, state.heading.value_or(car.yaw), car.pitch};
    pose.rear.head<2>() = state.position.head<2>();
    if (const auto found = lanes_->best(pose.rear, pose.yaw)) {
        const world::LanePoint at = world::point_at(town_->lanes[found->lane], found->at.s);
        pose.rear.z() = at.position.z();
        pose.pitch = at.pitch;
    }
    const Eigen::Vector2d ahead(std::cos(pose.yaw), std::sin(pose.yaw));
    const double speed = state.velocity.dot(ahead);
    constexpr double visible_braking = 1;  // [m/s^2]
    car.acceleration = (speed - car.speed) / step_;
    car.lamps = 0;
    if (car.acceleration < -visible_braking)
        car.lamps |= world::lamp_brake;
    car.speed = speed;
    car.standing_ticks = speed < 0.1 ? car.standing_ticks + 1 : 0;
    stand(car, pose);
}

/// As a mirror takes it: it puts a vehicle where it will be a tick on.
world::VehicleState Placements::shown(const Car& car) const {
    const Eigen::Vector3d velocity =
        car.speed * Eigen::Vector3d(std::cos(car.yaw), std::sin(car.yaw), 0);
    const Eigen::Isometry3d pose =
        world::pose(world::to_vec3(car.rear - velocity * step_), car.yaw, 0);
    return {world::to_vec3(Eigen::Vector3d(pose.translation())),
            world::to_quat(Eigen::Quaterniond(pose.linear())),
            world::to_vec3(velocity),
            world::Vec3(),
            world::Vec3(),
            0,
            0,
            car.id,
            car.model,
            car.lamps,
            0,
            0,
            0,
            0};
}

std::vector<world::VehicleState> Placements::advance(Cars& cars,
                                                     std::uint64_t tick,
                                                     std::vector<std::uint32_t>& freed) const {
    constexpr double rounding = 1e-9;  // [s]
    std::vector<world::VehicleState> beside_sumo;
    for (Car& car : cars.all()) {
        if (car.origin != Origin::scripted)
            continue;
        if (car.held_in != 0 && car.held_in != tick && !car.sumo.empty()) {
            car.held_in = 0;
            freed.push_back(car.id);
        }
        if (!car.sumo.empty())
            continue;
        const double time = static_cast<double>(tick - car.trajectory_start) * step_;
        if (car.trajectory && time > car.trajectory->end() + rounding)
            car.trajectory.reset();
        if (car.trajectory) {
            follow(car, tick);
        } else if (enter_sumo(car, tick)) {
            continue;
        } else {
            car.speed = car.acceleration = 0;
        }
        beside_sumo.push_back(shown(car));
    }
    return beside_sumo;
}

}  // namespace reprise::traffic
