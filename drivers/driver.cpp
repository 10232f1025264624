#include "drivers/driver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "drivers/ego.h"
#include "drivers/gatekeeper.h"
#include "drivers/hazards.h"
#include "drivers/lane_change.h"
#include "drivers/lateral_order.h"
#include "drivers/navigator.h"
#include "drivers/pedals.h"
#include "drivers/speed_order.h"
#include "drivers/steering.h"
#include "drivers/turn_around.h"
#include "drivers/wide_turn.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/models/car_model.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double speed_gain = 0.8;      // [1/s]
constexpr double exact_gain = 3;        // [1/s] of one who is told a speed and when
constexpr double indicate_before = 30;  // [m]
constexpr double low_sun = 0.1;         // [rad]
constexpr double longest_wait = 12;     // [s] for room on the next lane
constexpr double end_reach = 3;         // [m] it stops 1 m before the end of the road
constexpr double slowest_order = 0.1;   // [m/s] below it a speed means: stand

world::CarModel model_with(std::uint16_t index) {
    REPRISE_CHECK(index < world::vehicle_models().size(), "model " + std::to_string(index));
    return world::car_model(world::vehicle_models()[index]);
}

}  // namespace

struct Autopilot::State {
    State(std::uint32_t actor_id,
          std::uint16_t model,
          const world::EpisodeT& episode,
          const RoadMap& road_map)
        : actor(actor_id),
          step(static_cast<double>(episode.step_ns) * 1e-9),
          car(model_with(model)),
          map(&road_map),
          navigator(road_map, episode.seed, actor_id, step, style.comfortable_braking),
          hazards(road_map.town),
          gatekeeper(road_map.town) {}

    const world::TownT& town() const { return map->town; }

    const Way& way() const { return navigator.way(); }

    bool has_tight_bends() const;
    void plan_wide_turns(const Ego& ego);
    double change_lanes(const world::TickView& last, Ego& ego);
    void begin_orders(const world::TickView& last, const Ego& ego);
    double cruise(const Ego& ego) const;
    double ordered_acceleration(const Ego& ego) const;
    double obedient_acceleration(const world::TickView& last, Ego& ego);
    double careful_acceleration(const world::TickView& last, Ego& ego);
    std::span<const SweptWidth> corridor(const Ego& ego);
    double approach_turn(const Ego& ego);
    void turn(const world::TickView& last, Ego& ego, world::Control& control);
    std::uint16_t lamps(const world::TickView& last, const Ego& ego) const;

    std::uint32_t actor;
    double step;  ///< [s] of a tick
    world::CarModel car;
    DrivingStyle style;
    const RoadMap* map;
    Navigator navigator;
    std::optional<WideTurnPlan> wide_turn;  ///< once there was a bend that needs it
    std::uint64_t wide_turn_of_way = 0;     ///< the way's plan_digest() that it was planned for
    bool has_wide_turn = false;             ///< on the way ahead
    Hazards hazards;
    Gatekeeper gatekeeper;
    Pedals pedals;
    TurnAround turn_around;
    std::uint32_t turns_into = 0;  ///< the lane behind the turn
    SpeedOrder speed_order;
    LateralOrder lateral_order;
    std::uint64_t tick = 0;                ///< the last one: not digested, nor what follows
    std::vector<SweptWidth> moved_swept_;  ///< beside the path
    std::uint32_t waiting_ticks = 0;       ///< beside cars on the lane that we want
    bool at_end = false;                   ///< follows from the last tick and the way: not digested
};

Autopilot::Autopilot(std::uint32_t actor,
                     std::uint16_t model,
                     const world::EpisodeT& episode,
                     const RoadMap& map)
    : state_(std::make_unique<State>(actor, model, episode, map)) {}

Autopilot::~Autopilot() = default;
Autopilot::Autopilot(Autopilot&&) noexcept = default;
Autopilot& Autopilot::operator=(Autopilot&&) noexcept = default;

void Autopilot::set_route(std::vector<std::uint32_t> lanes, double last_s) {
    state_->navigator.set_route(std::move(lanes), last_s);
}

void Autopilot::change_lane(std::uint32_t lane) {
    state_->navigator.change_lane(lane);
}

void Autopilot::keep_lane(bool keep) {
    state_->navigator.keep_lane(keep);
}

void Autopilot::switch_lane(std::uint32_t lane, double duration, world::Shape shape) {
    state_->navigator.switch_lane(lane);
    state_->lateral_order.come_over(duration, shape);
}

