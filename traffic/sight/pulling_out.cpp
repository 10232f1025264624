#include "traffic/sight/pulling_out.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/roads/even_yaw.h"
#include "traffic/sight/passing.h"
#include "traffic/sight/swing.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double patience = 3;        // [s]
constexpr double nearest_thing = 12;  // [m]
constexpr double way_aside = 12;      // [m] that it drives until it is in the lane beside
constexpr double way_back = 45;       // [m] for another change, where that lane leads elsewhere
constexpr double turns_off = 12;      // [s] then it goes where that lane leads; see detours.h
constexpr double gap_ahead = 6;       // [m]
constexpr double gap_behind = 2;      // [m] and what it takes who comes to brake
constexpr double reaction = 1.5;      // [s]
constexpr double brakes_easily = 3;   // [m/s^2]

/// [m] that one behind needs to let it in.
double needed_behind(double speed) {
    return gap_behind + (reaction + speed / (2 * brakes_easily)) * speed;
}

}  // namespace

double PullingOut::pace_to_end_change(double off, bool is_on_its_way_out, double step) {
    constexpr double at_once = 100;    // [m/s] all of a lane in a step
    constexpr double nothing = 0.001;  // SUMO divides by it
    constexpr double spare = 1.2;
    return is_on_its_way_out ? at_once : std::clamp(spare * std::abs(off) / step, nothing, at_once);
}

/// In SUMO, within its step.
void PullingOut::end_change(Car& car) const {
    using libsumo::Vehicle;
    const double off = Vehicle::getLateralLanePosition(car.sumo);
    const bool is_on_its_way_out = off * Vehicle::getLateralSpeed(car.sumo) > 0;
    car.aside_limit = pace_to_end_change(off, is_on_its_way_out, step_);
    Vehicle::setMaxSpeedLat(car.sumo, car.aside_limit);
}

/// Its body first behind something that stays there, nobody of SUMO's between.
bool PullingOut::stands_behind_a_thing(const Car& car, const Cars& cars) const {
    const world::LaneT& own = town_->lanes[car.lane];
    const double half = world::vehicle_models()[car.model].width / 2;
    const auto is_first_on = [&](std::uint32_t lane) {
        if (lane == none)
            return false;
        const world::LaneProjection at = world::project(town_->lanes[lane], car.trail.front());
        for (const Obstruction& one : obstructions_->on(lane))
            if (one.begin > at.s - 0.3 && one.left > at.t - half && one.right < at.t + half)
                return one.lasts && one.begin < at.s + nearest_thing;
        return false;
    };
    if (!is_first_on(car.lane) && !is_first_on(own.left) && !is_first_on(own.right))
        return false;
    // One who was found to be boxed in just now is no thing to be passed yet: see footprints.h.
    const auto here = obstructions_->on(car.lane);
    const auto is_a_thing = [&](const Car& other) {
        return std::any_of(here.begin(), here.end(), [&](const Obstruction& one) {
            return one.id == other.id && one.boxed_in;
        });
    };
    const auto all = cars.all();
    return std::none_of(all.begin(), all.end(), [&](const Car& other) {
        return other.lane == car.lane && other.origin != Origin::parked && !is_a_thing(other) &&
               other.id != car.id && other.lane_position > car.lane_position &&
               other.lane_position - world::vehicle_models()[other.model].length <
                   car.lane_position + nearest_thing;
    });
}

/// Is it a lane for cars, with room for this one here, on the way to where it goes?
bool PullingOut::may_use(const Car& car, double front, std::uint32_t beside) const {
    const world::LaneT& lane = town_->lanes[beside];
    const double length = world::vehicle_models()[car.model].length;
    // With its tail on another lane SUMO would have it there, too.
    if (lane.kind != world::LaneKind::driving || front < length + 1 ||
        front + way_aside > lane.length)
        return false;
    const auto here = std::find(car.route.begin(), car.route.end(), graph_->edge_of(beside));
    if (here == car.route.end())
        return false;
    const bool may_turn_off = static_cast<double>(car.standing_ticks) * step_ > turns_off;
    if (here + 1 == car.route.end() || front + way_back < lane.length || may_turn_off)
        return true;
    return std::any_of(lane.links.begin(), lane.links.end(), [&](const world::Link& link) {
        return link.to() != none && graph_->edge_of(link.to()) == *(here + 1);
    });
}

/// [m] from the other's bumper on to `front` on the lane, along it; infinity for one who does not
/// come there. Of one on the road before it is the straight way, the shortest that there is.
double PullingOut::way_to(const Car& other, std::uint32_t beside, double front) const {
    const world::LaneT& lane = town_->lanes[beside];
    if (other.lane == beside)
        return front - other.lane_position * lane.length / lane.sumo_length;
    const std::uint32_t edge = graph_->edge_of(beside);
    if (other.lane != none && graph_->edge_of(other.lane) == edge) {
        // In the middle of a change of lanes it has a part of its body there, or will have.
        const world::LaneProjection at = world::project(lane, other.trail.front());
        const double half = world::vehicle_models()[other.model].width / 2;
        return std::abs(at.t) < lane.width / 2 + half ? front - at.s : world::infinity;
    }
    constexpr std::ptrdiff_t soon = 3;  // edges of its route
    const auto end =
        other.route.begin() + std::min(soon, static_cast<std::ptrdiff_t>(other.route.size()));
    if (std::find(other.route.begin(), end, edge) == end)
        return world::infinity;
    const Eigen::Vector3d start = world::point_at(lane, 0).position;
    return front + (start - other.trail.front()).head<2>().norm();
}

