#include "drivers/driver.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "drivers/control/steering.h"
#include "drivers/driver_state.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double end_reach = 3;        // [m] it stops 1 m before the end of the road
constexpr double slowest_order = 0.1;  // [m/s] below it a speed means: stand

world::CarModel model_with(std::uint16_t index) {
    REPRISE_CHECK(index < world::vehicle_models().size(), "model " + std::to_string(index));
    return world::car_model(world::vehicle_models()[index]);
}

}  // namespace

DriverState::DriverState(std::uint32_t actor_id,
                         std::uint16_t model,
                         const world::EpisodeT& episode,
                         const RoadMap& road_map,
                         world::Pilot pilot)
    : actor(actor_id),
      step(static_cast<double>(episode.step_ns) * 1e-9),
      car(model_with(model)),
      map(&road_map),
      navigator(road_map, episode.seed, actor_id, step, style.comfortable_braking),
      hazards(road_map.town),
      gatekeeper(road_map.town),
      passing(road_map, step),
      back_off(road_map, step),
      to_and_fro(step) {
    if (pilot == world::Pilot::pid)
        pid.emplace();
}

Autopilot::Autopilot(std::uint32_t actor,
                     std::uint16_t model,
                     const world::EpisodeT& episode,
                     const RoadMap& map,
                     world::Pilot pilot)
    : state_(std::make_unique<DriverState>(actor, model, episode, map, pilot)) {}

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
    state_->passing.drop();
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

/// A line that it has begun is driven to its end.
void Autopilot::may_overtake(bool may) {
    state_->may_overtake = may;
}

void Autopilot::put_elsewhere() {
    state_->navigator.lose_way();
    state_->gatekeeper.reset();
    state_->turn_around = {};
    state_->passing.drop();
    state_->back_off.end();
    state_->to_and_fro.end();
    state_->cramped_ticks = 0;
    state_->waiting_ticks = state_->standoff_ticks = state_->standoffs = state_->held_ticks =
        state_->nosing_ticks = 0;
    state_->strays = 0;
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
    DriverState& state = *state_;
    const world::VehicleState* own = world::find(last.vehicles(), state.actor);
    REPRISE_CHECK(
        own != nullptr,
        "actor " + std::to_string(state.actor) + ", tick " + std::to_string(last.index()));
    Ego ego = ego_of(*own);
    state.tick = last.index();
    world::Control control(0, 0, 0, state.actor, 0, false, false);
    state.notice_pushing(last, ego);
    if (state.back_off.is_going_back())
        state.go_back(last, ego, control);
    if (state.back_off.is_going_back())
        return control;
    if (state.to_and_fro.is_on())
        state.go_to_and_fro(last, ego, control);
    if (state.to_and_fro.is_on())
        return control;
    if (!state.turn_around.done())
        state.turn(last, ego, control);
    if (!state.turn_around.done())
        return control;

    state.at_end = false;
    // Where am I? Off every road there is nothing to follow: back to it.
    const Navigator::Found found = state.navigator.follow(ego, state.expected_offset());
    if (found == Navigator::Found::nothing) {
        state.drive_back(last, ego, control);
        return control;
    }
    state.strays = 0;
    if (found == Navigator::Found::another) {
        state.gatekeeper.reset();
        state.resume_turn(ego);
        if (!state.turn_around.done()) {
            state.turn(last, ego, control);
            return control;
        }
    }

    state.rear_axle_s = ego.rear_axle_s;
    state.notice_circling(last, ego);
    if (state.back_off.is_going_back()) {
        state.go_back(last, ego, control);
        return control;
    }
    state.take_jump(ego);
    state.style = style_on(last.tick->road_friction(), state.descent(ego), state.car);

    state.at_end = state.way().ended() && state.way().path().end() - ego.front_s() < end_reach;

    // Who is in the way, and may I go on? The most careful answer counts, unless I am told.
    state.begin_orders(last, ego);
    state.plan_wide_turns(ego);
    const bool told = state.speed_order.reacts_to_nothing();
    const double acceleration =
        told ? state.obedient_acceleration(last, ego) : state.careful_acceleration(last, ego);
    if (state.pid && !told) {
        const double most = std::min(
            std::sqrt(state.style.share * state.way().path().at(ego.front_s()).squared_speed),
            state.speed_order.target());
        const PidDriver::Answer said = state.pid->drive(
            ego, state.way().path(), acceleration, most, state.style.share, state.step);
        control.mutate_throttle(said.pedals.throttle);
        control.mutate_brake(said.pedals.brake);
        control.mutate_steer(said.steer);
        control.mutate_lamps(state.lamps(last, ego));
        return control;
    }
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
    const std::optional<BesidePath> beside = state.beside(ego);
    control.mutate_steer(state.has_wide_turn ? steer(ego, *state.wide_turn, beside)
                                             : steer(ego, state.way().path(), beside));
    if (const auto on = state.back_off.steer_on(ego, state.way().path(), ego.rear_axle_s))
        control.mutate_steer(*on);
    control.mutate_lamps(state.lamps(last, ego));
    return control;
}

