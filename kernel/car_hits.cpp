#include "kernel/car_hits.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

constexpr double least_car_speed = 0.5;  // [m/s] as WalkerHits::least_vehicle_speed
constexpr double longest_half_car = 12;  // [m] from its rear axle

struct Touch {
    Eigen::Vector2d place;
    double impulse = 0;
};

/// Of a place on it, ahead and to the left of its rear axle: a bus's tail swings out sideways.
/// [m/s]
Eigen::Vector2d velocity_at(const Eigen::Vector2d& p_car,
                            const world::CarState& car,
                            const world::CarState* before,
                            double step_seconds) {
    const auto place = [&](const world::CarState& state) -> Eigen::Vector2d {
        const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(state.yaw()));
        return world::in_plan(state.position()) + p_car.x() * ahead +
               p_car.y() * world::turned_left(ahead);
    };
    const double speed = static_cast<double>(car.speed());
    const Eigen::Vector2d along = speed * world::ahead_of(static_cast<double>(car.yaw()));
    if (before == nullptr)
        return along;
    const Eigen::Vector2d driven = (place(car) - place(*before)) / step_seconds;
    return driven.norm() < 2 * speed + 1 ? driven : along;  // or it was put elsewhere
}

/// Does the car's box hold part of the walker's circle, and push it?
std::optional<Touch> touch(const world::CarState& car,
                           const world::TickView& last,
                           double step_seconds,
                           const world::WalkerState& walker,
                           const Eigen::Vector2d& walker_velocity) {
    const world::VehicleModel& model = world::vehicle_models()[car.model()];
    const world::WalkerModel& person = world::walker_models()[walker.model()];
    const double rise = walker.position().z() - car.position().z();
    if (rise > model.height || rise < -person.height)
        return std::nullopt;
    const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(car.yaw()));
    const Eigen::Vector2d left = world::turned_left(ahead);
    const Eigen::Vector2d rear(car.position().x(), car.position().y());
    const Eigen::Vector2d offset =
        Eigen::Vector2d(walker.position().x(), walker.position().y()) - rear;
    const double x = offset.dot(ahead);
    const double y = offset.dot(left);
    const Eigen::Vector2d nearest(
        std::clamp(x, -model.rear_overhang, model.length - model.rear_overhang),
        std::clamp(y, -model.width / 2, model.width / 2));
    const Eigen::Vector2d out(x - nearest.x(), y - nearest.y());
    const double distance = out.norm();
    if (distance > person.shoulder_width / 2)
        return std::nullopt;
    // Outwards from the box; ahead when the walker is inside already.
    const Eigen::Vector2d outwards =
        distance > 0 ? Eigen::Vector2d((out.x() * ahead + out.y() * left) / distance) : ahead;
    const world::CarState* before = world::find(last.cars(), car.id());
    const double car_speed = velocity_at(nearest, car, before, step_seconds).dot(outwards);
    const double closing = car_speed - walker_velocity.dot(outwards);
    if (car_speed < least_car_speed || closing <= 0)
        return std::nullopt;
    return Touch{rear + nearest.x() * ahead + nearest.y() * left, person.mass * closing};
}

/// A walker is down from the tick behind its hit on: the touch is over.
void end_touches(double step_seconds, const world::TickView& last, world::TickDraft& next) {
    const auto* events = last.tick->events();
    if (events == nullptr)
        return;
    for (const world::Event* hit : *events) {
        if (hit->kind() != world::EventKind::collision ||
            world::find(last.cars(), hit->actor()) == nullptr ||
            world::find(last.walkers(), hit->other()) == nullptr)
            continue;
        world::EventT event;
        event.kind = world::EventKind::collision_ended;
        event.actor = hit->actor();
        event.other = hit->other();
        event.position = *hit->position();
        event.value = hit->value();
        event.duration = step_seconds;
        next.tick.events.push_back(event);
    }
}

}  // namespace

void note_hit_walkers(double step_seconds, const world::TickView& last, world::TickDraft& next) {
    end_touches(step_seconds, last, next);
    const auto& walkers = next.traffic.walkers;
    if (walkers.empty() || next.traffic.cars.empty())
        return;
    // By x, so that each walker looks at the few cars around.
    std::vector<const world::CarState*> cars;
    cars.reserve(next.traffic.cars.size());
    for (const world::CarState& car : next.traffic.cars)
        if (static_cast<double>(car.speed()) >= least_car_speed)
            cars.push_back(&car);
    std::sort(cars.begin(), cars.end(), [](const auto* one, const auto* other) {
        return std::make_pair(one->position().x(), one->id()) <
               std::make_pair(other->position().x(), other->id());
    });
    for (const world::WalkerState& walker : walkers) {
        if (walker.down())
            continue;
        const double x = walker.position().x();
        const double y = walker.position().y();
        auto at = std::lower_bound(
            cars.begin(), cars.end(), x - longest_half_car, [](const auto* car, double low) {
                return car->position().x() < low;
            });
        for (; at != cars.end() && (*at)->position().x() <= x + longest_half_car; ++at) {
            if (std::abs((*at)->position().y() - y) > longest_half_car)
                continue;
            const Eigen::Vector2d velocity = static_cast<double>(walker.speed()) *
                                             world::ahead_of(static_cast<double>(walker.yaw()));
            const auto hit = touch(**at, last, step_seconds, walker, velocity);
            if (!hit)
                continue;
            world::EventT event;
            event.kind = world::EventKind::collision;
            event.actor = (*at)->id();
            event.other = walker.id();
            event.position = world::Vec3(hit->place.x(), hit->place.y(), walker.position().z());
            event.value = hit->impulse;
            next.tick.events.push_back(event);
            break;  // once is enough to fall
        }
    }
}

}  // namespace reprise::kernel
