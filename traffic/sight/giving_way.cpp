#include "traffic/sight/giving_way.h"

#include <algorithm>
#include <cmath>

#include "traffic/cars/fleet.h"
#include "traffic/sight/braking.h"
#include "traffic/sight/footprints.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

constexpr double least_speed = 3;    // [m/s] of one that comes; who is slower lets others go
constexpr double turns_at = 8;       // [m/s] at most, who turns and can wait,
constexpr double starts_at = 3;      // and who goes straight on: faster, others wait for him
constexpr double straight = 0.9;     // cosine between body and way
constexpr double room = 0.3;         // [m] beside the comer
constexpr double looked_at = 16;     // [m] of a car's way
constexpr double spacing = 0.5;      // [m] of the steps on it
constexpr double well_before = 1;    // [s] between who crosses first and the comer,
constexpr double well_behind = 0.3;  // and between the comer and who crosses then
constexpr double same_way = 0.985;   // cosine: the one follows the other, or drives beside it
constexpr double beside = 0.7;       // of who drives beside a long one Sweeping thinks
constexpr double pulls_away = 2;     // [m/s^2] of who clears a junction,
constexpr double in_bends = 5;       // [m/s] up to this,
constexpr double soonest = 3;        // [m/s^2] and nobody of the fleet starts quicker
constexpr double brakes = 1;         // [m/s^2] of a comer who lets others go,
constexpr double easily = 4;         // if it needs no more than this

/// [s] for so many metres, for one who speeds up to `top` [m/s] at most.
double time_for(double metres, double speed, double acceleration, double top) {
    const double gained = std::max(top - speed, 0.0);
    const double until_then = (speed + top) / 2 * gained / acceleration;  // [m]
    if (metres > until_then)
        return gained / acceleration + (metres - until_then) / std::max(speed, top);
    return (std::sqrt(speed * speed + 2 * acceleration * metres) - speed) / acceleration;
}

}  // namespace

void GivingWay::look(const world::TickView& last) {
    comers_.clear();
    for (const world::VehicleState& vehicle : last.vehicles()) {
        const double speed = world::to_eigen(vehicle.velocity()).head<2>().norm();
        const bool is_wreck = vehicle.id() >= world::first_background_id;
        if (!is_wreck && speed >= least_speed)
            comers_.push_back(comer_of(vehicle));
    }
}

/// It turns as it turns now, and keeps its speed.
GivingWay::Comer GivingWay::comer_of(const world::VehicleState& vehicle) {
    const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
    const Eigen::Vector2d velocity = world::to_eigen(vehicle.velocity()).head<2>();
    BodyBox body;
    body.half_length = model.length / 2 + room;
    body.half_width = model.width / 2 + room;
    body.ahead = world::level_direction(vehicle.orientation());
    body.middle =
        world::in_plan(vehicle.position()) + (model.length / 2 - model.rear_overhang) * body.ahead;
    Comer comer;
    comer.z = vehicle.position().z();
    comer.speed = velocity.norm();
    comer.braking = -world::to_eigen(vehicle.acceleration()).head<2>().dot(body.ahead);
    const Eigen::Vector2d turn = world::ahead_of(vehicle.angular_velocity().z() * moment);
    Eigen::Vector2d step = moment * velocity;
    const auto turned = [&turn](const Eigen::Vector2d& v) {
        return Eigen::Vector2d(turn.x() * v + turn.y() * world::turned_left(v));
    };
    for (std::size_t i = 0; i < moments; ++i) {
        comer.bodies[i] = body;
        comer.areas[i / in_stretch].take(body.middle, body.half_length + body.half_width);
        body.middle += step;
        step = turned(step);
        body.ahead = turned(body.ahead);
    }
    for (const world::Box& area : comer.areas)
        comer.area.take(area);
    return comer;
}

/// Outside of junctions there are other rules.
bool GivingWay::is_in_junction(const Car& car, const WayAhead& way) const {
    const auto is_inside = [this](std::uint32_t lane) {
        return lines_->town().lanes[lane].kind == world::LaneKind::internal;
    };
    return is_inside(car.lane) || std::any_of(way.lanes().begin(), way.lanes().end(), is_inside);
}

