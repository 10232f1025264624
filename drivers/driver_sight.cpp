// The built-in driver: how near it drives past who stands beside its way.
#include <algorithm>
#include <cmath>

#include "drivers/driver_state.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double squeeze_speed = 2;     // [m/s]
constexpr double squeeze_patience = 4;  // [s]
constexpr double squeeze_gain = 2;      // [1/s]

}  // namespace

/// Who stands a hand's breadth too near beside the way, as two do who meet in a junction, may wait
/// for us as we for him: after a while we creep past him, with less room than one would like. Not
/// in a bend or on a line past something, where sides do not keep to a hand's breadth.
/// [m/s^2] for that
double DriverState::look_around(const world::TickView& last, const Ego& ego) {
    constexpr double near = 7;         // [m] before the bumper
    constexpr double straight = 0.02;  // [1/m] up to there
    constexpr double creeping = 1;     // [m/s]
    const auto is_held = [&] {
        const auto overlaps = hazards.overlaps();
        return std::any_of(overlaps.begin(), overlaps.end(), [&](const Overlap& one) {
            return one.s - ego.front_s() < near;
        });
    };
    const auto look = [&](Hazards::Room room) {
        hazards.look(last, ego, way().path(), style, corridor(ego), room);
    };
    const auto is_bent = [&] {
        const Path& path = way().path();
        for (double s = ego.rear_axle_s; s < ego.front_s() + near; s += Path::spacing)
            if (std::abs(path.at(s).curvature) > straight)
                return true;
        return passing.plan().has_value() || has_wide_turn;
    };
    look(Hazards::Room::ample);
    if (has_wide_turn && !passing.plan() && lateral_order.empty())
        return turn_past(last, ego);
    if (std::abs(ego.speed) > squeeze_speed || !is_held() || is_bent()) {
        wedged_ticks = 0;
        return world::infinity;
    }
    if (!pid && is_held_from_beside(ego)) {
        // What is on the line that it comes back on counts, not who is beside that.
        if (++wedged_ticks * step > squeeze_patience && lateral_order.side(tick, step) == 0) {
            wedged_ticks = 0;
            passing.come_back(ego, tracked_beside(ego), style);
            look(Hazards::Room::ample);
        }
        return world::infinity;
    }
    look(Hazards::Room::bare);
    wedged_ticks = is_held() ? 0 : wedged_ticks + 1;
    if (wedged_ticks * step > squeeze_patience)
        return squeeze_gain * (creeping - ego.speed);
    look(Hazards::Room::ample);
    return world::infinity;
}

/// In a tight turn a car needs so much of the road that who waits at the line beside its way out
/// is some centimetres nearer than one likes; and while our light is green, somebody waits there.
/// How far the body reaches is known better there than on other lines (see WideTurnPlan): after a
/// while we creep past. Behind a look with ample room. [m/s^2] for that
double DriverState::turn_past(const world::TickView& last, const Ego& ego) {
    constexpr double in_sight = 25;   // [m] before the bumper
    constexpr double further = 1;     // [m] that less room must help
    constexpr double creeping = 1.5;  // [m/s]
    const auto first = [&] {
        double least = in_sight;
        for (const Overlap& one : hazards.overlaps())
            least = std::min(least, one.s - ego.front_s());
        return least;
    };
    const double ample = first();
    if (std::abs(ego.speed) > squeeze_speed || ample == in_sight) {
        wedged_ticks = nosing_ticks = 0;
        return world::infinity;
    }
    const auto look = [&](Hazards::Room room) {
        hazards.look(last, ego, way().path(), style, corridor(ego), room);
    };
    look(Hazards::Room::close);
    wedged_ticks = first() < std::min(ample + further, in_sight) ? 0 : wedged_ticks + 1;
    if (wedged_ticks * step > squeeze_patience)
        return squeeze_gain * (creeping - ego.speed);
    look(Hazards::Room::ample);
    return nose_up(last, ego);
}

/// Two who stand nose to flank in a junction, one of them long: it comes nearer than one stands in
/// a queue, or what the other one gives it by going back would be what it keeps.
/// Behind a look with ample room. [m/s^2] for that
double DriverState::nose_up(const world::TickView& last, const Ego& ego) {
    constexpr double near = 7;      // [m] before the bumper
    constexpr double kept = 0.8;    // [m]
    constexpr double creeping = 1;  // [m/s]
    const auto overlaps = hazards.overlaps();
    const auto nearest = std::min_element(
        overlaps.begin(), overlaps.end(), [](const Overlap& one, const Overlap& other) {
            return one.s < other.s;
        });
    const bool is_held = nearest != overlaps.end() && nearest->s - ego.front_s() < near &&
                         is_held_by(nearest->id, last, way().path().at(nearest->s));
    nosing_ticks = is_held ? nosing_ticks + 1 : 0;
    if (nosing_ticks * step < squeeze_patience)
        return world::infinity;
    DrivingStyle close = style;
    close.standing_gap = kept;
    hazards.look(last, ego, way().path(), close, corridor(ego));
    return squeeze_gain * (creeping - ego.speed);
}

}  // namespace reprise::drivers
