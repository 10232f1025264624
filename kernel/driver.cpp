#include "kernel/driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "kernel/car_model.h"
#include "kernel/ego.h"
#include "kernel/gatekeeper.h"
#include "kernel/hazards.h"
#include "kernel/lane_change.h"
#include "kernel/pedals.h"
#include "kernel/steering.h"
#include "kernel/swing.h"
#include "kernel/turn_around.h"
#include "kernel/way.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::kernel {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double braking_reserve = 50;  // [m] of path beyond the braking distance
constexpr double shortest_way = 150;    // [m]
constexpr double lost_distance = 4;     // [m] from the path: pushed away, or put elsewhere
constexpr double way_behind = 10;       // [m] kept behind the car
constexpr double speed_gain = 0.8;      // [1/s]
constexpr double indicate_before = 30;  // [m]
constexpr double low_sun = 0.1;         // [rad]
constexpr double longest_wait = 12;     // [s] for room on the next lane

CarModel model_with(std::uint16_t index) {
    REPRISE_CHECK(index < world::vehicle_models().size(), "model " + std::to_string(index));
    return car_model(world::vehicle_models()[index]);
}

}  // namespace

struct Autopilot::State {
    State(std::uint32_t actor_id,
          std::uint16_t model,
          const world::EpisodeT& episode,
          const world::TownT& town,
          const world::LaneMap& lane_map)
        : actor(actor_id),
          step(static_cast<double>(episode.step_ns) * 1e-9),
          car(model_with(model)),
          lanes(&lane_map),
          graph(town),
          way(graph, episode.seed, actor_id),
          hazards(town),
          gatekeeper(town) {}

    bool find_way(Ego& ego);
    std::optional<std::uint32_t> lane_under(const Ego& ego) const;
    bool has_tight_bends() const;
    bool is_lost(const Ego& ego) const;
    void plan_swing(const Ego& ego);
    void take_route(Ego& ego);
    std::vector<std::uint32_t> committed_lanes(const Ego& ego) const;
    void take_change(Ego& ego);
    void start_over(Ego& ego, const std::vector<std::uint32_t>& lanes, double change_room);
    double change_lanes(const world::TickView& last, Ego& ego);
    double cruise(const Ego& ego) const;
    double approach_turn(const Ego& ego);
    void turn(const world::TickView& last, Ego& ego, world::Control& control);
    std::uint16_t lamps(const world::TickView& last, const Ego& ego) const;

    std::uint32_t actor;
    double step;  ///< [s] of a tick
    CarModel car;
    const world::LaneMap* lanes;
    LaneGraph graph;
    Way way;
    std::optional<Swing> swing;      ///< once there was a bend that needs it
    std::uint64_t swing_of_way = 0;  ///< the way's plan() that it was planned for
    bool swings = false;             ///< on the way ahead
    Hazards hazards;
    Gatekeeper gatekeeper;
    Pedals pedals;
    TurnAround turn_around;
    std::uint32_t turns_into = 0;  ///< the lane behind the turn
    DrivingStyle style;

    /// Given, not planned yet.
    struct NewRoute {
        std::vector<std::uint32_t> stops;
        double last_s = 0;
    };

    std::optional<NewRoute> new_route;
    std::optional<std::uint32_t> new_lane;
    std::optional<double> speed_cap;
    double rear_axle_s = 0;           ///< only grows while the way stays
    std::uint32_t waiting_ticks = 0;  ///< beside cars on the lane that we want
    bool on_way = false;
};

Autopilot::Autopilot(std::uint32_t actor,
                     std::uint16_t model,
                     const world::EpisodeT& episode,
                     const world::TownT& town,
                     const world::LaneMap& lanes)
    : state_(std::make_unique<State>(actor, model, episode, town, lanes)) {}

Autopilot::~Autopilot() = default;
Autopilot::Autopilot(Autopilot&&) noexcept = default;
Autopilot& Autopilot::operator=(Autopilot&&) noexcept = default;

