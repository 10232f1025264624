#include "walkers/road_users.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::walkers {

namespace {

constexpr double shows_course = 0.3;  // [m/s] from which on one can see where to

/// One tick on: braking or gaining speed as he does, turning as he does. Brakes do not turn anybody
/// round.
void go_on(RoadUser& one, double step) {
    double speed = one.speed + step * one.acceleration;
    if (speed * one.speed <= 0 && one.acceleration * one.speed < 0)
        speed = 0;
    const double way = step * (one.speed + speed) / 2;
    one.yaw = world::wrap_angle(one.yaw + step * one.yaw_rate);
    one.course = world::wrap_angle(one.course + step * one.yaw_rate);
    one.rear_axle += way * world::ahead_of(one.course);
    one.front_s += way;
    one.speed = speed;
}

}  // namespace

void RoadUsers::look(const world::TickView& last, double step) {
    all_.clear();
    add_cars(last, step);
    add_vehicles(last, step);
    count_halts(step);
}

void RoadUsers::count_halts(double step) {
    constexpr double slow = 0.5;  // [m/s]
    constexpr double got_on = 2;  // [m]
    std::vector<Halt> halts;
    for (RoadUser& user : all_) {
        const auto before = std::lower_bound(
            halts_.begin(), halts_.end(), user.id, [](const Halt& one, std::uint32_t id) {
                return one.id < id;
            });
        const bool goes_on = before != halts_.end() && before->id == user.id &&
                             (user.rear_axle - before->place).norm() < got_on;
        if (!goes_on && std::abs(user.speed) > slow)
            continue;
        halts.push_back(goes_on ? *before : Halt{user.id, user.rear_axle, 0});
        ++halts.back().ticks;
        user.stood = halts.back().ticks * step;
    }
    std::sort(halts.begin(), halts.end(), [](const Halt& one, const Halt& other) {
        return one.id < other.id;
    });
    halts_ = std::move(halts);
}

void RoadUsers::add_to(world::Hasher& hasher) const {
    constexpr std::uint32_t for_long = 200;  // ticks
    for (const Halt& one : halts_)
        if (one.ticks > for_long) {
            hasher.add(one.id);
            hasher.add(one.ticks);
        }
}

void RoadUsers::add_cars(const world::TickView& last, double step) {
    std::size_t at = 0;
    for (const world::CarState& car : last.cars()) {
        RoadUser one;
        one.id = car.id();
        one.model = car.model();
        one.rear_axle = world::in_plan(car.position());
        one.yaw = static_cast<double>(car.yaw());
        one.course = one.yaw;
        one.speed = static_cast<double>(car.speed());
        one.acceleration = static_cast<double>(car.acceleration());
        one.lane = car.lane();
        one.front_s = static_cast<double>(car.lane_s());
        while (at < before_.size() && before_[at].id < one.id)
            ++at;
        if (at < before_.size() && before_[at].id == one.id && one.speed > shows_course) {
            const Eigen::Vector2d way = one.rear_axle - before_[at].place;
            one.yaw_rate = world::wrap_angle(one.yaw - before_[at].yaw) / step;
            one.course = std::atan2(way.y(), way.x());
        }
        go_on(one, step);
        one.velocity = one.speed * world::ahead_of(one.yaw);
        all_.push_back(one);
    }
    before_.clear();
    for (const world::CarState& car : last.cars())
        before_.push_back(
            {car.id(), world::in_plan(car.position()), static_cast<double>(car.yaw())});
}

void RoadUsers::add_vehicles(const world::TickView& last, double step) {
    for (const world::VehicleState& vehicle : last.vehicles()) {
        const Eigen::Vector3d ahead =
            world::to_eigen(vehicle.orientation()) * Eigen::Vector3d::UnitX();
        RoadUser one;
        one.id = vehicle.id();
        one.model = vehicle.model();
        one.rear_axle = world::in_plan(vehicle.position());
        one.yaw = std::atan2(ahead.y(), ahead.x());
        one.course = one.yaw;
        one.yaw_rate = vehicle.angular_velocity().z();
        one.speed = ahead.dot(world::to_eigen(vehicle.velocity()));
        one.velocity = world::in_plan(vehicle.velocity());
        one.acceleration = ahead.dot(world::to_eigen(vehicle.acceleration()));
        if (const world::Measurement* measured = world::find(last.measurements(), one.id)) {
            const world::VehicleModel& model = world::vehicle_models()[one.model];
            one.lane = measured->lane();
            one.front_s = measured->lane_s() + model.length - model.rear_overhang;
        }
        go_on(one, step);
        all_.push_back(one);
    }
}

}  // namespace reprise::walkers