void Autopilot::set_offset(double offset, double duration, world::Shape shape) {
    state_->lateral_order.set_offset(offset, duration, shape);
}

void Autopilot::set_speed(double speed, double duration, world::Shape shape) {
    state_->speed_order.cap({0, speed, duration, shape});
}

void Autopilot::hold_speed(double speed, double duration, world::Shape shape) {
    state_->speed_order.hold({0, speed, duration, shape});
}

void Autopilot::end_hold() {
    state_->speed_order.end_hold();
}

void Autopilot::brake(double deceleration) {
    state_->speed_order.brake(deceleration);
}

void Autopilot::end_brake() {
    state_->speed_order.end_brake();
}

void Autopilot::free_speed() {
    state_->speed_order.free();
}

void Autopilot::ignore_lights(bool ignore) {
    state_->gatekeeper.ignore_lights(ignore);
}

void Autopilot::put_elsewhere() {
    state_->navigator.lose_way();
    state_->gatekeeper.reset();
    state_->turn_around = {};
    state_->waiting_ticks = 0;
    put_to_speed();
}

void Autopilot::put_to_speed() {
    state_->pedals = {};
}

bool Autopilot::is_under_way() const {
    return !state_->at_end && state_->speed_order.target() >= slowest_order;
}

const std::vector<std::uint32_t>& Autopilot::path() const {
    return state_->way().lanes();
}

/// What every driver does: where am I, where do I go, who is in the way, then hands and feet.
world::Control Autopilot::decide(const world::TickView& last) {
    State& state = *state_;
    const world::VehicleState* own = world::find(last.vehicles(), state.actor);
    REPRISE_CHECK(
        own != nullptr,
        "actor " + std::to_string(state.actor) + ", tick " + std::to_string(last.index()));
    Ego ego = ego_of(*own);
    state.tick = last.index();
    world::Control control(0, 0, 0, state.actor, 0, false, false);
    if (!state.turn_around.done())
        state.turn(last, ego, control);
    if (!state.turn_around.done())
        return control;

    state.at_end = false;
    // Where am I? Off every road there is nothing to follow: stop.
    const Navigator::Found found =
        state.navigator.follow(ego, state.lateral_order.offset(state.tick, state.step));
    if (found == Navigator::Found::nothing) {
        control.mutate_brake(0.5);
        return control;
    }
    if (found == Navigator::Found::another)
        state.gatekeeper.reset();

    state.at_end = state.way().ended() && state.way().path().end() - ego.front_s() < end_reach;

    // Who is in the way, and may I go on? The most careful answer counts, unless I am told.
    state.begin_orders(last, ego);
    state.plan_wide_turns(ego);
    const bool told = state.speed_order.reacts_to_nothing();
    const double acceleration =
        told ? state.obedient_acceleration(last, ego) : state.careful_acceleration(last, ego);
    const bool exact = told || state.speed_order.is_changing(state.tick, state.step);

    // Hands and feet.
    const double climb = state.way().path().climb(ego.rear_axle_s + ego.model->wheelbase / 2, 1);
    const Pedals::Position pedals =
        state.pedals.press(acceleration,
                           ego.speed,
                           climb,
                           state.car,
                           state.step,
                           exact ? Pedals::Manner::exact : Pedals::Manner::gentle);
    control.mutate_throttle(pedals.throttle);
    control.mutate_brake(pedals.brake);
    const std::optional<BesidePath> beside =
        state.lateral_order.beside(state.tick, state.step, ego.speed, tracked_ahead(*ego.model));
    control.mutate_steer(state.has_wide_turn ? steer(ego, *state.wide_turn, beside)
                                             : steer(ego, state.way().path(), beside));
    control.mutate_lamps(state.lamps(last, ego));
    return control;
}

/// What the scenario said since the last tick.
void Autopilot::State::begin_orders(const world::TickView& last, const Ego& ego) {
    speed_order.begin(tick, ego.speed, step);
    lateral_order.begin(
        tick, navigator.beside_way(ego), car, ego.speed, last.tick->road_friction());
    lateral_order.end(tick, step);
}

/// Whatever comes. A change of lanes is still put off for as long as there is no room.
double Autopilot::State::obedient_acceleration(const world::TickView& last, Ego& ego) {
    change_lanes(last, ego);
    plan_wide_turns(ego);
    return ordered_acceleration(ego);
}