void Autopilot::set_route(std::vector<std::uint32_t> lanes, double last_s) {
    state_->new_route = {std::move(lanes), last_s};
}

void Autopilot::change_lane(std::uint32_t lane) {
    state_->new_lane = lane;
}

void Autopilot::set_speed(double speed) {
    state_->speed_cap = std::max(speed, 0.0);
}

void Autopilot::free_speed() {
    state_->speed_cap.reset();
}

const std::vector<std::uint32_t>& Autopilot::path() const {
    return state_->way.lanes();
}

/// What every driver does: where am I, where do I go, who is in the way, then hands and feet.
world::Control Autopilot::decide(const world::TickView& last) {
    State& state = *state_;
    const world::VehicleState* own = world::find(last.vehicles(), state.actor);
    REPRISE_CHECK(
        own != nullptr,
        "actor " + std::to_string(state.actor) + ", tick " + std::to_string(last.index()));
    Ego ego = ego_of(*own);
    world::Control control(0, 0, 0, state.actor, 0, false, false);
    if (!state.turn_around.done())
        state.turn(last, ego, control);
    if (!state.turn_around.done())
        return control;

    // Where am I? Off every road there is nothing to follow: stop.
    if (!state.find_way(ego)) {
        control.mutate_brake(0.5);
        return control;
    }

    // Who is in the way, and may I go on? The most careful answer counts.
    state.plan_swing(ego);
    double acceleration = state.cruise(ego);
    acceleration = std::min(acceleration, state.change_lanes(last, ego));
    acceleration = std::min(acceleration, state.approach_turn(ego));
    state.plan_swing(ego);
    state.hazards.look(last,
                       ego,
                       state.way.path(),
                       state.style,
                       state.swings ? state.swing->swept() : std::span<const SweptWidth>());
    acceleration = std::min(acceleration, state.hazards.acceleration());
    acceleration =
        std::min(acceleration,
                 state.gatekeeper.decide(
                     last, ego, state.way, state.hazards.overlaps(), state.style, state.step));

    // Hands and feet.
    const Pedals::Position pedals =
        state.pedals.press(acceleration, ego.speed, state.car, state.step);
    control.mutate_throttle(pedals.throttle);
    control.mutate_brake(pedals.brake);
    control.mutate_steer(state.swings ? steer(ego, *state.swing) : steer(ego, state.way.path()));
    control.mutate_lamps(state.lamps(last, ego));
    return control;
}

/// Keeps path and place on it up to date. False when there is no lane to drive on.
bool Autopilot::State::find_way(Ego& ego) {
    if (on_way) {
        const double reach = 2 + 2 * std::abs(ego.speed) * step;
        rear_axle_s = way.path().project(ego.position, rear_axle_s, reach);
        ego.rear_axle_s = rear_axle_s;
    }
    if (!on_way || is_lost(ego)) {
        const std::optional<std::uint32_t> lane = lane_under(ego);
        on_way = lane.has_value();
        if (!on_way)
            return false;
        gatekeeper.reset();
        start_over(ego, {*lane}, 10);
    }
    if (new_route)
        take_route(ego);
    if (new_lane)
        take_change(ego);
    const double braking = ego.speed * ego.speed / (2 * style.comfortable_braking);
    way.extend(ego.front_s(), std::max(shortest_way, braking + braking_reserve));
    way.drop_before(rear_axle_s, way_behind);
    return true;
}

/// Bends that no steering can follow; those where we turn around are not driven along the path.
bool Autopilot::State::has_tight_bends() const {
    // [m] to both sides; the points' own curvature is over 6 m, where a jog cancels itself.
    constexpr double bend_reach = 1.5;
    const double sharpest =
        0.9 * std::tan(car.catalogue->max_steering_angle) / car.catalogue->wheelbase;
    const Path& path = way.path();
    for (std::size_t i = 0; i < path.points().size(); ++i) {
        const double s = path.s_of(i);
        if (std::abs(path.curvature(s, bend_reach)) < sharpest)
            continue;
        if (std::none_of(way.gates().begin(), way.gates().end(), [&](const Gate& gate) {
                return gate.turn == world::Turn::around && gate.s - 5 < s && s < gate.exit_s + 5;
            }))
            return true;
    }
    return false;
}