bool PullingOut::is_free(const Car& car,
                         std::uint32_t beside,
                         double front,
                         const Cars& cars) const {
    const double length = world::vehicle_models()[car.model].length;
    for (const Car& other : cars.all()) {
        if (other.id == car.id || other.origin == Origin::parked || other.lane == none)
            continue;
        const double way = way_to(other, beside, front);
        if (way == world::infinity)
            continue;
        const double other_length = world::vehicle_models()[other.model].length;
        const bool is_ahead = -way - other_length > gap_ahead;
        const bool is_behind = way - length > needed_behind(other.speed);
        if (!is_ahead && !is_behind)
            return false;
    }
    // In its middle it will drive; what reaches over the line a little leaves it room.
    const double half = world::vehicle_models()[car.model].width / 2;
    const auto there = obstructions_->on(beside);
    return std::none_of(there.begin(), there.end(), [&](const Obstruction& one) {
        return one.id != car.id && one.left > -half && one.right < half &&
               one.begin < front + way_aside && one.end > front - length - needed_behind(one.speed);
    });
}

/// To the middle of that lane, where `there` is its bumper on it, if nothing is in its way.
bool PullingOut::swing_into(std::uint32_t lane,
                            const world::LaneProjection& there,
                            Car& car,
                            std::uint64_t tick) const {
    using libsumo::Vehicle;
    const world::LaneT& own = town_->lanes[car.lane];
    const world::LaneProjection at = world::project(own, car.trail.front());
    // One that tries again may have got a part of the way already.
    const double aside = car.offset - there.t;
    const auto touches = [&](double pace) {
        return swings_into_any(car, own, at, aside, pace, obstructions_->footprints());
    };
    double pace = Passing::speed;
    if (touches(pace))
        pace = slow_pull_out;
    if (pace < Passing::speed && touches(pace)) {
        car.boxed_in = true;
        return false;
    }
    const world::LaneT& next = town_->lanes[lane];
    if (Vehicle::getLateralLanePosition(car.sumo) != 0) {
        end_change(car);
    } else if (lane != car.lane) {
        car.lane_position = there.s * next.sumo_length / next.length;
        Vehicle::moveTo(car.sumo, next.name, car.lane_position);
    }
    car.lane = lane;
    const double s = car.lane_position * next.length / next.sumo_length;
    car.sumo_front = world::point_at(next, s).position;
    // What it shows beside SUMO's place is an offset from now on, which it drives off sooner.
    const Eigen::Vector2d left = world::left_of(even_yaw_at(next, s));
    car.offset = there.t;
    car.slip = (car.trail.front() - car.sumo_front).head<2>() - car.offset * left;
    car.offset_order = OffsetOrder{{there.t, 0, pull_out_time, world::Shape::linear}, tick - 1};
    car.pass = PassOrder{lane, 0, pace, true};
    return true;
}

void PullingOut::begin(Car& car, const Cars& cars, std::uint64_t tick) const {
    using libsumo::Vehicle;
    constexpr double aside = 0.8;  // [m] SUMO is beyond the middle of a change, the car is not
    const bool goes_aside = car.offset_order && car.offset_order->change.to != 0;
    if (car.origin != Origin::demand || car.speed > 0.1 || goes_aside || car.makes_way ||
        static_cast<double>(car.standing_ticks) * step_ < patience)
        return;
    const world::LaneT& lane = town_->lanes[car.lane];
    if (lane.kind != world::LaneKind::driving || (lane.left == none && lane.right == none) ||
        !stands_behind_a_thing(car, cars))
        return;
    const Eigen::Vector3d& front = car.trail.front();
    const world::LaneProjection at = world::project(lane, front);
    const double off = Vehicle::getLateralLanePosition(car.sumo);
    if (off * Vehicle::getLateralSpeed(car.sumo) > 0) {
        // On its way out it is there for SUMO's others already.
        const std::uint32_t goal = off > 0 ? lane.left : lane.right;
        if (goal != none)
            swing_into(goal, world::project(town_->lanes[goal], front), car, tick);
        return;
    }
    if (std::abs(at.t) > aside && swing_into(car.lane, at, car, tick))
        return;
    if (off != 0) {
        end_change(car);
        return;
    }
    const bool left_hand = town_->left_hand;
    for (const std::uint32_t beside :
         {left_hand ? lane.right : lane.left, left_hand ? lane.left : lane.right}) {
        if (beside == none)
            continue;
        const world::LaneProjection there = world::project(town_->lanes[beside], front);
        if (may_use(car, there.s, beside) && is_free(car, beside, there.s, cars) &&
            swing_into(beside, there, car, tick))
            return;
    }
}

void PullingOut::follow(Car& car) {
    if (!car.offset_order || car.lane != car.pass->lane)
        car.pass.reset();
}

}  // namespace reprise::traffic
