#include "drivers/gatekeeper.h"

#include <algorithm>
#include <cmath>

#include "drivers/turning_room.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

using world::SignalColor;
using world::Turn;

constexpr double line_distance = 1;     // [m] from the lane's end to our bumper when we stand
constexpr double held_back = 9;         // [m] the same while somebody long turns in beside us
constexpr double yellow_braking = 3.5;  // [m/s^2] harder than this we rather drive through
constexpr double red_braking = 7;       // [m/s^2] at red only what is hardly possible
constexpr double patience = 12;         // [s]
constexpr double row_patience = 45;     // [s] before junctions that have no room between them
constexpr double line_patience = 8;     // [s] for those who stand at the other lines
constexpr double at_the_line = 5;       // [m] who stands so far before it waits there
constexpr double room_behind = 2.5;     // [m] more than our length
constexpr double creep_speed = 1.8;     // [m/s]
constexpr double conflict_sight = 120;  // [m]
constexpr double time_margin = 0.8;     // [s] between them and us
constexpr double space_margin = 2;      // [m] around the place where the ways meet

SignalColor color_of(const world::TickView& last, std::uint32_t signal) {
    return signal < last.signals().size() ? last.signals()[signal] : SignalColor::off;
}

/// What one who runs red lights takes this one for.
SignalColor ignored(SignalColor color) {
    switch (color) {
        case SignalColor::red:
        case SignalColor::red_yellow:
        case SignalColor::yellow:
            return SignalColor::green;
        case SignalColor::stop:
            return SignalColor::green_minor;
        default:
            return color;
    }
}

bool is_left(Turn turn) {
    return turn == Turn::left || turn == Turn::partially_left || turn == Turn::around;
}

bool is_right(Turn turn) {
    return turn == Turn::right || turn == Turn::partially_right;
}

bool must_give_way(const Gate& gate, SignalColor color) {
    if (color == SignalColor::off)
        return gate.yields;
    return color == SignalColor::green_minor || color == SignalColor::stop;
}

/// Before the junction: does the traffic of that lane go before us?
bool goes_first(const ConflictPoint& conflict,
                SignalColor their_color,
                SignalColor our_color,
                Turn our_turn) {
    switch (their_color) {
        case SignalColor::red:
        case SignalColor::red_yellow:
        case SignalColor::stop:
            return false;
        case SignalColor::green:
        case SignalColor::yellow:
            return true;
        case SignalColor::green_minor:
            return our_color != SignalColor::green_minor ||
                   (is_left(our_turn) && !is_left(conflict.turn));
        case SignalColor::off:
            break;
    }
    if (!conflict.yields)
        return true;
    return conflict.from_right ||
           (conflict.oncoming && is_left(our_turn) && !is_left(conflict.turn));
}

/// Somebody on a conflicting lane: where the front bumper is on that lane, and how fast.
struct Comer {
    double front_s = 0;
    double speed = 0;
    double length = 0;
    std::uint16_t lamps = 0;
};

/// From when until when somebody is at the place where the ways meet. [s]
struct Stay {
    double from = 0;
    double to = 0;
};

bool meet(const Stay& ours, const Stay& theirs) {
    return theirs.from < ours.to + time_margin && theirs.to > ours.from - time_margin;
}

/// [s] until one who turns has driven `inside` metres of a junction that begins `to_line` metres
/// ahead of him: he brakes for it.
double turning_time(double to_line, double inside, double speed, double pace) {
    constexpr double braking = 2.5;  // [m/s^2]
    if (speed <= pace)
        return travel_time(to_line, speed, 1, pace) + inside / pace;
    const double slows = (speed * speed - pace * pace) / (2 * braking);
    const double slowing = std::min(slows, to_line);
    return (to_line - slowing) / speed + slowing / ((speed + pace) / 2) + inside / pace;
}

bool conflicts(const Comer& comer,
               const ConflictPoint& conflict,
               const Stay& ours,
               const world::LaneT& lane) {
    const double to_meeting = conflict.to_conflict - comer.front_s;
    if (to_meeting + comer.length + space_margin < 0)
        return false;
    if (!conflict.inside) {
        // Stands in a queue, or shows that it turns another way.
        if (comer.speed < 0.5 && lane.length - comer.front_s > 8)
            return false;
        if (((comer.lamps & world::lamp_left) != 0 && !is_left(conflict.turn)) ||
            ((comer.lamps & world::lamp_right) != 0 && !is_right(conflict.turn)))
            return false;
    } else if (comer.speed < 0.3 && to_meeting > 3) {
        return false;  // waits in the junction, perhaps for us
    }
    const double top = std::max({comer.speed, lane.speed_limit * 0.8, 3.0});
    const double to_leave = to_meeting + comer.length + space_margin;
    const double to_line = conflict.inside ? 0 : std::max(lane.length - comer.front_s, 0.0);
    const double slowest =
        std::max(travel_time(to_leave, comer.speed, 1, top),
                 turning_time(to_line, to_leave - to_line, comer.speed, conflict.pace));
    const Stay theirs{travel_time(to_meeting - space_margin, comer.speed, 2, top), slowest};
    return meet(ours, theirs);
}