/// Bends that need it are planned when the way has changed.
void Autopilot::State::plan_swing(const Ego& ego) {
    if (swing_of_way == way.plan() && !(swings && swing->empty()))
        return;
    swing_of_way = way.plan();
    swings = Swing::is_needed(*car.catalogue) || has_tight_bends();
    if (!swings)
        return;
    if (!swing)
        swing.emplace(*car.catalogue, graph.town(), *lanes);
    swing->plan(way.path(), ego);
    swings = !swing->empty();
}

/// The lane that fits best; not one inside a junction that leads nowhere, where there is another.
std::optional<std::uint32_t> Autopilot::State::lane_under(const Ego& ego) const {
    constexpr double around = 8;  // [m]
    const auto best = lanes->best(ego.position, ego.yaw);
    const auto leads_on = [&](std::uint32_t lane) {
        return graph.town().lanes[lane].kind != world::LaneKind::internal ||
               graph.exit(lane) != world::none;
    };
    if (best && leads_on(best->lane))
        return best->lane;
    std::optional<std::uint32_t> nearest;
    double least = infinity;
    for (const world::LaneMap::Found& found : lanes->at(ego.position, around)) {
        const double yaw = world::point_at(graph.town().lanes[found.lane], found.at.s).yaw;
        const double turn = std::abs(world::wrap_angle(yaw - ego.yaw));
        const double cost = found.at.distance + 4 * turn;
        if (leads_on(found.lane) && turn < std::numbers::pi / 2 && cost < least) {
            least = cost;
            nearest = found.lane;
        }
    }
    return nearest;
}

bool Autopilot::State::is_lost(const Ego& ego) const {
    const PathPoint here = way.path().at(ego.rear_axle_s);
    const double distance = (ego.position - here.position).norm();
    // Where a dead end ends one may stand beyond the path.
    const bool beyond = way.ended() && ego.rear_axle_s >= way.path().end() - Path::spacing;
    return !beyond && (distance > lost_distance || here.direction.dot(ego.direction) < -0.2);
}

/// A new path under the car: along `lanes`, of which the first is the one that we are on. Changes
/// of lanes start `change_room` ahead of the rear axle at the earliest.
void Autopilot::State::start_over(Ego& ego,
                                  const std::vector<std::uint32_t>& lanes_ahead,
                                  double change_room) {
    const double s = world::project(graph.town().lanes[lanes_ahead.front()], ego.position).s;
    way.restart(lanes_ahead, {std::max(s - way_behind, 0.0), s, ego.speed, change_room});
    way.extend(0, shortest_way);
    rear_axle_s = way.path().project(ego.position, 0, 3 * way_behind);
    ego.rear_axle_s = rear_axle_s;
}

/// Lanes that we can no longer choose: those under the car, and what lies behind a junction that is
/// so near that we could not brake for another way.
std::vector<std::uint32_t> Autopilot::State::committed_lanes(const Ego& ego) const {
    const double braking = ego.speed * ego.speed / (2 * style.comfortable_braking);
    const double until = ego.front_s() + braking;
    double from = ego.rear_axle_s;
    for (const LaneChange& change : way.changes())
        if (change.start < from && from < change.end)
            from = change.end;  // half across: go on to the new lane
    std::vector<std::uint32_t> lanes_on;
    bool inside = false;
    for (const PathPiece& piece : way.pieces()) {
        if (piece.end < from)
            continue;
        if (!lanes_on.empty() && !inside && piece.start > until)
            break;
        inside = graph.town().lanes[piece.lane].kind == world::LaneKind::internal;
        if (!inside || lanes_on.empty())
            lanes_on.push_back(piece.lane);
    }
    return lanes_on;
}