/// What the scenario said since the last tick.
void DriverState::begin_orders(const world::TickView& last, const Ego& ego) {
    speed_order.begin(tick, ego.speed, step);
    lateral_order.begin(
        tick, navigator.beside_way(ego), car, ego.speed, last.tick->road_friction());
    lateral_order.end(tick, step);
}

/// Whatever comes. A change of lanes is still put off for as long as there is no room.
double DriverState::obedient_acceleration(const world::TickView& last, Ego& ego) {
    change_lanes(last, ego);
    plan_wide_turns(ego);
    return ordered_acceleration(ego);
}

double DriverState::careful_acceleration(const world::TickView& last, Ego& ego) {
    double acceleration = pid ? ended_acceleration(ego) : std::min(cruise(ego), off_line(ego));
    acceleration = std::min(acceleration, change_lanes(last, ego));
    acceleration = std::min(acceleration, approach_turn(last, ego));
    take_jump(ego);
    plan_wide_turns(ego);
    passing.follow(last, ego, way(), style);
    acceleration = std::min(acceleration, look_around(last, ego));
    pass(last, ego);
    acceleration =
        std::min({acceleration, past_junction_things(last, ego), last_resort(last, ego)});
    acceleration =
        std::min({acceleration, hazards.acceleration(), passing.acceleration(ego, style)});
    return std::min(acceleration,
                    gatekeeper.decide(last, ego, way(), hazards.overlaps(), style, step));
}

/// Over a junction a line past something may bend more than the car follows: hazards see what is on
/// the line, this what is where the car goes as its wheels stand. [m/s^2]
double DriverState::past_junction_things(const world::TickView& last, const Ego& ego) {
    constexpr double braking = 3;  // [m/s^2]
    if (!passing.plan() || passing.plan()->uses != PassingPlan::Uses::junction)
        return world::infinity;
    const double speed = std::max(ego.speed, 0.0);
    const double reach = 0.4 + 0.3 * speed + speed * speed / (2 * braking * style.share);
    if (!something_is_before(last, ego, reach))
        return world::infinity;
    if (speed < 0.1)
        passing.give_up();
    return -braking;
}

