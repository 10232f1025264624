// What it must do: read SUMO's cars and signals after its step, and write them into the tick.
// What it assumes: between two steps a car moves by speed times step along its lane (SUMO's Euler
//   update), unless it changes lanes.
// How it goes: libsumo's getters, about 30 ns each, and none for what cannot have changed.
// What it keeps: nothing beside the cars.
#include <algorithm>
#include <array>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/background_state.h"
#include "world/digest.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::none;
using world::rounded;
using world::SignalColor;

SignalColor color_of(char state) {
    switch (state) {
        case 'r':
            return SignalColor::red;
        case 'u':
            return SignalColor::red_yellow;
        case 'y':
        case 'Y':
            return SignalColor::yellow;
        case 'G':
            return SignalColor::green;
        case 'g':
            return SignalColor::green_minor;
        case 's':
            return SignalColor::stop;
        default:
            return SignalColor::off;  // o: blinking yellow, O: off
    }
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

void Background::Sumo::read_car(Car& car) {
    const double speed = Vehicle::getSpeed(car.sumo);
    const double position = Vehicle::getLanePosition(car.sumo);
    // On a road of one lane: who did not move is where it was, and who moved by just its speed is
    // on the same lane (entering another one would take off the length of the last).
    const bool alone = car.lane != none && alone_on_edge[car.lane];
    const bool stands = alone && speed == 0 && car.speed == 0 && position == car.lane_position;
    const bool keeps_lane = alone && std::abs(position - car.lane_position - speed * step) < 1e-6;
    car.lane_position = position;
    // Lamps can wait: a quarter of the cars is asked in each tick, so they are at most 0.2 s old.
    if (car.lane == none || (tick + car.id) % 4 == 0)
        car.lamps = lamps_of(Vehicle::getSignals(car.sumo));
    car.acceleration = (speed - car.speed) / step;
    car.speed = speed;
    car.standing_ticks = speed < 0.1 ? car.standing_ticks + 1 : 0;

    if (stands)
        return;

    const std::string lane = keeps_lane ? town.lanes[car.lane].name : Vehicle::getLaneID(car.sumo);
    const bool new_lane = car.lane == none || town.lanes[car.lane].name != lane;
    if (new_lane) {
        car.lane = lane_index(lane);
        // What lies behind is no longer part of the plan.
        const std::uint32_t edge = car.lane == none ? none : graph.edge_of(car.lane);
        const auto here = std::find(car.route.begin(), car.route.end(), edge);
        if (here != car.route.end())
            car.route.erase(car.route.begin(), here);
    }

    // SUMO writes a height only where the network has one; elsewhere it is a number of its own.
    const libsumo::TraCIPosition p = Vehicle::getPosition3D(car.sumo);
    Eigen::Vector3d front(p.x, p.y, p.z == libsumo::INVALID_DOUBLE_VALUE ? 0.0 : p.z);
    // Where paths cross, the town's road is not the network's: see ground/mesh/level_paths.h.
    if (p.z != libsumo::INVALID_DOUBLE_VALUE && car.lane != none &&
        town.lanes[car.lane].kind == world::LaneKind::internal) {
        const world::LaneT& path = town.lanes[car.lane];
        front.z() = world::point_at(path, world::project(path, front).s).position.z();
    }
    double lane_yaw = car.yaw;
    if (car.lane != none && (new_lane || !car.slip.isZero(0))) {
        const world::LaneT& on = town.lanes[car.lane];
        lane_yaw = world::point_at(on, position * on.length / on.sumo_length).yaw;
    }
    car.trail.advance(smooth(car, front, new_lane, lane_yaw, step));
    car.rear = car.trail.rear();
    const Eigen::Vector3d body = car.trail.front() - car.rear;
    car.yaw = std::atan2(body.y(), body.x());
    car.pitch = body.z() == 0 ? 0 : std::atan2(body.z(), body.head<2>().norm());
}

void Background::Sumo::read_cars() {
    for (Car& car : cars)
        if (car.origin != Origin::parked)
            read_car(car);
}

void Background::Sumo::read_signals(world::TickDraft& next) {
    for (Program& program : programs) {
        std::string state = libsumo::TrafficLight::getRedYellowGreenState(program.name);
        if (state == program.state)
            continue;
        program.state = std::move(state);
        for (std::size_t i = program.first; i < program.first + program.count; ++i) {
            const std::uint32_t index = town.signals[i].index;
            signals[i] =
                index < program.state.size() ? color_of(program.state[index]) : SignalColor::off;
        }
    }
    next.tick.signals = signals;
}

void Background::Sumo::write_cars(world::TickDraft& next) const {
    constexpr double per_metre = 1024;
    constexpr double per_radian = 8192;
    constexpr double per_acceleration = 64;  // a lamp and a plot need no more
    auto& out = next.traffic.cars;
    auto& looks = next.traffic.looks;
    out.clear();
    looks.clear();
    out.reserve(cars.size());
    looks.reserve(cars.size());
    for (const Car& car : cars) {
        double lane_s = 0;
        if (car.lane != none)
            lane_s =
                car.lane_position * town.lanes[car.lane].length / town.lanes[car.lane].sumo_length;
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
        looks.push_back(world::drawn_look(episode.seed, car.id));
    }
}

namespace {

/// What a car is and has been told, in one number.
std::uint32_t flags_of(const Car& car) {
    return static_cast<std::uint32_t>(car.origin) + (std::uint32_t{car.dead_end} << 2U) +
           (std::uint32_t{car.sumo.empty()} << 3U) +
           (std::uint32_t{car.speed_order.has_value()} << 4U) +
           (std::uint32_t{car.lane_order.has_value()} << 5U) + (std::uint32_t{car.model} << 8U) +
           (std::uint32_t{car.lamps} << 16U);
}

/// What every car keeps. Left out is what nothing is computed from (acceleration, pitch) or what
/// follows (SUMO's name of a car).
struct CarDigest {
    std::array<double, 12> numbers;
    std::uint64_t trail;
    std::array<std::uint32_t, 8> indices;
};

static_assert(sizeof(CarDigest) == 136, "no padding");

CarDigest kept_of(const Car& car) {
    return {{car.rear.x(),
             car.rear.y(),
             car.rear.z(),
             car.yaw,
             car.speed,
             car.lane_position,
             car.sumo_front.x(),
             car.sumo_front.y(),
             car.sumo_front.z(),
             car.slip.x(),
             car.slip.y(),
             car.trail.travelled()},
            car.trail.points_digest(),
            {car.id,
             car.lane,
             flags_of(car),
             car.draws,
             car.standing_ticks,
             car.last_lane,
             static_cast<std::uint32_t>(car.route.size()),
             0}};
}

}  // namespace

/// Gathered first: a digest of many small pieces costs more than of few large ones.
std::uint64_t Background::Sumo::digest() const {
    std::vector<CarDigest> kept;
    kept.reserve(cars.size());
    std::vector<std::uint32_t> routes;
    routes.reserve(cars.size() * 24);
    for (const Car& car : cars) {
        kept.push_back(kept_of(car));
        routes.insert(routes.end(), car.route.begin(), car.route.end());
    }
    world::Hasher hasher;
    hasher.add(std::span<const CarDigest>(kept));
    hasher.add(std::span<const std::uint32_t>(routes));
    for (const Car& car : cars) {
        if (car.speed_order) {
            hasher.add(car.speed_order->from);
            hasher.add(car.speed_order->to);
            hasher.add(car.speed_order->start);
            hasher.add(car.speed_order->ticks);
        }
        if (car.lane_order) {
            hasher.add(car.lane_order->lane);
            hasher.add(car.lane_order->duration);
            hasher.add(car.lane_order->until);
        }
    }
    hasher.add(next_id);
    hasher.add(place_draws);
    hasher.add(std::span<const SignalColor>(signals));
    for (const Program& program : programs)
        hasher.add_text(program.state);
    mirrors.add_to(hasher);
    return hasher.digest64();
}

}  // namespace reprise::traffic