void Autopilot::State::take_route(Ego& ego) {
    const std::vector<std::uint32_t> lanes_ahead = committed_lanes(ego);
    std::span<const std::uint32_t> stops = new_route->stops;
    for (const std::uint32_t lane : lanes_ahead)
        if (!stops.empty() && stops.front() == lane)
            stops = stops.subspan(1);
    const Plan plan = graph.plan({lanes_ahead.back(), 0}, stops, new_route->last_s);
    if (plan.unreachable != world::none)
        throw world::Error("route: no way leads from lane '" +
                           graph.town().lanes[lanes_ahead.back()].name + "' to lane '" +
                           graph.town().lanes[plan.unreachable].name + "'");
    way.set_stops(std::move(new_route->stops), new_route->last_s);
    new_route.reset();
    start_over(ego, lanes_ahead, ego.model->length + 0.5 * ego.speed);
}

/// To the neighbour of the lane that we are on. Too late where we are about to leave it: then we go
/// on. Another lane is a place to go to.
void Autopilot::State::take_change(Ego& ego) {
    const std::uint32_t wanted = *new_lane;
    new_lane.reset();
    std::vector<std::uint32_t> lanes_ahead = committed_lanes(ego);
    const auto is_beside = [&](std::uint32_t lane) {
        return wanted == graph.town().lanes[lane].left || wanted == graph.town().lanes[lane].right;
    };
    if (is_beside(lanes_ahead.back())) {
        lanes_ahead.push_back(wanted);
        start_over(ego, lanes_ahead, ego.model->length + 0.5 * ego.speed);
    } else if (std::none_of(lanes_ahead.begin(), lanes_ahead.end(), is_beside)) {
        new_route = {{wanted}, graph.town().lanes[wanted].length};
        take_route(ego);
    }
}

/// Before the path leaves our lane: is there room on the other one? If not, leave it later, and at
/// the latest place wait.
double Autopilot::State::change_lanes(const world::TickView& last, Ego& ego) {
    for (const LaneChange& change : way.changes()) {
        const double before = change.start - ego.front_s();
        if (before < 0 || before > 2 + ego.speed)
            continue;
        if (is_clear(last, ego, graph.town(), change.to) || waiting_ticks * step > longest_wait) {
            if (before < 1)
                waiting_ticks = 0;
            return infinity;
        }
        if (change.spare > 5) {
            const double later = before + std::min(5 + ego.speed, change.spare);
            const double front = ego.front_s() - ego.rear_axle_s;
            start_over(ego, way.lanes_to_come(ego.rear_axle_s), front + later);
            return infinity;
        }
        waiting_ticks += ego.speed < 0.5 ? 1 : 0;
        return stop_acceleration(before, ego.speed, style.comfortable_braking, style);
    }
    return infinity;
}

/// The speed that lanes, curves and the scenario's cap allow, and dead ends. [m/s^2]
double Autopilot::State::cruise(const Ego& ego) const {
    const Path& path = way.path();
    const double cap = speed_cap.value_or(infinity);
    // A glance ahead makes up for the tick's delay.
    const double middle = ego.model->wheelbase / 2;
    const double s = ego.rear_axle_s + middle + ego.speed * step;
    const auto squared_speed = [&](double at) {
        const double most = path.at(at).squared_speed;
        return swings ? std::min(most, swing->at(at - middle).squared_speed) : most;
    };
    const double here = squared_speed(s);
    const double allowed = std::sqrt(here);
    double acceleration = speed_gain * (std::min(allowed, cap) - ego.speed);
    if (allowed < cap && ego.speed > allowed - 1) {
        acceleration +=
            std::clamp((squared_speed(s + 1) - here) / 2, -style.comfortable_braking, 0.0);
    }
    acceleration = std::clamp(acceleration, -4.0, style.acceleration);
    if (way.ended())
        acceleration = std::min(
            acceleration,
            stop_acceleration(
                path.end() - ego.front_s() - 1, ego.speed, style.comfortable_braking, style));
    return acceleration;
}

