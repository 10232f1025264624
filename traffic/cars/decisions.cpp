#include "traffic/cars/decisions.h"

#include <libsumo/libsumo.h>

#include "traffic/cars/vehicle_lookup.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

// [ticks] that are skipped
constexpr std::uint32_t none_skipped = 0;
constexpr std::uint32_t rolling = 1;
constexpr std::uint32_t standing = 4;

/// Nothing but what SUMO sees decides how it drives.
bool is_left_to_sumo(const Car& car) {
    const bool is_ordered = car.speed_order || car.lane_order || car.offset_order ||
                            car.ignores_lights || !car.waiting.empty();
    const bool sees = car.held_back || car.pass || !car.waits_for.empty() ||
                      !car.blocked_by.empty() || !car.pushes_past.empty() || car.ignores_standing ||
                      car.lets_in_way != world::none;
    const bool has_lamps_about =
        car.on_call || car.goes_first || car.makes_way || car.way_speed != world::infinity;
    return car.origin == Origin::demand && car.lane != world::none && !is_ordered && !sees &&
           !has_lamps_about;
}

}  // namespace

std::uint32_t Decisions::may_skip(const Car& car) const {
    constexpr std::uint32_t settled = 20;   // [ticks] from when on it stands, not just stops
    constexpr double rolls = 3;             // [m/s]
    constexpr double brakes = -2;           // [m/s^2]
    constexpr double before_the_end = 4;    // [m] and
    constexpr double seconds_before = 0.3;  // of driving
    if (!is_left_to_sumo(car))
        return none_skipped;
    if (car.standing_ticks >= settled && car.speed == 0 && car.acceleration == 0)
        return standing;
    const double left = town_->lanes[car.lane].sumo_length - car.lane_position;
    const bool stays = left > before_the_end + seconds_before * car.speed;
    return stays && car.speed > rolls && car.acceleration > brakes ? rolling : none_skipped;
}

void Decisions::follow(Cars& cars) const {
    constexpr bool at_once = true;  // the next step is one with a decision
    for (Car& car : cars.all()) {
        if (car.sumo.empty())
            continue;
        const std::uint32_t skips = may_skip(car);
        if (skips == car.skips)
            continue;
        const KnownVehicle known(car.sumo, car.in_sumo);
        libsumo::Vehicle::setActionStepLength(car.sumo, (skips + 1) * step_, at_once);
        car.skips = skips;
    }
}

}  // namespace reprise::traffic