/// Whatever the plan says: what stands where the wheels lead now is not driven into. Where the car
/// is off its line, as behind a step back, hazards look at another place than it comes to, and
/// there are poles and walls. As late as it can be, as wheels turn on; fast ones keep to their
/// line. Who is held by it goes back. [m/s^2]
double DriverState::last_resort(const world::TickView& last, const Ego& ego) {
    constexpr double fastest = 7;     // [m/s]
    constexpr double stands = 0.5;    // [m/s]
    constexpr double braking = 7;     // [m/s^2]
    constexpr double reaction = 0.1;  // [s] until the brake bites
    constexpr double patience = 5;    // [s]
    constexpr double back = 2;        // [m]
    const double speed = std::max(ego.speed, 0.0);
    const double reach = 0.1 + reaction * speed + speed * speed / (2 * braking * style.share);
    const bool is_fast = speed > fastest * style.speed_share();
    const bool before_something = !is_fast && something_is_before(last, ego, reach, stands);
    if (!before_something && (is_fast || !town_is_before(ego, reach))) {
        held_ticks = 0;
        return world::infinity;
    }
    held_ticks = speed < 0.1 ? held_ticks + 1 : 0;
    if (held_ticks * step > patience && (before_something ? back_off.make_room(back, last, ego)
                                                          : back_off.turn_on(back, last, ego))) {
        held_ticks = 0;
        news = {
            world::EventKind::backed_off,
            0,
            fmt::format("backs off {:.1f} m, from what its wheels lead into", back_off.distance())};
    }
    return -braking;
}

/// Do the wheels lead into a pole or a wall? Of who creeps, with wheels turned far or askew of its
/// way: others are on it.
bool DriverState::town_is_before(const Ego& ego, double reach) const {
    constexpr double creeping = 3;  // [m/s]
    constexpr double far = 0.3;     // of the greatest angle
    constexpr double askew = 0.4;   // [rad]
    const bool is_askew =
        std::abs(world::wrap_angle(ego.yaw - way().path().at(ego.rear_axle_s).yaw)) > askew;
    return std::abs(ego.speed) <= creeping &&
           (is_askew || std::abs(ego.steering_angle) >= far * ego.model->max_steering_angle) &&
           wheels_lead_into_town(ego, reach);
}

bool DriverState::wheels_lead_into_town(const Ego& ego, double reach) const {
    constexpr double step_on = 0.25;  // [m]
    constexpr double margin = 0.05;   // [m]
    const double front = ego.model->length - ego.model->rear_overhang;
    const double curvature = std::tan(ego.steering_angle) / ego.model->wheelbase;
    Eigen::Vector3d axle = ego.position;
    double yaw = ego.yaw;
    for (double driven = 0; driven < reach + step_on; driven += step_on) {
        const Eigen::Vector3d ahead(std::cos(yaw), std::sin(yaw), 0);
        const Eigen::Vector3d left(-ahead.y(), ahead.x(), 0);
        const Eigen::Vector3d bow = axle + front * ahead;
        const Eigen::Vector3d side = ego.model->width / 2 * left;
        if (!map->clearances.is_clear(bow - side, bow + side, margin))
            return true;
        axle += step_on * ahead;
        yaw += step_on * curvature;
    }
    return false;
}

/// Far beside its way, as on a pavement, it is not held by who is ahead but by who stands on the
/// way beside it, and maybe waits for it.
bool DriverState::is_held_from_beside(const Ego& ego) const {
    constexpr double far = 1.5;     // [m]
    constexpr double stands = 0.1;  // [m/s]
    const auto overlaps = hazards.overlaps();
    return std::abs(ego.speed) < stands && std::abs(tracked_beside(ego)) > far &&
           !overlaps.empty() &&
           std::all_of(overlaps.begin(), overlaps.end(), [&](const Overlap& one) {
               return one.s < ego.front_s();
           });
}

/// Hands and feet while we turn around; when that is done, a new path on the lane behind it.
void DriverState::turn(const world::TickView& last, Ego& ego, world::Control& control) {
    const TurnAround::Move move = turn_around.next(last, ego);
    if (turn_around.done()) {
        gatekeeper.reset();
        navigator.start_on(turns_into, ego);
        return;
    }
    const bool back = move.speed < 0;
    creep(move.speed,
          back ? -ego.speed : ego.speed,
          (back ? -1 : 1) * turn_around.climb(ego),
          control);
    control.mutate_steer(move.steer);
    control.mutate_lamps(town().left_hand ? world::lamp_right : world::lamp_left);
}

