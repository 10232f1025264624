#include "traffic/rescue_lane.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/sight/braking.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double heard = 50;            // [m] along its way
constexpr double still_heard = 60;      // [m] by who is aside already
constexpr double passing_near = 40;     // [m]
constexpr double passed_at = 3;         // [m/s] of one who is passed
constexpr double eases_off = 2;         // [m/s^2]
constexpr double farthest_aside = 0.6;  // [m] as far as Meetings look at a car
constexpr double to_the_edge = 0.1;     // [m] of its lane
constexpr double before_line = 40;      // [m] of those who let it through a junction
constexpr double arrives = 8;           // [s] before it does
constexpr double arrives_near = 16;     // [m] or so near it is
constexpr double caller_halt = 0.3;     // [m/s]
constexpr double caller_patience = 20;  // [s] with one who stands
constexpr double lane_reach = 4;        // [m] from a centre line: further out is off the road

double drawn_s(const Car& car, const world::LaneT& lane) {
    return std::min(car.lane_position / lane.sumo_length, 1.0) * lane.length;
}

/// Does the scenario leave it to itself?
bool is_free(const Car& car) {
    return !car.sumo.empty() && car.origin != Origin::parked && car.lane != none && !car.on_call &&
           !car.pass && (!car.speed_order || car.speed_order->reacts) && !car.lane_order &&
           !car.trajectory && (!car.offset_order || car.makes_way) &&
           (car.offset == 0 || car.makes_way);
}

}  // namespace

bool RescueLane::is_alone(const world::LaneT& lane) const {
    const auto leads = [&](std::uint32_t beside) {
        return beside != none && world::is_for_cars(town_->lanes[beside]);
    };
    return !leads(lane.left) && !leads(lane.right);
}

/// [m] left of its lane's middle.
double RescueLane::aside_of(const Car& car) const {
    const world::LaneT& lane = town_->lanes[car.lane];
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const double most =
        std::clamp((lane.width - model.width) / 2 - to_the_edge, 0.0, farthest_aside);
    const double inner = town_->left_hand ? -1 : 1;
    const std::uint32_t beside = town_->left_hand ? lane.right : lane.left;
    const bool innermost = beside == none || !world::is_for_cars(town_->lanes[beside]);
    return innermost && !is_alone(lane) ? inner * most : -inner * most;
}

bool RescueLane::stands_for_long(std::uint32_t id, double speed) {
    if (speed > caller_halt)
        return false;
    const auto before =
        std::find_if(halts_.begin(), halts_.end(), [id](const Halt& one) { return one.id == id; });
    const std::uint32_t ticks = before == halts_.end() ? 1 : before->ticks + 1;
    next_halts_.push_back({id, ticks});
    return ticks * step_ > caller_patience;
}

/// `edges` from the one that it is on, or that an inner lane comes from; `s` [m] of its bumper.
void RescueLane::add_caller(Caller caller,
                            std::uint32_t lane,
                            double s,
                            std::span<const std::uint32_t> edges) {
    const world::LaneT& here = town_->lanes[lane];
    double end = here.length - s;  // [m] from the bumper, of what was added last
    const auto comes_to = [&](std::uint32_t junction) {
        if (junction != none && end < std::clamp(arrives * caller.speed, arrives_near, heard))
            caller.junctions.push_back(junction);
    };
    comes_to(here.junction);
    if (here.kind != world::LaneKind::internal)
        caller.way.push_back({graph_->edge_of(lane), -s});
    auto at = std::find(edges.begin(), edges.end(), graph_->edge_of(lane));
    Eigen::Vector2d from = world::in_plan(here.centre.back());
    for (at += at != edges.end(); at != edges.end() && end < still_heard; ++at) {
        const world::LaneT& next = town_->lanes[graph_->edge(*at).lanes.front()];
        if (here.kind != world::LaneKind::internal || caller.way.size() > 0)
            end += (world::in_plan(next.centre.front()) - from).norm();
        caller.way.push_back({*at, end});
        end += next.length;
        from = world::in_plan(next.centre.back());
        comes_to(next.junction);
    }
    callers_.push_back(std::move(caller));
}

void RescueLane::find_callers(const world::TickView& last, Cars& cars, const Mirrors& mirrors) {
    callers_.clear();
    next_halts_.clear();
    for (Car& car : cars.all())
        car.on_call = false;
    for (const world::CarState& state : last.cars()) {
        if ((state.lamps() & world::lamp_beacon) == 0)
            continue;
        Car* car = cars.find(state.id());
        if (car == nullptr || car->origin == Origin::parked || car->lane == none ||
            !world::has_beacon(world::vehicle_models()[car->model]))
            continue;
        car->on_call = true;
        const world::VehicleModel& model = world::vehicle_models()[car->model];
        if (!stands_for_long(car->id, car->speed))
            add_caller({car->id, model.length, car->speed, false, car->lane, {}, {}},
                       car->lane,
                       drawn_s(*car, town_->lanes[car->lane]),
                       car->route);
    }
    for (const world::VehicleState& vehicle : last.vehicles()) {
        const world::VehicleModel& model = world::vehicle_models()[vehicle.model()];
        if ((vehicle.lamps() & world::lamp_beacon) == 0 || !world::has_beacon(model))
            continue;
        const double speed = std::hypot(vehicle.velocity().x(), vehicle.velocity().y());
        const Eigen::Vector3d ahead =
            world::to_eigen(vehicle.orientation()) * Eigen::Vector3d::UnitX();
        const Eigen::Vector3d front =
            world::to_eigen(vehicle.position()) + origin_to_front(vehicle.model()) * ahead;
        const auto on = lanes_->best(front, std::atan2(ahead.y(), ahead.x()), lane_reach);
        if (on && !stands_for_long(vehicle.id(), speed))
            add_caller({vehicle.id(), model.length, speed, true, on->lane, {}, {}},
                       on->lane,
                       on->at.s,
                       mirrors.way_of(vehicle.id()));
    }
    std::swap(halts_, next_halts_);
}

