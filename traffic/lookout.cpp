#include "traffic/lookout.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/cars/vehicle_lookup.h"
#include "traffic/sight/braking.h"
#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double steepest_way = 0.45;  // [m] aside for each metre driven, of one who pulls out
constexpr double steepest_pass = 0.9;  // of one who has stood behind what it passes,
constexpr double corner_reach = 0.25;  // [m] and how far its bumper's corner reaches out then
constexpr double walking_pace = 1.4;   // [m/s]
constexpr double starting = 3;         // [m/s^2] no car of the fleet starts quicker

}  // namespace

/// The way of one car's body, and what is found on it.
struct Lookout::Corridor {
    Braking braking;
    double half_width;  ///< [m]
    double aside;       ///< [m] left of its lane's middle
    double wanted_aside;
    double most_gap;  ///< [m] that it leaves behind what it stops for
    double reach;     ///< [m] that it looks ahead
    double z;
    double steepest;  ///< [m] aside for each metre driven
    std::uint32_t id;
    double allowed = world::infinity;  ///< [m/s]

    /// Where its middle is when the bumper has come so far.
    double aside_at(double distance) const {
        const double off = aside - wanted_aside;
        const double left = std::max(std::abs(off) - steepest * std::max(distance, 0.0), 0.0);
        return wanted_aside + std::copysign(left, off);
    }

    void meet(double distance, double right, double left, const Obstruction& other) {
        const double middle = aside_at(distance);
        if (left < middle - half_width || right > middle + half_width)
            return;
        double wanted = braking.speed_before(distance, std::min(other.gap, most_gap), other.speed);
        // People who stand at the kerb, waiting for it to pass, are passed at their own pace.
        if (left - other.spare < middle - half_width || right + other.spare > middle + half_width)
            wanted = std::max(wanted, walking_pace);
        allowed = std::min(allowed, wanted);
    }
};

/// `start` [m] from the front bumper to the lane's start, `aside` [m] that the lane lies left of
/// the car's own.
void Lookout::look_on(std::uint32_t lane, double start, double aside, Corridor& corridor) const {
    constexpr double nose = 0.3;  // [m] what begins further behind the bumper is beside the car
    for (const Obstruction& one : obstructions_.on(lane)) {
        double distance = start + one.begin;
        if (one.id == corridor.id || distance > corridor.reach || start + one.end < -nose ||
            std::abs(one.z - corridor.z) > world::level_clearance + corridor.reach * 0.1)
            continue;
        // Of what stands askew a corner beside the car says nothing of the body in front of it.
        if (distance < -nose) {
            const double middle = corridor.aside_at(0) - aside;
            distance = start + one.begin_between(middle - corridor.half_width,
                                                 middle + corridor.half_width);
            if (distance < -nose || distance > corridor.reach)
                continue;
        }
        corridor.meet(distance, one.right + aside, one.left + aside, one);
    }
}

/// This lane, and those behind it on the car's route, with the metres from the front bumper to
/// their start.
template <typename Visit>
void Lookout::visit_way(
    std::uint32_t lane, double start, double reach, const Car& car, const Visit& visit) const {
    visit(lane, start);
    const world::LaneT& here = town_->lanes[lane];
    const double end = start + here.length;
    if (end > reach)
        return;
    const std::uint32_t edge = graph_->edge_of(lane);
    if (here.kind == world::LaneKind::internal) {
        if (!here.links.empty()) {
            const world::Link& link = here.links.front();
            visit_way(link.via() != none ? link.via() : link.to(), end, reach, car, visit);
        }
        return;
    }
    const auto at = std::find(car.route.begin(), car.route.end(), edge);
    if (at == car.route.end() || at + 1 == car.route.end())
        return;
    for (const world::Link& link : here.links)
        if (link.to() != none && graph_->edge_of(link.to()) == *(at + 1))
            visit_way(link.via() != none ? link.via() : link.to(), end, reach, car, visit);
}

/// Is nothing on any lane that the car may look at, wherever on its own lane it is? Tells without
/// the way from the lane to the car, which costs more than all of this.
bool Lookout::is_clear(const Car& car, double reach) const {
    const world::LaneT& lane = town_->lanes[car.lane];
    for (const std::uint32_t beside : {lane.left, lane.right})
        if (beside != none && obstructions_.any_on(beside))
            return false;
    bool clear = true;
    visit_way(car.lane, -lane.length - 1, reach, car, [&](std::uint32_t ahead, double) {
        clear = clear && !obstructions_.any_on(ahead);
    });
    return clear;
}

/// SUMO's cars on both lanes, for one who passes something: to SUMO it is still in its own lane.
void Lookout::look_at_cars(const Cars& cars, double s, const Car& car, Corridor& corridor) const {
    const world::LanePoint on = world::point_at(town_->lanes[car.lane], s);
    const Eigen::Vector2d ahead = world::ahead_of(on.yaw);
    for (const Car& other : cars.all()) {
        if (other.id == car.id || other.origin == Origin::parked)
            continue;
        const world::VehicleModel& model = world::vehicle_models()[other.model];
        const Eigen::Vector2d& direction = other.ahead;
        const Eigen::Vector2d offset = other.rear.head<2>() +
                                       (model.length / 2 - model.rear_overhang) * direction -
                                       on.position.head<2>();
        const double half = model.length / 2 * std::abs(direction.dot(ahead)) +
                            model.width / 2 * std::abs(world::cross(direction, ahead));
        const double half_across = model.width / 2 * std::abs(direction.dot(ahead)) +
                                   model.length / 2 * std::abs(world::cross(direction, ahead));
        const double distance = offset.dot(ahead) - half;
        const double aside = world::cross(ahead, offset);
        if (distance < -0.3 || distance > corridor.reach)
            continue;
        Obstruction one;
        one.speed = std::max(other.speed * direction.dot(ahead), 0.0);
        one.gap = 2;
        corridor.meet(distance, aside - half_across, aside + half_across, one);
    }
}