/// Slowly, in either direction: speed below 0 is backwards. `along`: the car's speed that way,
/// `climb`: the road's.
void DriverState::creep(double speed, double along, double climb, world::Control& control) {
    const double wanted = std::clamp(2 * (std::abs(speed) - along), -2.5, 1.0);
    const Pedals::Position position = speed == 0 || speed_order.brakes()
                                          ? Pedals::Position{0, 0.5}
                                          : pedals.press(wanted, along, climb, car, step);
    control.mutate_throttle(position.throttle);
    control.mutate_brake(position.brake);
    control.mutate_reverse(speed < 0);
}

/// Held by something, with the foot on the throttle? Who was told a speed reacts to nothing.
void DriverState::notice_pushing(const world::TickView& last, const Ego& ego) {
    news.reset();
    const world::Control* given = world::find(last.controls(), actor);
    const bool told = speed_order.reacts_to_nothing();
    if (back_off.notice(last, ego, given == nullptr || told || pid ? 0 : given->throttle()))
        news = {world::EventKind::backed_off,
                0,
                fmt::format("backs off {:.1f} m, after pushing against something for 2 s",
                            back_off.distance())};
}

/// Where the lanes of a map bend more than the car can, or jump aside, it would drive in circles.
void DriverState::notice_circling(const world::TickView& last, const Ego& ego) {
    const world::Control* given = world::find(last.controls(), actor);
    const bool told = speed_order.reacts_to_nothing();
    if (given == nullptr || told || pid)
        return;
    if (back_off.notice_circling(ego, ego.rear_axle_s, given->steer()))
        news = {world::EventKind::backed_off,
                0,
                fmt::format("backs off {:.1f} m, to get around a bend", back_off.distance())};
}

/// Hands and feet while we go back; when that is done, a new path from there.
void DriverState::go_back(const world::TickView& last, Ego& ego, world::Control& control) {
    const Path& path = way().path();
    const bool has_path = !path.empty();
    const double climb = has_path ? -path.climb(rear_axle_s, 1) : 0;
    const BackOff::Move move = back_off.next(last, ego, has_path ? &path : nullptr, rear_axle_s);
    if (!back_off.is_going_back()) {
        passing.drop();
        pedals = {};
        if (turn_around.done())
            navigator.lose_way();
        return;
    }
    creep(-move.speed, -ego.speed, climb, control);
    control.mutate_steer(move.steer);
    control.mutate_lamps(lamps(last, ego));
}

const DriverNews* Autopilot::news() const {
    return state_->news ? &*state_->news : nullptr;
}

std::uint64_t Autopilot::digest() const {
    const DriverState& state = *state_;
    world::Hasher hasher;
    state.navigator.add_to(hasher);
    state.gatekeeper.add_to(hasher);
    state.pedals.add_to(hasher);
    state.turn_around.add_to(hasher);
    hasher.add(state.turns_into);
    state.speed_order.add_to(hasher);
    state.lateral_order.add_to(hasher);
    if (state.may_overtake)
        hasher.add(state.may_overtake);
    state.passing.add_to(hasher);
    state.back_off.add_to(hasher);
    state.to_and_fro.add_to(hasher);
    if (state.cramped_ticks > 0)
        hasher.add(state.cramped_ticks);
    if (state.pid)
        state.pid->add_to(hasher);
    hasher.add(state.waiting_ticks);
    if (state.standoff_ticks > 0)
        hasher.add(state.standoff_ticks);
    if (state.standoffs > 0)
        hasher.add(state.standoffs);
    if (state.strays > 0)
        hasher.add(state.strays);
    if (state.held_ticks > 0)
        hasher.add(state.held_ticks);
    if (state.turner_ticks > 0)
        hasher.add(state.turner_ticks);
    if (state.wedged_ticks > 0)
        hasher.add(state.wedged_ticks);
    if (state.nosing_ticks > 0)
        hasher.add(state.nosing_ticks);
    hasher.add(state.has_wide_turn);
    if (state.has_wide_turn)
        state.wide_turn->add_to(hasher);
    return hasher.digest64();
}

}  // namespace reprise::drivers