/// Of one on its way, or of one who comes towards it where there is one lane a direction.
void RescueLane::make_way(const Car& car, const Caller& caller, Wish& wish) const {
    const world::LaneT& lane = town_->lanes[car.lane];
    const bool alone = is_alone(lane);
    const double far = car.makes_way ? still_heard : heard;
    const double passed = -caller.length - 2;  // [m] bumper behind bumper
    const auto look = [&](std::uint32_t on, double s, bool can_pass) {
        for (const Stretch& stretch : caller.way) {
            const double distance = stretch.start + s;
            if (stretch.edge != graph_->edge_of(on) || distance < passed || distance > far)
                continue;
            wish.aside = true;
            wish.leaves_lane |= !caller.has_mass && on == caller.lane && distance > 0;
            if (caller.has_mass && can_pass && distance > 0 && distance < passing_near)
                wish.speed =
                    std::min(wish.speed, std::max(passed_at, car.speed - eases_off * step_));
        }
    };
    look(car.lane, drawn_s(car, lane), !alone || lane.opposite != none);
    if (alone && lane.opposite != none &&
        town_->lanes[lane.opposite].kind == world::LaneKind::driving)
        look(lane.opposite, world::project(town_->lanes[lane.opposite], car.trail.front()).s, true);
}

/// Who can still stop before the junction does.
void RescueLane::let_through(const Car& car, const Caller& caller, Wish& wish) const {
    const world::LaneT& lane = town_->lanes[car.lane];
    const bool comes_there =
        std::find(caller.junctions.begin(), caller.junctions.end(), lane.junction) !=
        caller.junctions.end();
    const bool is_before_it =
        std::any_of(caller.way.begin(), caller.way.end(), [&](const Stretch& stretch) {
            return stretch.edge == graph_->edge_of(car.lane);
        });
    const double left = lane.length - drawn_s(car, lane);
    const double needed = car.speed * car.speed / (2 * comfortable_braking(car.model));
    if (!comes_there || is_before_it || left > before_line || needed > left - Braking::least_gap)
        return;
    const Braking braking{
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    wish.speed = std::min(wish.speed, braking.speed_before(left, Braking::least_gap, 0));
}

/// As soon as there is a gap; outwards, if it can. SUMO carries it out: see LaneChangePace.
void RescueLane::leave_lane(const Car& car) const {
    constexpr double asked_for = 1;  // [s]
    const world::LaneT& lane = town_->lanes[car.lane];
    const std::uint32_t outer = town_->left_hand ? lane.left : lane.right;
    const std::uint32_t inner = town_->left_hand ? lane.right : lane.left;
    for (const std::uint32_t beside : {outer, inner})
        if (beside != none && town_->lanes[beside].kind == world::LaneKind::driving) {
            libsumo::Vehicle::changeLane(
                car.sumo, static_cast<int>(graph_->index_of(beside)), asked_for);
            return;
        }
}

RescueLane::Wish RescueLane::wish_of(const Car& car) const {
    Wish wish;
    if (town_->lanes[car.lane].kind != world::LaneKind::driving)
        return wish;
    for (const Caller& caller : callers_) {
        make_way(car, caller, wish);
        let_through(car, caller, wish);
    }
    return wish;
}

void RescueLane::advance(const world::TickView& last,
                         Cars& cars,
                         const Mirrors& mirrors,
                         std::uint64_t tick) {
    constexpr double moves_over = 1.5;  // [s] at least
    find_callers(last, cars, mirrors);
    for (Car& car : cars.all()) {
        car.way_speed = world::infinity;
        if ((callers_.empty() && !car.makes_way) || !is_free(car))
            continue;
        const Wish wish = wish_of(car);
        car.way_speed = wish.speed;
        if (wish.leaves_lane)
            leave_lane(car);
        const double to = wish.aside ? aside_of(car) : 0;
        const bool was_told =
            car.makes_way ? car.offset_order && car.offset_order->change.to == to : to == 0;
        if (!was_told)
            car.offset_order =
                OffsetOrder{{car.offset, to, moves_over, world::Shape::linear}, tick - 1};
        car.makes_way = wish.aside || (car.makes_way && car.offset_order);
    }
}

void RescueLane::add_to(world::Hasher& hasher) const {
    for (const Halt& one : halts_) {
        hasher.add(one.id);
        hasher.add(one.ticks);
    }
}

}  // namespace reprise::traffic
