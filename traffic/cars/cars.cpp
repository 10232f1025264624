#include "traffic/cars/cars.h"

#include <algorithm>
#include <array>
#include <utility>

#include <libsumo/libsumo.h>

namespace reprise::traffic {

namespace {

world::EventT event_of(world::EventKind kind, const Car& car) {
    world::EventT event;
    event.kind = kind;
    event.actor = car.id;
    event.position = world::Vec3(car.rear.x(), car.rear.y(), car.rear.z());
    return event;
}

bool has_lower_id(const Car& car, std::uint32_t id) {
    return car.id < id;
}

/// What a car is and has been told, in one number.
std::uint32_t flags_of(const Car& car) {
    return static_cast<std::uint32_t>(car.origin) + (std::uint32_t{car.dead_end} << 2U) +
           (std::uint32_t{car.sumo.empty()} << 3U) +
           (std::uint32_t{car.speed_order.has_value()} << 4U) +
           (std::uint32_t{car.lane_order.has_value()} << 5U) +
           (std::uint32_t{car.keeps_lane} << 6U) + (std::uint32_t{car.ignores_lights} << 7U) +
           (std::uint32_t{car.model} << 8U) + (std::uint32_t{car.lamps} << 16U);
}

/// Of most speed orders nothing.
void add_rarer(world::Hasher& hasher, const SpeedOrder& order) {
    if (order.shape != world::Shape::linear)
        hasher.add(order.shape);
    if (!order.reacts)
        hasher.add(order.brakes);
}

void add_offset(world::Hasher& hasher, const OffsetOrder& order, double offset) {
    for (const double number : {order.change.from, order.change.to, order.change.duration, offset})
        hasher.add(number);
    hasher.add(order.change.shape);
    hasher.add(order.start);
}

/// What every car keeps. Left out is what nothing is computed from (acceleration, pitch) or what
/// follows (SUMO's name of a car).
struct CarDigest {
    std::array<double, 16> numbers;
    std::uint64_t trail;
    std::array<std::uint32_t, 10> indices;
};

static_assert(sizeof(CarDigest) == 176, "no padding");

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
             car.aside_wanted,
             car.aside_limit,
             car.bend_limit,
             car.trail.travelled(),
             car.stuck_from},
            car.trail.points_digest(),
            {car.id,
             car.lane,
             flags_of(car),
             car.draws,
             car.standing_ticks,
             car.stuck_ticks,
             car.last_lane,
             static_cast<std::uint32_t>(car.route.size()),
             std::uint32_t{car.held_back},
             car.skips}};
}

}  // namespace

const Car* Cars::find(std::uint32_t id) const {
    const auto at = std::lower_bound(cars_.begin(), cars_.end(), id, has_lower_id);
    return at != cars_.end() && at->id == id ? &*at : nullptr;
}

Car* Cars::find(std::uint32_t id) {
    return const_cast<Car*>(std::as_const(*this).find(id));
}

Car& Cars::add(Car car, const std::string& text, std::uint32_t line, world::TickDraft& next) {
    world::EventT event = event_of(world::EventKind::spawned, car);
    event.text = text;
    event.line = line;
    next.tick.events.push_back(std::move(event));
    const auto at = std::lower_bound(cars_.begin(), cars_.end(), car.id, has_lower_id);
    return *cars_.insert(at, std::move(car));
}

void Cars::remove(std::size_t index, world::TickDraft& next) {
    next.tick.events.push_back(event_of(world::EventKind::despawned, cars_[index]));
    cars_.erase(cars_.begin() + static_cast<std::ptrdiff_t>(index));
}

void Cars::remove_from_sumo(std::size_t index, world::TickDraft& next) {
    if (!cars_[index].sumo.empty())
        libsumo::Vehicle::remove(cars_[index].sumo);
    remove(index, next);
}

void Cars::hand_over(std::size_t index) {
    if (!cars_[index].sumo.empty())
        libsumo::Vehicle::remove(cars_[index].sumo);
    cars_.erase(cars_.begin() + static_cast<std::ptrdiff_t>(index));
}

void Cars::add_motions_to(world::Hasher& hasher) const {
    for (const Car& car : cars_)
        hasher.add(std::array{car.sumo_front.x(),
                              car.sumo_front.y(),
                              car.sumo_front.z(),
                              car.rear.x(),
                              car.rear.y(),
                              car.rear.z(),
                              car.yaw,
                              car.speed,
                              car.lane_position});
}

void Cars::add_to(world::Hasher& hasher) const {
    hasher.add(std::uint64_t{cars_.size()});
    std::uint64_t edges = 0;
    for (const Car& car : cars_) {
        hasher.add(kept_of(car));
        edges += car.route.size();
    }
    hasher.add(edges);
    for (const Car& car : cars_)
        hasher.add_bytes(car.route.data(), car.route.size() * sizeof(car.route[0]));
    for (const Car& car : cars_) {
        if (car.speed_order) {
            hasher.add(car.speed_order->from);
            hasher.add(car.speed_order->to);
            hasher.add(car.speed_order->start);
            hasher.add(car.speed_order->ticks);
            add_rarer(hasher, *car.speed_order);
        }
        if (car.lane_order) {
            hasher.add(car.lane_order->lane);
            hasher.add(car.lane_order->duration);
            hasher.add(car.lane_order->until);
        }
        if (car.offset_order)
            add_offset(hasher, *car.offset_order, car.offset);
        if (car.pass) {
            hasher.add(car.pass->lane);
            hasher.add(car.pass->end);
            hasher.add(car.pass->pace);
            if (car.pass->joins)
                hasher.add(car.pass->joins);
        }
        if (car.on_call || car.goes_first || car.makes_way) {
            hasher.add(car.on_call);
            hasher.add(car.goes_first);
            hasher.add(car.makes_way);
        }
        if (!car.waits_for.empty() || car.pushes_until != 0 || car.brushes_until != 0 ||
            car.ignores_standing) {
            hasher.add(std::span<const std::uint32_t>(car.waits_for));
            hasher.add(std::span<const std::uint32_t>(car.pushes_past));
            hasher.add(car.pushes_until);
            hasher.add(car.brushes_until);
            hasher.add(car.ignores_standing);
        }
        if (car.lets_in_until != 0) {
            hasher.add(car.lets_in_until);
            hasher.add(car.lets_in_way);
        }
        if (!car.blocked_by.empty())
            hasher.add(std::span<const std::uint32_t>(car.blocked_by));
        if (car.leans)
            hasher.add(car.leans);
        if (car.boxed_in)
            hasher.add(car.boxed_in);
        if (car.wedged_until != 0)
            hasher.add(car.wedged_until);
        if (car.trajectory) {
            car.trajectory->add_to(hasher);
            hasher.add(car.trajectory_start);
        }
        // Until it is put elsewhere, its stops follow from the commands, and nothing reads them.
        if (car.entries > 1 || (car.sumo.empty() && car.origin == Origin::scripted)) {
            hasher.add(car.entries);
            hasher.add(car.held_in);
            hasher.add(std::span<const std::uint32_t>(car.stops));
            hasher.add(std::uint64_t{car.waiting.size()});
        }
    }
}

}  // namespace reprise::traffic