/// Who changes lanes goes aside by SUMO's pace, which is less than a car could: to the middle of
/// the lane beside until it is over the line, to that of its own then.
void Lookout::follow_lane_change(const Car& car, Corridor& corridor) const {
    using libsumo::Vehicle;
    constexpr double moves = 0.1;   // [m/s] sideways
    constexpr double crawls = 0.5;  // [m/s]
    const double sideways = Vehicle::getLateralSpeed(car.sumo);
    if (std::abs(sideways) < moves)
        return;
    const world::LaneT& lane = town_->lanes[car.lane];
    const std::uint32_t beside = corridor.aside > 0 ? lane.left : lane.right;
    if (sideways * Vehicle::getLateralLanePosition(car.sumo) > 0 && beside != none)
        corridor.wanted_aside =
            std::copysign((lane.width + town_->lanes[beside].width) / 2, corridor.aside);
    corridor.steepest =
        std::min(std::abs(sideways) / std::max(car.speed, crawls), corridor.steepest);
}

double Lookout::allowed_speed(const Car& car, const Cars& cars) const {
    constexpr double easy_braking = 2;  // [m/s^2] nobody begins to brake earlier
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const Eigen::Vector3d& front = car.trail.front();
    Corridor corridor{};
    corridor.braking = {
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    const bool passes = passes_or_comes_back(car);
    corridor.half_width = model.width / 2 + (passes ? corner_reach : 0);
    corridor.wanted_aside = car.offset_order ? car.offset_order->change.to : car.offset;
    corridor.most_gap = passes ? 1 : world::infinity;
    corridor.reach = 10 + (Braking::reaction + car.speed / (2 * easy_braking)) * car.speed;
    corridor.z = front.z();
    corridor.steepest = passes ? steepest_pass : steepest_way;
    corridor.id = car.id;
    constexpr double longest_piece = 3;  // [m] from a footprint's middle to its end
    if (!passes && (!obstructions_.any_near(front.head<2>(), corridor.reach + longest_piece) ||
                    is_clear(car, corridor.reach)))
        return world::infinity;
    const world::LaneT& lane = town_->lanes[car.lane];
    const world::LaneProjection at = world::project(lane, front);
    corridor.aside = at.t;
    if (!car.pass && !car.offset_order && (lane.left != none || lane.right != none))
        follow_lane_change(car, corridor);
    visit_way(car.lane, -at.s, corridor.reach, car, [&](std::uint32_t ahead, double start) {
        look_on(ahead, start, 0, corridor);
    });
    if (passes)
        look_at_cars(cars, at.s, car, corridor);
    // A body that has not left the next lane yet, or not come from it.
    for (const std::uint32_t beside : {lane.left, lane.right}) {
        if (beside == none || obstructions_.on(beside).empty())
            continue;
        const world::LaneProjection there = world::project(town_->lanes[beside], front);
        look_on(beside, -there.s, at.t - there.t, corridor);
    }
    return corridor.allowed;
}

void Lookout::hold_back(Car& car, double speed, std::uint64_t tick) const {
    using libsumo::Vehicle;
    if (car.speed_order)
        speed = std::min(speed, orders_->ordered_speed(car, tick));
    else
        Vehicle::setSpeedMode(car.sumo, orders_->braking_mode(car));
    Vehicle::setSpeed(car.sumo, speed);
    car.held_back = true;
}

void Lookout::look(const world::TickView& last, const Cars& cars) {
    obstructions_.look(last, cars.all());
    sweeping_.look();
    giving_way_.look(last);
}

void Lookout::advance(const world::TickView& last, Cars& cars, std::uint64_t tick) {
    stand_ins_.advance(obstructions_.all(), cars, tick);
    meetings_.keep(cars);
    for (std::size_t i = 0; i < cars.size(); ++i) {
        Car& car = cars[i];
        if (car.sumo.empty() || car.origin == Origin::parked || car.lane == none ||
            car.held_in == tick || (car.speed_order && !car.speed_order->reacts))
            continue;
        const KnownVehicle known(car.sumo, car.in_sumo);
        car.boxed_in = car.boxed_in && car.speed == 0;
        if (car.pass && car.pass->joins)
            PullingOut::follow(car);
        else if (car.pass)
            passing_.follow(car, tick);
        double allowed = allowed_speed(car, cars);
        // Where there is a lane beside its own SUMO has it stand before a stand-in.
        const bool is_held = car.held_back || town_->lanes[car.lane].left != none ||
                             town_->lanes[car.lane].right != none;
        if (is_held && !car.pass && allowed < Passing::speed) {
            passing_.begin(car, cars, last, tick);
            if (car.pass)
                allowed = allowed_speed(car, cars);
        }
        if (!car.pass && allowed < Passing::speed) {
            pulling_out_.begin(car, cars, tick);
            if (car.pass)
                allowed = allowed_speed(car, cars);
        }
        if (car.pass)
            allowed = std::min(allowed, Passing::allowed_speed(car));
        else
            allowed = std::min({allowed,
                                meetings_.allowed_speed(i),
                                car.way_speed,
                                sweeping_.allowed_speed(car, tick),
                                giving_way_.allowed_speed(car)});
        if (car.pass || allowed < car.speed + starting * step_) {
            hold_back(car, allowed, tick);
        } else if (car.held_back) {
            car.held_back = false;
            orders_->let_go(car, tick);
        }
    }
}

}  // namespace reprise::traffic