/// Stands at the end of another lane that leads into the junction, his nose beside our way.
bool waits_at_line(const world::TickView& last,
                   const world::TownT& town,
                   const Way& way,
                   const Overlap& other) {
    constexpr double stands = 0.1;  // [m/s]
    const world::CarState* car = world::find(last.cars(), other.id);
    if (car == nullptr || car->lane() >= town.lanes.size() ||
        std::abs(static_cast<double>(car->speed())) > stands)
        return false;
    const world::LaneT& lane = town.lanes[car->lane()];
    return lane.kind == world::LaneKind::driving &&
           lane.length - static_cast<double>(car->lane_s()) < at_the_line &&
           std::find(way.lanes().begin(), way.lanes().end(), car->lane()) == way.lanes().end();
}

/// How far along the path nobody may stand, for us to find room where we stand in no way: behind
/// the junction, or behind the last one of a row that has too little room in between.
double end_of_room(const Way& way, const Gate& gate, double length) {
    double exit_s = gate.exit_s;
    for (const Gate& next : way.gates()) {
        if (next.s < exit_s || !next.crossed)
            continue;
        if (next.s - exit_s >= length)
            return std::min(exit_s + length + room_behind, next.s - 1);
        exit_s = next.exit_s;
    }
    return exit_s + length + room_behind;
}

}  // namespace

Gatekeeper::Gatekeeper(const world::TownT& town) : town_(&town) {}

void Gatekeeper::reset() {
    yellow_gate_ = waiting_gate_ = full_gate_ = stopped_gate_ = creeping_gate_ = world::none;
    waited_ticks_ = full_ticks_ = 0;
}

double Gatekeeper::decide(const world::TickView& last,
                          const Ego& ego,
                          const Way& way,
                          std::span<const Overlap> overlaps,
                          const DrivingStyle& style,
                          double step) {
    const double sight = std::max(40.0, ego.speed * ego.speed / (3 * style.share) + 15);
    for (const Gate& gate : way.gates()) {
        const double to_line = gate.s - ego.front_s();
        if (to_line > sight)
            break;
        if (to_line < 0) {
            // Creep until the whole junction is behind us.
            if (gate.serial == creeping_gate_ && ego.front_s() < gate.exit_s)
                return creep_speed - ego.speed;
            continue;
        }
        if (must_stop(last, ego, way, gate, overlaps, style, step)) {
            // Whoever comes to stop nearer to the line need not stamp on the brake for it.
            double distance = std::max(to_line - line_distance, to_line / 2);
            if (turns_in_beside(last, *town_, gate, ego.id))
                distance =
                    std::min(distance,
                             std::max(to_line - held_back,
                                      ego.speed * ego.speed / (2 * style.comfortable_braking)));
            return stop_acceleration(distance, ego.speed, style.comfortable_braking, style);
        }
        if (gate.serial == creeping_gate_)
            return creep_speed - ego.speed;
    }
    return world::infinity;
}

bool Gatekeeper::must_stop(const world::TickView& last,
                           const Ego& ego,
                           const Way& way,
                           const Gate& gate,
                           std::span<const Overlap> overlaps,
                           const DrivingStyle& style,
                           double step) {
    // As on a dry road: what the road gives counts for all of it.
    const double squared = ego.speed * ego.speed / style.share;
    const double to_line = gate.s - ego.front_s();
    const double needed = squared / (2 * std::max(to_line, 0.1));
    const SignalColor color =
        ignores_lights_ ? ignored(color_of(last, gate.signal)) : color_of(last, gate.signal);
    if (color == SignalColor::yellow) {
        const double room = std::max(to_line - line_distance, to_line / 2);
        return stops_at_yellow(gate, squared / (2 * std::max(room, 0.1)));
    }
    if (color == SignalColor::red || color == SignalColor::red_yellow) {
        const bool drove_on = gate.serial == yellow_gate_ && !yellow_stop_ && ego.speed > 3;
        return !drove_on && needed < red_braking;
    }

    // Free to go by the light; from here on it is a question of the others. Too late to ask when we
    // could not stop any more.
    if (needed > yellow_braking)
        return false;
    bool stop = !has_room(last, ego, way, gate, overlaps, step);
    if (must_give_way(gate, color)) {
        const bool give_way =
            must_halt(gate, color, ego, to_line) || !has_gap(last, ego, way, gate, style);
        if (gate.serial != waiting_gate_) {
            waiting_gate_ = gate.serial;
            waited_ticks_ = 0;
        }
        if (give_way && ego.speed < 0.5 && to_line < at_the_line)
            ++waited_ticks_;
        if (waited_ticks_ * step > patience)
            creeping_gate_ = gate.serial;
        stop = stop || (give_way && gate.serial != creeping_gate_);
    }
    return stop;
}

