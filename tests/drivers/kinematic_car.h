#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "drivers/driver.h"
#include "tests/support/worlds.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::test {

/// [rad] of a turn into a side road.
inline constexpr double quarter = std::numbers::pi / 2;

/// A bicycle without mass: wheels that roll where they point. Enough to judge a driver by, and
/// nothing that could hide its mistakes.
struct KinematicCar {
    double x = 0, y = 0, yaw = 0, speed = 0;
    double steering_angle = 0, odometer = 0;
    std::uint16_t model = 0;
    double slope = 0;  ///< what the ground rises per metre along x

    void advance(const world::Control& control, double time) {
        const world::VehicleModel& car = world::vehicle_models()[model];
        constexpr int substeps = 10;
        const double step = time / substeps;
        for (int i = 0; i < substeps; ++i) {
            const double wanted = control.steer() * car.max_steering_angle;
            const double turn = 0.7 * step;  // wheels turn at 0.7 rad/s
            steering_angle += std::clamp(wanted - steering_angle, -turn, turn);
            const double drive = control.throttle() * (control.reverse() ? -3 : 3) * step;
            const double brake = control.brake() * 9 * step;
            speed += drive - 9.81 * slope * std::cos(yaw) * step;
            speed = std::copysign(std::max(std::abs(speed) - brake, 0.0), speed);
            x += speed * std::cos(yaw) * step;
            y += speed * std::sin(yaw) * step;
            yaw += speed * std::tan(steering_angle) / car.wheelbase * step;
            odometer += speed * step;
        }
    }

    world::VehicleState state(std::uint32_t id) const {
        const world::Quat orientation(std::cos(yaw / 2), 0, 0, std::sin(yaw / 2));
        const world::Vec3 velocity(speed * std::cos(yaw), speed * std::sin(yaw), 0);
        const double rate =
            speed * std::tan(steering_angle) / world::vehicle_models()[model].wheelbase;
        return {world::Vec3(x, y, 0),
                orientation,
                velocity,
                world::Vec3(0, 0, rate),
                world::Vec3(0, 0, 0),
                steering_angle,
                odometer,
                id,
                model,
                0,
                0,
                0,
                0,
                0};
    }

    double front() const {
        const world::VehicleModel& car = world::vehicle_models()[model];
        return car.length - car.rear_overhang;
    }
};

/// A driver in a kinematic car, in a world that the test moves by hand.
class Drive {
  public:
    explicit Drive(world::TownT town_of_test,
                   std::uint64_t seed = 7,
                   std::uint16_t model = 0,
                   std::span<const world::Obstacle> obstacles = {})
        : town(std::move(town_of_test)),
          lanes(town),
          map(town, lanes, obstacles),
          start(episode()) {
        start.seed = seed;
        car.model = model;
        autopilot.emplace(1u, model, start, map);
    }

    void place(std::uint32_t lane, double s, double speed) {
        const world::LanePoint at = world::point_at(town.lanes[lane], s);
        z = at.position.z() - car.slope * at.position.x();
        car.x = at.position.x();
        car.y = at.position.y();
        car.yaw = at.yaw;
        car.speed = speed;
    }

    void step() {
        world::TickDraft draft;
        draft.tick.road_friction = 1;
        draft.tick.index = ++tick;
        draft.tick.vehicles = {car.state(1)};
        draft.tick.vehicles[0].mutable_position().mutate_z(z + car.slope * car.x);
        draft.tick.vehicles.insert(draft.tick.vehicles.end(), others.begin(), others.end());
        std::ranges::sort(draft.tick.vehicles, {}, &world::VehicleState::id);
        draft.tick.signals = signals;
        draft.tick.weather = start.weather;
        draft.traffic.cars = cars;
        draft.traffic.walkers = walkers;
        draft.tick.props = props;
        draft.tick.measurements = measurements;
        draft.tick.controls = {control};
        draft.tick.controls[0].mutate_actor(1);
        const world::SealedTick sealed = world::seal(draft, {});
        control = autopilot->decide(sealed.view());
        car.advance(control, 0.05);
    }

    double seconds() const { return static_cast<double>(tick) * 0.05; }

    /// Distance of the middle between the axles from the nearest centre line for cars.
    double off_centre() const {
        const double ahead = world::vehicle_models()[car.model].wheelbase / 2;
        const Eigen::Vector3d middle(
            car.x + ahead * std::cos(car.yaw), car.y + ahead * std::sin(car.yaw), 0);
        double least = 1e9;
        for (const world::LaneT& lane : town.lanes)
            if (world::is_for_cars(lane))
                least = std::min(least, world::project(lane, middle).distance);
        return least;
    }

    world::TownT town;
    world::LaneMap lanes;
    drivers::RoadMap map;
    world::EpisodeT start;
    KinematicCar car;
    std::optional<drivers::Autopilot> autopilot;
    std::vector<world::VehicleState> others;
    std::vector<world::CarState> cars;
    std::vector<world::WalkerState> walkers;
    std::vector<world::PropState> props;
    std::vector<world::Measurement> measurements;
    std::vector<world::SignalColor> signals;
    world::Control control;
    std::uint64_t tick = 0;
    double z = 0;  ///< of the ground where x = 0, under the car
};

/// Draws lanes: a point that moves ahead and turns.
class Turtle {
  public:
    Turtle(double x, double y, double yaw) : x_(x), y_(y), yaw_(yaw) {
        line_.emplace_back(x, y, 0);
    }

    Turtle& ahead(double length) { return arc(length, 0); }

    /// Positive angles turn left.
    Turtle& turn(double angle, double radius) {
        return arc(std::abs(angle) * radius, angle > 0 ? 1 / radius : -1 / radius);
    }

    std::vector<world::Vec3> line() const { return line_; }

  private:
    Turtle& arc(double length, double curvature) {
        const int steps = curvature == 0 ? 1 : static_cast<int>(std::ceil(length));
        for (int i = 0; i < steps; ++i) {
            const double step = length / steps;
            x_ += step * std::cos(yaw_ + curvature * step / 2);
            y_ += step * std::sin(yaw_ + curvature * step / 2);
            yaw_ += curvature * step;
            line_.emplace_back(x_, y_, 0);
        }
        return *this;
    }

    double x_, y_, yaw_;
    std::vector<world::Vec3> line_;
};

inline world::LaneT make_lane(const char* name,
                              const Turtle& turtle,
                              double limit = 13.89,
                              world::LaneKind kind = world::LaneKind::driving) {
    world::LaneT lane;
    lane.name = lane.edge = name;
    lane.kind = kind;
    lane.centre = turtle.line();
    lane.width = 3.5;
    lane.speed_limit = limit;
    for (std::size_t i = 1; i < lane.centre.size(); ++i)
        lane.length +=
            (world::to_eigen(lane.centre[i]) - world::to_eigen(lane.centre[i - 1])).norm();
    lane.sumo_length = lane.length;
    lane.left = lane.right = lane.opposite = lane.junction = world::none;
    return lane;
}

inline world::Link make_link(std::uint32_t to,
                             std::uint32_t via,
                             world::Turn turn,
                             bool yields = false,
                             std::uint32_t signal = world::none) {
    return {to, via, signal, turn, yields, 0};
}

/// A way that is one lane. `limit` [m/s]
inline world::TownT one_lane(const Turtle& turtle, double limit = 13.89) {
    world::TownT town;
    town.name = "one_lane";
    town.lanes.push_back(make_lane("way", turtle, limit));
    return town;
}

}  // namespace reprise::test
