// The built-in driver: the lamps that it switches on.
#include "drivers/driver_state.h"

namespace reprise::drivers {

namespace {

constexpr double indicate_before = 30;  // [m]
constexpr double low_sun = 0.1;         // [rad]

}  // namespace

std::uint16_t DriverState::lamps(const world::TickView& last, const Ego& ego) const {
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
    if (const int side = passing.side(ego))
        lit = side > 0 ? world::lamp_left : world::lamp_right;
    const world::Weather* weather = last.tick->weather();
    if (weather != nullptr &&
        (weather->rain() > 0 || static_cast<double>(weather->sun_altitude()) < low_sun))
        lit |= world::lamp_low_beam;
    return static_cast<std::uint16_t>(lit);
}

}  // namespace reprise::drivers