bool Gatekeeper::stops_at_yellow(const Gate& gate, double needed) {
    // Decided once, or it would change its mind while it brakes.
    if (yellow_gate_ != gate.serial) {
        yellow_gate_ = gate.serial;
        yellow_stop_ = needed <= yellow_braking;
    }
    return yellow_stop_;
}

/// Once, whether somebody comes or not: a sign, where no light says otherwise.
bool Gatekeeper::must_halt(const Gate& gate, SignalColor color, const Ego& ego, double to_line) {
    const bool sign = color == SignalColor::off && gate.has_stop_sign && !ignores_lights_;
    if (color != SignalColor::stop && !sign)
        return false;
    if (ego.speed < 0.1 && to_line < 4)
        stopped_gate_ = gate.serial;
    return gate.serial != stopped_gate_;
}

bool Gatekeeper::has_room(const world::TickView& last,
                          const Ego& ego,
                          const Way& way,
                          const Gate& gate,
                          std::span<const Overlap> overlaps,
                          double step) {
    if (!gate.crossed)
        return true;
    // At the other lines one always stands: who waits until all of them are gone, while they wait
    // for nobody, never comes to drive.
    const bool past_lines = gate.serial == full_gate_ && full_ticks_ * step > line_patience;
    const auto is_free_until = [&](double to) {
        return std::none_of(overlaps.begin(), overlaps.end(), [&](const Overlap& one) {
            return one.s > gate.s && one.s < to && std::abs(one.speed) < 1.5 &&
                   !(past_lines && one.s < gate.exit_s && waits_at_line(last, *town_, way, one));
        });
    };
    const double length = ego.model->length;
    const double needed =
        std::min(length + room_behind, std::max(town_->lanes[gate.to].length - 1, 1.0));
    const bool is_first_free = is_free_until(gate.exit_s + needed);
    if (is_first_free && is_free_until(end_of_room(way, gate, length)))
        return true;
    // Those in the next junction may wait for somebody who waits for us; and where others fill each
    // gap of a queue that goes on, we have waited as well.
    const bool is_next = ego.speed < 0.5 && gate.s - ego.front_s() < at_the_line;
    if (is_next && gate.serial != full_gate_) {
        full_gate_ = gate.serial;
        full_ticks_ = 0;
    }
    if (is_next)
        ++full_ticks_;
    return is_first_free && gate.serial == full_gate_ && full_ticks_ * step > row_patience;
}

bool Gatekeeper::has_gap(const world::TickView& last,
                         const Ego& ego,
                         const Way& way,
                         const Gate& gate,
                         const DrivingStyle& style) const {
    const SignalColor our_color = color_of(last, gate.signal);
    const auto threatens = [&](const Comer& comer, std::uint32_t lane) {
        return std::any_of(
            gate.conflicts.begin(), gate.conflicts.end(), [&](const ConflictPoint& conflict) {
                if (conflict.lane != lane)
                    return false;
                const SignalColor their_color = color_of(last, conflict.signal);
                if (!conflict.inside && !goes_first(conflict, their_color, our_color, gate.turn))
                    return false;
                const double allowed =
                    std::sqrt(style.share * way.path().at(conflict.our_s).squared_speed);
                const double top = std::max({ego.speed, allowed, 3 * style.speed_share()});
                const double ahead = conflict.our_s - ego.front_s();
                const Stay ours{travel_time(ahead - space_margin, ego.speed, 2 * style.share, top),
                                travel_time(ahead + ego.model->length + space_margin,
                                            ego.speed,
                                            1.5 * style.share,
                                            top)};
                return conflicts(comer, conflict, ours, town_->lanes[lane]);
            });
    };
    for (const world::CarState& car : last.cars()) {
        if (car.lane() == world::none ||
            std::abs(car.position().x() - ego.position.x()) > conflict_sight ||
            std::abs(car.position().y() - ego.position.y()) > conflict_sight)
            continue;
        const Comer comer{static_cast<double>(car.lane_s()),
                          static_cast<double>(car.speed()),
                          world::vehicle_models()[car.model()].length,
                          car.lamps()};
        if (threatens(comer, car.lane()))
            return false;
    }
    for (const world::VehicleState& other : last.vehicles()) {
        const world::Measurement* measured = world::find(last.measurements(), other.id());
        if (other.id() == ego.id || measured == nullptr || measured->lane() == world::none)
            continue;
        const world::VehicleModel& model = world::vehicle_models()[other.model()];
        const Comer comer{measured->lane_s() + model.length - model.rear_overhang,
                          measured->speed(),
                          model.length,
                          other.lamps()};
        if (threatens(comer, measured->lane()))
            return false;
    }
    return true;
}

void Gatekeeper::add_to(world::Hasher& hasher) const {
    hasher.add(yellow_gate_);
    hasher.add(yellow_stop_);
    hasher.add(waiting_gate_);
    hasher.add(waited_ticks_);
    if (full_gate_ != world::none) {
        hasher.add(full_gate_);
        hasher.add(full_ticks_);
    }
    hasher.add(stopped_gate_);
    hasher.add(creeping_gate_);
    if (ignores_lights_)
        hasher.add(true);
}

}  // namespace reprise::drivers