/// Stops where a turn begins that takes going back and forth, and begins it. [m/s^2]
double Autopilot::State::approach_turn(const Ego& ego) {
    constexpr double sight = 80;  // [m]
    const auto ahead = std::find_if(way.gates().begin(), way.gates().end(), [&](const Gate& gate) {
        return gate.s > ego.front_s() - 1;
    });
    if (ahead == way.gates().end() || ahead->turn != world::Turn::around ||
        ahead->s > ego.front_s() + sight)
        return infinity;
    const world::Link& link = graph.town().lanes[ahead->from].links[ahead->link];
    const auto street = TurnAround::street_of(graph.town(), ahead->from, link, *ego.model);
    if (!street)
        return infinity;
    const double distance = ahead->s - TurnAround::before_end - ego.front_s();
    if (distance < 0.7 && ego.speed < 0.2) {
        turn_around.begin(*street, ego);
        turns_into = ahead->to;
    }
    return stop_acceleration(distance, ego.speed, style.comfortable_braking, style);
}

/// Hands and feet while we turn around; when that is done, a new path on the lane behind it.
void Autopilot::State::turn(const world::TickView& last, Ego& ego, world::Control& control) {
    const TurnAround::Move move = turn_around.next(last, ego);
    if (turn_around.done()) {
        gatekeeper.reset();
        start_over(ego, {lane_under(ego).value_or(turns_into)}, ego.model->length);
        on_way = true;
        return;
    }
    const bool back = move.speed < 0;
    const double along = back ? -ego.speed : ego.speed;
    const double wanted = std::clamp(2 * (std::abs(move.speed) - along), -2.5, 1.0);
    const Pedals::Position position =
        move.speed == 0 ? Pedals::Position{0, 0.5} : pedals.press(wanted, along, car, step);
    control.mutate_throttle(position.throttle);
    control.mutate_brake(position.brake);
    control.mutate_steer(move.steer);
    control.mutate_reverse(back);
    control.mutate_lamps(graph.town().left_hand ? world::lamp_right : world::lamp_left);
}

std::uint16_t Autopilot::State::lamps(const world::TickView& last, const Ego& ego) const {
    int lit = 0;
    const int around = graph.town().left_hand ? world::lamp_right : world::lamp_left;
    for (const Gate& gate : way.gates()) {
        if (gate.s - ego.front_s() > indicate_before || ego.rear_s() > gate.exit_s)
            continue;
        switch (gate.turn) {
            case world::Turn::left:
            case world::Turn::partially_left:
                lit |= world::lamp_left;
                break;
            case world::Turn::right:
            case world::Turn::partially_right:
                lit |= world::lamp_right;
                break;
            case world::Turn::around:
                lit |= around;
                break;
            case world::Turn::straight:
                break;
        }
        break;
    }
    for (const LaneChange& change : way.changes())
        if (change.start - ego.front_s() < indicate_before && ego.rear_axle_s < change.end)
            lit = change.to_left ? world::lamp_left : world::lamp_right;
    const world::Weather* weather = last.tick->weather();
    if (weather != nullptr &&
        (weather->rain() > 0 || static_cast<double>(weather->sun_altitude()) < low_sun))
        lit |= world::lamp_low_beam;
    return static_cast<std::uint16_t>(lit);
}

std::uint64_t Autopilot::digest() const {
    const State& state = *state_;
    world::Hasher hasher;
    state.way.add_to(hasher);
    state.gatekeeper.add_to(hasher);
    state.pedals.add_to(hasher);
    state.turn_around.add_to(hasher);
    hasher.add(state.turns_into);
    hasher.add(state.new_route.has_value());
    if (state.new_route) {
        hasher.add(std::span<const std::uint32_t>(state.new_route->stops));
        hasher.add(state.new_route->last_s);
    }
    hasher.add(state.new_lane.value_or(world::none));
    hasher.add(state.speed_cap.value_or(-1));  // a cap is never negative
    hasher.add(state.rear_axle_s);
    hasher.add(state.waiting_ticks);
    hasher.add(state.swings);
    if (state.swings)
        state.swing->add_to(hasher);
    hasher.add(state.on_way);
    return hasher.digest64();
}

}  // namespace reprise::kernel