double Autopilot::State::careful_acceleration(const world::TickView& last, Ego& ego) {
    double acceleration = cruise(ego);
    acceleration = std::min(acceleration, change_lanes(last, ego));
    acceleration = std::min(acceleration, approach_turn(ego));
    plan_wide_turns(ego);
    hazards.look(last, ego, way().path(), style, corridor(ego));
    acceleration = std::min(acceleration, hazards.acceleration());
    return std::min(acceleration,
                    gatekeeper.decide(last, ego, way(), hazards.overlaps(), style, step));
}

/// What the car will sweep beside its path; empty: its width everywhere.
std::span<const SweptWidth> Autopilot::State::corridor(const Ego& ego) {
    const std::span<const SweptWidth> swept =
        has_wide_turn ? wide_turn->swept() : std::span<const SweptWidth>();
    if (lateral_order.empty())
        return swept;
    const Path& path = way().path();
    const double half = ego.model->width / 2;
    moved_swept_.assign(path.points().size(), SweptWidth{half, half});
    if (!swept.empty())
        std::copy_n(
            swept.begin(), std::min(swept.size(), moved_swept_.size()), moved_swept_.begin());
    for (std::size_t i = 0; i < moved_swept_.size(); ++i) {
        const double later =
            std::max(path.s_of(i) - ego.rear_axle_s, 0.0) / std::max(ego.speed, 2.0);
        const double offset = lateral_order.offset(tick, step, later);
        moved_swept_[i].left += offset;
        moved_swept_[i].right -= offset;
    }
    return moved_swept_;
}

/// Of one who keeps to an ordered speed, or to the changing of one. [m/s^2]
double Autopilot::State::ordered_acceleration(const Ego& ego) const {
    const SpeedOrder::Wish wish = speed_order.wish(tick, step);
    return wish.acceleration + exact_gain * (wish.speed - ego.speed);
}

/// Bends that no steering can follow; those where we turn around are not driven along the path.
bool Autopilot::State::has_tight_bends() const {
    // [m] to both sides; the points' own curvature is over 6 m, where a jog cancels itself.
    constexpr double bend_reach = 1.5;
    const double sharpest =
        0.9 * std::tan(car.catalogue->max_steering_angle) / car.catalogue->wheelbase;
    const Path& path = way().path();
    for (std::size_t i = 0; i < path.points().size(); ++i) {
        const double s = path.s_of(i);
        if (std::abs(path.curvature(s, bend_reach)) < sharpest)
            continue;
        if (std::none_of(way().gates().begin(), way().gates().end(), [&](const Gate& gate) {
                return gate.turn == world::Turn::around && gate.s - 5 < s && s < gate.exit_s + 5;
            }))
            return true;
    }
    return false;
}

/// Bends that need it are planned when the way has changed.
void Autopilot::State::plan_wide_turns(const Ego& ego) {
    if (wide_turn_of_way == way().plan_digest() && !(has_wide_turn && wide_turn->empty()))
        return;
    wide_turn_of_way = way().plan_digest();
    has_wide_turn = WideTurnPlan::is_needed(*car.catalogue) || has_tight_bends();
    if (!has_wide_turn)
        return;
    if (!wide_turn)
        wide_turn.emplace(*car.catalogue, map->clearances);
    // What the scenario wants beside the path comes on top of the plan.
    Ego start = ego;
    if (!lateral_order.empty()) {
        const PathPoint here = way().path().at(ego.rear_axle_s);
        start.position = here.position;
        start.direction = here.direction;
        start.yaw = here.yaw;
    }
    wide_turn->plan(way().path(), start);
    has_wide_turn = !wide_turn->empty();
}

/// Before the path leaves our lane: is there room on the other one? If not, leave it later, and at
/// the latest place wait.
double Autopilot::State::change_lanes(const world::TickView& last, Ego& ego) {
    for (const LaneChange& change : way().changes()) {
        const double before = change.start - ego.front_s();
        if (before < 0 || before > 2 + ego.speed)
            continue;
        if (is_clear(last, ego, town(), change.to) || waiting_ticks * step > longest_wait) {
            if (before < 1)
                waiting_ticks = 0;
            return world::infinity;
        }
        if (change.spare > 5) {
            const double later = before + std::min(5 + ego.speed, change.spare);
            navigator.put_off_change(later, ego);
            return world::infinity;
        }
        waiting_ticks += ego.speed < 0.5 ? 1 : 0;
        return stop_acceleration(before, ego.speed, style.comfortable_braking, style);
    }
    return world::infinity;
}