/// Who is nearer than the room beside the comer's way is before it still.
GivingWay::Conflict GivingWay::conflict_of(const WayAhead& way, const Comer& comer) {
    const BodyBox now = way.at(0);
    if (std::any_of(comer.bodies.begin(), comer.bodies.end(), [&](const BodyBox& there) {
            return overlap(now, there.widened(-room));
        }))
        return {};
    Conflict conflict;
    const double end = std::min(looked_at, way.length());
    for (double driven = spacing; driven <= end; driven += spacing) {
        const BodyBox body = way.at(driven);
        world::Box around;
        around.take(body.middle, body.half_length + body.half_width);
        bool is_met = false;
        for (std::size_t i = 0; i < moments; ++i) {
            if (i % in_stretch == 0 && !world::touch(around, comer.areas[i / in_stretch])) {
                i += in_stretch - 1;  // nowhere near in any of these moments
                continue;
            }
            const BodyBox& there = comer.bodies[i];
            if (!overlap(body, there) ||
                (!conflict.is_any && body.ahead.dot(there.ahead) > same_way))
                continue;
            const double time = static_cast<double>(i) * moment;
            if (!conflict.is_any)
                conflict = {driven, driven, time, time, true};
            conflict.comes = std::min(conflict.comes, time);
            conflict.goes = std::max(conflict.goes, time);
            is_met = true;
        }
        if (conflict.is_any && !is_met)
            return conflict;
        conflict.end = driven + spacing;
    }
    conflict.end = world::infinity;
    return conflict;
}

bool GivingWay::has_to_wait(const Car& car, const Comer& comer, const Conflict& conflict) const {
    if (!conflict.is_any)
        return false;
    if (std::isfinite(conflict.end) &&
        time_for(conflict.end, car.speed, pulls_away, in_bends) + well_before < conflict.comes)
        return false;
    const bool passes = conflict.goes < (moments - 1) * moment;
    if (passes &&
        time_for(conflict.begin, car.speed, soonest, world::infinity) > conflict.goes + well_behind)
        return false;
    const bool lets_go = comer.braking > brakes && comer.speed < 2 * easily * conflict.comes;
    const double to_stop = car.speed * (step_ + car.speed / (2 * emergency_braking(car.model)));
    return !lets_go && to_stop < conflict.begin;
}

double GivingWay::allowed_speed(const Car& car) const {
    if (comers_.empty() || car.speed > turns_at)
        return world::infinity;
    // Of most cars no junction is near, or nobody comes to where they will be, wherever their way
    // leads.
    constexpr double more = 10;  // [m] than its way and its body
    const world::LaneT& here = lines_->town().lanes[car.lane];
    if (here.kind != world::LaneKind::internal &&
        here.length * (1 - car.lane_position / here.sumo_length) > looked_at + more)
        return world::infinity;
    const double far = looked_at + 2 * world::vehicle_models()[car.model].length + more;
    world::Box around;
    around.take(car.rear.head<2>(), far);
    if (std::none_of(comers_.begin(), comers_.end(), [&](const Comer& comer) {
            return world::touch(around, comer.area);
        }))
        return world::infinity;
    const world::Box area = area_ahead(car, *lines_, *graph_, looked_at);
    const bool is_long = world::vehicle_models()[car.model].length > longest_short_car;
    const auto is_near = [&](const Comer& comer) {
        const bool sweeps = is_long && comer.bodies.front().ahead.dot(car.ahead) > beside;
        return !sweeps && world::touch(area, comer.area) &&
               std::abs(comer.z - car.rear.z()) < world::level_clearance;
    };
    if (std::none_of(comers_.begin(), comers_.end(), is_near))
        return world::infinity;
    const WayAhead way(car, *lines_, *graph_, looked_at);
    const bool turns = way.at(looked_at).ahead.dot(way.at(0).ahead) < straight;
    if (!is_in_junction(car, way) || (!turns && car.speed > starts_at))
        return world::infinity;
    const Braking braking{
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    double allowed = world::infinity;
    for (const Comer& comer : comers_) {
        if (!is_near(comer))
            continue;
        const Conflict conflict = conflict_of(way, comer);
        if (has_to_wait(car, comer, conflict))
            allowed = std::min(allowed, braking.speed_before(conflict.begin - spacing, 0, 0));
    }
    return allowed;
}

}  // namespace reprise::traffic
