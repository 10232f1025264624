// The built-in driver: where beside its path it drives, and what it sweeps there.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "drivers/bodies.h"
#include "drivers/control/steering.h"
#include "drivers/driver_state.h"
#include "world/geometry2d.h"

namespace reprise::drivers {

namespace {

const char* through(PassingPlan::Uses uses) {
    switch (uses) {
        case PassingPlan::Uses::own_lane:
            return "within its lane";
        case PassingPlan::Uses::next_lane:
            return "through the lane beside";
        case PassingPlan::Uses::junction:
            return "over the junction";
        case PassingPlan::Uses::oncoming_lane:
            break;
    }
    return "through the oncoming lane";
}

}  // namespace

/// What the car will sweep beside its path; empty: its width everywhere.
std::span<const SweptWidth> DriverState::corridor(const Ego& ego) {
    const std::span<const SweptWidth> swept =
        has_wide_turn ? wide_turn->swept() : std::span<const SweptWidth>();
    if (lateral_order.empty() && !passing.plan())
        return swept;
    const Path& path = way().path();
    const double half = ego.model->width / 2;
    moved_swept.assign(path.points().size(), SweptWidth{half, half});
    if (!swept.empty())
        std::copy_n(swept.begin(), std::min(swept.size(), moved_swept.size()), moved_swept.begin());
    for (std::size_t i = 0; i < moved_swept.size(); ++i) {
        const double later =
            std::max(path.s_of(i) - ego.rear_axle_s, 0.0) / std::max(ego.speed, 2.0);
        const double offset = lateral_order.offset(tick, step, later) +
                              (passing.plan() ? passing.plan()->bypass.offset(path.s_of(i)) : 0);
        moved_swept[i].left += offset;
        moved_swept[i].right -= offset;
    }
    return moved_swept;
}

/// Bends that no steering can follow; those where we turn around are not driven along the path.
bool DriverState::has_tight_bends() const {
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
void DriverState::plan_wide_turns(const Ego& ego) {
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
    if (!lateral_order.empty() || passing.plan()) {
        const PathPoint here = way().path().at(ego.rear_axle_s);
        start.position = here.position;
        start.direction = here.direction;
        start.yaw = here.yaw;
    }
    wide_turn->plan(way().path(), start);
    has_wide_turn = !wide_turn->empty();
}

/// Of the rear axle, as far as it will have come since the last tick. [m]
double DriverState::expected_offset() const {
    return lateral_order.offset(tick, step) +
           (passing.plan() ? passing.plan()->bypass.offset(rear_axle_s) : 0);
}

/// Where beside the path the point that is steered along it is to be; none: on it.
std::optional<BesidePath> DriverState::beside(const Ego& ego) const {
    const double ahead = tracked_ahead(*ego.model);
    const std::optional<BesidePath> told = lateral_order.beside(tick, step, ego.speed, ahead);
    if (!passing.plan())
        return told;
    const double s = ego.rear_axle_s + ahead;
    BesidePath place =
        passing.plan()->bypass.beside(s, s + BesidePath::preview * std::max(ego.speed, 0.0));
    if (told) {
        place.offset += told->offset;
        place.slope += told->slope;
        place.bend += told->bend;
        place.bend_soon += told->bend_soon;
    }
    return place;
}

/// [m] left of its line, where the point is that is steered along it; beyond what a scenario wants.
/// The line is the path, or in bends that need more room what is planned there.
double DriverState::tracked_beside(const Ego& ego) const {
    const double ahead = tracked_ahead(*ego.model);
    const PathPoint on_path = way().path().at(ego.rear_axle_s + ahead);
    Eigen::Vector2d place = on_path.position.head<2>();
    Eigen::Vector2d direction = on_path.direction;
    if (has_wide_turn) {
        const WideTurnPoint there = wide_turn->at(ego.rear_axle_s);
        direction = world::ahead_of(there.yaw);
        place = there.position + ahead * direction;
    }
    const Eigen::Vector2d tracked = ego.position.head<2>() + ahead * ego.direction;
    return world::cross(direction, tracked - place) - lateral_order.offset(tick, step);
}

/// Around what stands in the way, where that is free; what it sees on the path is then looked at
/// anew.
void DriverState::pass(const world::TickView& last, const Ego& ego) {
    if (pid || lateral_order.side(tick, step) != 0)
        return;
    if (!may_overtake || way().keeps_lane()) {
        if (!passing.plan())
            notice_standoff(last, ego);
        return;
    }
    if (passing.consider(last, ego, way(), hazards.overlaps(), tracked_beside(ego), style)) {
        hazards.look(last, ego, way().path(), style, corridor(ego));
        const PassingPlan& plan = *passing.plan();
        news = {world::EventKind::overtakes, plan.row.front(), through(plan.uses)};
    } else if (passing.missing_room() > 0 &&
               back_off.make_room(passing.missing_room() + 0.5, last, ego)) {
        news = {world::EventKind::backed_off,
                0,
                fmt::format("backs off {:.1f} m, to get around what stands ahead",
                            back_off.distance())};
    } else if (!passing.plan()) {
        notice_standoff(last, ego);
    }
    constexpr double patience = 3;  // [s] with somebody close behind
    const bool is_cramped = passing.cramped() && !back_off.is_going_back();
    cramped_ticks = is_cramped ? cramped_ticks + 1 : 0;
    if (cramped_ticks * step > patience)
        begin_to_and_fro(ego);
}

/// Out of the gap between who stands ahead and who stands behind.
void DriverState::begin_to_and_fro(const Ego& ego) {
    const PathPoint here = way().path().at(ego.rear_axle_s);
    cramped_ticks = 0;
    to_and_fro.begin(here.position.head<2>(), here.direction, passing.cramped()->bypass.aside);
    news = {world::EventKind::overtakes,
            passing.cramped()->row.front(),
            fmt::format("{}, out of its gap to and fro", through(passing.cramped()->uses))};
}

/// Hands and feet until it is out beside the path; from there it is a line past something as any.
void DriverState::go_to_and_fro(const world::TickView& last,
                                const Ego& ego,
                                world::Control& control) {
    const ToAndFro::Move move = to_and_fro.next(last, ego);
    if (speed_order.reacts_to_nothing())
        to_and_fro.end();
    if (!to_and_fro.is_on()) {
        pedals = {};
        if (to_and_fro.has_come_out())
            passing.begin_beside(rear_axle_s);
        else
            navigator.lose_way();
        return;
    }
    const bool back = move.speed < 0;
    const double climb = way().path().climb(rear_axle_s, 1);
    creep(move.speed, back ? -ego.speed : ego.speed, back ? -climb : climb, control);
    control.mutate_steer(move.steer);
    control.mutate_lamps(passing.cramped() && passing.cramped()->bypass.aside < 0
                             ? world::lamp_right
                             : world::lamp_left);
}

/// Does it stand across our way, or face us, and wait for somebody, maybe for us?
bool DriverState::is_held_by(std::uint32_t other,
                             const world::TickView& last,
                             const PathPoint& there) const {
    constexpr double goes_our_way = 0.8;  // cosine
    constexpr double stands = 0.1;        // [m/s]
    if (const world::CarState* seen = world::find(last.cars(), other))
        return seen->speed() < static_cast<float>(stands) && !has_hazard_lights(seen->lamps()) &&
               there.direction.dot(world::ahead_of(static_cast<double>(seen->yaw()))) <
                   goes_our_way;
    const world::VehicleState* vehicle = world::find(last.vehicles(), other);
    if (vehicle == nullptr || other >= world::first_background_id ||
        (vehicle->lamps() & world::lamp_brake) == 0 || has_hazard_lights(vehicle->lamps()))
        return false;
    const Ego seen = ego_of(*vehicle);
    return std::abs(seen.speed) < stands && there.direction.dot(seen.direction) < goes_our_way;
}

/// Two may stand nose to flank in a junction, each where the other has to go. Neither can until one
/// makes room: who has it behind him goes back, and lets the other one go first. Of two who both
/// could it is the one who came into the world later.
void DriverState::notice_standoff(const world::TickView& last, const Ego& ego) {
    constexpr double patience = 10;     // [s] and as much more each time
    constexpr double other_first = 10;  // [s] longer
    constexpr double drives_on = 3;     // [m/s]
    constexpr double near = 7;          // [m] ahead
    constexpr double back = 2.5;        // [m]
    constexpr double more = 2;          // [m] each time
    const auto overlaps = hazards.overlaps();
    const auto nearest =
        std::min_element(overlaps.begin(), overlaps.end(), [](const auto& one, const auto& other) {
            return one.s < other.s;
        });
    const bool held = std::abs(ego.speed) < 0.1 && nearest != overlaps.end() &&
                      nearest->s - ego.front_s() < near &&
                      is_held_by(nearest->id, last, way().path().at(nearest->s));
    standoff_ticks = held ? standoff_ticks + 1 : 0;
    if (ego.speed > drives_on)
        standoffs = 0;
    const bool is_other_later =
        held && nearest->id > actor && world::find(last.vehicles(), nearest->id) != nullptr;
    const double wait = patience * (1 + standoffs) + (is_other_later ? other_first : 0);
    if (standoff_ticks * step < wait || !back_off.give_room(back + more * standoffs, last, ego))
        return;
    standoff_ticks = 0;
    ++standoffs;
    news = {world::EventKind::backed_off,
            0,
            fmt::format("backs off {:.1f} m, to let go who waits for it", back_off.distance())};
}

/// The way may be counted from elsewhere, or be another one: a line past something goes on if it
/// still leads on from where the car is. Else the car comes back to the way from there.
void DriverState::take_jump(const Ego& ego) {
    constexpr double same_line = 0.6;  // [m]
    const double jump = navigator.take_jump();
    if (!passing.plan() || jump == 0)
        return;
    passing.shift(jump);
    const double beside = tracked_beside(ego);
    const double s = ego.rear_axle_s + tracked_ahead(*ego.model);
    if (std::abs(beside - passing.plan()->bypass.offset(s)) > same_line) {
        passing.drop();
        if (lateral_order.side(tick, step) == 0)
            passing.come_back(ego, beside, style);
    }
}

}  // namespace reprise::drivers
