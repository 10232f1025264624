#include "traffic/lookout.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
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
    corridor.half_width = model.width / 2 + (car.pass ? corner_reach : 0);
    corridor.wanted_aside = car.offset_order ? car.offset_order->change.to : car.offset;
    corridor.most_gap = car.pass ? 1 : world::infinity;
    corridor.reach = 10 + (Braking::reaction + car.speed / (2 * easy_braking)) * car.speed;
    corridor.z = front.z();
    corridor.steepest = car.pass ? steepest_pass : steepest_way;
    corridor.id = car.id;
    constexpr double longest_piece = 3;  // [m] from a footprint's middle to its end
    if (!car.pass && (!obstructions_.any_near(front.head<2>(), corridor.reach + longest_piece) ||
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
    if (car.pass)
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

/// [m/s] to stop before the body would sweep over somebody beside its lane, as a tail swings out
/// and a middle cuts in where one turns. A long vehicle looks at all who stand or lie there, and
/// not for ever: who stands there for long may never go away, and then brushing past is the
/// driver's business; but never past vehicles with mass, which it would hit. A short one looks at
/// these alone; it would stand before one that stands for ever if it wanted more than it needs. Of
/// people who walk about nobody stays under a tail (walkers/threats.h): to wait for those who wait
/// themselves, in the middle of a junction, is to block it.
double Lookout::before_swept(Car& car, std::uint64_t tick) const {
    constexpr double looked_at = 14;            // [m] of way
    constexpr double spacing = 0.5;             // [m]
    constexpr double hair = 0.1;                // [m] left beside it,
    constexpr double finest_hair = 0.03;        // and where those alone are looked at who stand
    constexpr double stands = 0.1;              // [m/s]
    constexpr double slow = 1.5;                // [m/s] of who stays about where he is,
    constexpr double hardly_faster = 5;         // and of one with mass that drives past
    constexpr double waits = 40;                // [s]
    constexpr double crawl = 0.6;               // [m/s] people step back from a tail that comes so
    constexpr std::uint64_t goes_on_for = 200;  // [ticks]
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const bool is_long = model.length > longest_short_car;
    const bool looks_at_all = is_long && car.brushes_until <= tick;
    if (car.pass)
        return world::infinity;
    const double around = looked_at + 2 * model.length;
    std::vector<BodyBox> others;
    std::vector<BodyBox> people;
    const std::span<const Footprint> seen = looks_at_all ? obstructions_.footprints() : driving_;
    for (const Footprint& one : seen) {
        if ((one.centre - car.rear.head<2>()).squaredNorm() > around * around || one.id == car.id ||
            std::abs(one.z - car.rear.z()) > world::level_clearance)
            continue;
        const double speed = one.velocity.norm();
        if (speed > (one.drives ? hardly_faster : slow))
            continue;
        const BodyBox box{one.centre, one.direction, one.half_length, one.half_width};
        (one.is_afoot ? people : others)
            .push_back(box.widened(looks_at_all || speed > stands ? hair : finest_hair));
    }
    if (others.empty() && people.empty())
        return world::infinity;
    const WayAhead way(car, meetings_.lines(), *graph_, looked_at);
    const BodyBox corridor = way.corridor(looked_at, way.at(0).ahead);
    for (std::vector<BodyBox>* boxes : {&others, &people})
        std::erase_if(*boxes, [&](const BodyBox& other) { return !overlap(corridor, other); });
    if (others.empty() && people.empty())
        return world::infinity;
    const auto touches = [&](const std::vector<BodyBox>& boxes, double driven) {
        const BodyBox body = way.at(driven);
        return std::any_of(
            boxes.begin(), boxes.end(), [&](const BodyBox& other) { return overlap(body, other); });
    };
    if (touches(others, 0))  // it cannot help it by standing
        return world::infinity;
    const Braking braking{
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    double allowed = touches(people, 0) ? crawl : world::infinity;
    for (double driven = spacing; driven <= std::min(looked_at, way.length()); driven += spacing) {
        if (!std::isfinite(allowed) && touches(people, driven))
            allowed = std::max(crawl, braking.speed_before(driven - spacing, 0, 0));
        if (touches(others, driven)) {
            if (is_long && car.standing_ticks * step_ > waits && driven <= 2 * spacing)
                car.brushes_until = tick + goes_on_for;
            return std::min(allowed, braking.speed_before(driven - spacing, 0, 0));
        }
    }
    return allowed;
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
    driving_.clear();
    for (const Footprint& one : obstructions_.footprints())
        if (one.drives)
            driving_.push_back(one);
}

void Lookout::advance(const world::TickView& last, Cars& cars, std::uint64_t tick) {
    stand_ins_.advance(obstructions_.all(), cars, tick);
    meetings_.look(cars, tick);
    for (std::size_t i = 0; i < cars.size(); ++i) {
        Car& car = cars[i];
        if (car.sumo.empty() || car.origin == Origin::parked || car.lane == none ||
            car.held_in == tick || (car.speed_order && !car.speed_order->reacts))
            continue;
        if (car.pass)
            passing_.follow(car, tick);
        double allowed = allowed_speed(car, cars);
        if (car.held_back && !car.pass && allowed < Passing::speed) {
            passing_.begin(car, cars, last, tick);
            if (car.pass)
                allowed = allowed_speed(car, cars);
        }
        if (car.pass)
            allowed = std::min(allowed, Passing::allowed_speed(car));
        else
            allowed = std::min(
                {allowed, meetings_.allowed_speed(i), car.way_speed, before_swept(car, tick)});
        if (car.pass || allowed < car.speed + starting * step_) {
            hold_back(car, allowed, tick);
        } else if (car.held_back) {
            car.held_back = false;
            orders_->let_go(car, tick);
        }
    }
}

}  // namespace reprise::traffic