/// The speed that lanes, curves and the scenario's cap allow, and dead ends. [m/s^2]
double Autopilot::State::cruise(const Ego& ego) const {
    const Path& path = way().path();
    const bool changing = speed_order.is_changing(tick, step);
    const double cap = changing ? speed_order.wish(tick, step).speed : speed_order.target();
    // A glance ahead makes up for the tick's delay.
    const double middle = ego.model->wheelbase / 2;
    const double s = ego.rear_axle_s + middle + ego.speed * step;
    const auto squared_speed = [&](double at) {
        const double most = path.at(at).squared_speed;
        return has_wide_turn ? std::min(most, wide_turn->at(at - middle).squared_speed) : most;
    };
    const double here = squared_speed(s);
    const double allowed = std::sqrt(here);
    double acceleration = speed_gain * (std::min(allowed, cap) - ego.speed);
    if (allowed < cap && ego.speed > allowed - 1) {
        acceleration +=
            std::clamp((squared_speed(s + 1) - here) / 2, -style.comfortable_braking, 0.0);
    }
    acceleration = std::clamp(acceleration, -4.0, style.acceleration);
    if (changing) {
        const double as_told = ordered_acceleration(ego);
        // A change takes what it takes, as long as the road allows the speed.
        acceleration = cap < allowed ? as_told : std::min(acceleration, as_told);
    }
    if (way().ended())
        acceleration = std::min(
            acceleration,
            stop_acceleration(
                path.end() - ego.front_s() - 1, ego.speed, style.comfortable_braking, style));
    return acceleration;
}

/// Stops where a turn begins that takes going back and forth, and begins it. [m/s^2]
double Autopilot::State::approach_turn(const Ego& ego) {
    constexpr double sight = 80;  // [m]
    const auto ahead = std::find_if(way().gates().begin(),
                                    way().gates().end(),
                                    [&](const Gate& gate) { return gate.s > ego.front_s() - 1; });
    if (ahead == way().gates().end() || ahead->turn != world::Turn::around ||
        ahead->s > ego.front_s() + sight)
        return world::infinity;
    const world::Link& link = town().lanes[ahead->from].links[ahead->link];
    const auto street = TurnAround::street_of(town(), ahead->from, link, *ego.model);
    if (!street)
        return world::infinity;
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
        navigator.start_on(turns_into, ego);
        return;
    }
    const bool back = move.speed < 0;
    const double along = back ? -ego.speed : ego.speed;
    const double wanted = std::clamp(2 * (std::abs(move.speed) - along), -2.5, 1.0);
    const double climb = (back ? -1 : 1) * turn_around.climb(ego);
    const Pedals::Position position = move.speed == 0 || speed_order.brakes()
                                          ? Pedals::Position{0, 0.5}
                                          : pedals.press(wanted, along, climb, car, step);
    control.mutate_throttle(position.throttle);
    control.mutate_brake(position.brake);
    control.mutate_steer(move.steer);
    control.mutate_reverse(back);
    control.mutate_lamps(town().left_hand ? world::lamp_right : world::lamp_left);
}

std::uint16_t Autopilot::State::lamps(const world::TickView& last, const Ego& ego) const {
    int lit = 0;
    const int around = town().left_hand ? world::lamp_right : world::lamp_left;
    for (const Gate& gate : way().gates()) {
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
    for (const LaneChange& change : way().changes())
        if (change.start - ego.front_s() < indicate_before && ego.rear_axle_s < change.end)
            lit = change.to_left ? world::lamp_left : world::lamp_right;
    if (const int side = lateral_order.side(tick, step))
        lit = side > 0 ? world::lamp_left : world::lamp_right;
    const world::Weather* weather = last.tick->weather();
    if (weather != nullptr &&
        (weather->rain() > 0 || static_cast<double>(weather->sun_altitude()) < low_sun))
        lit |= world::lamp_low_beam;
    return static_cast<std::uint16_t>(lit);
}

std::uint64_t Autopilot::digest() const {
    const State& state = *state_;
    world::Hasher hasher;
    state.navigator.add_to(hasher);
    state.gatekeeper.add_to(hasher);
    state.pedals.add_to(hasher);
    state.turn_around.add_to(hasher);
    hasher.add(state.turns_into);
    state.speed_order.add_to(hasher);
    state.lateral_order.add_to(hasher);
    hasher.add(state.waiting_ticks);
    hasher.add(state.has_wide_turn);
    if (state.has_wide_turn)
        state.wide_turn->add_to(hasher);
    return hasher.digest64();
}

}  // namespace reprise::drivers
