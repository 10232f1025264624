#include "drivers/way_back.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "drivers/bodies.h"
#include "drivers/driver_state.h"
#include "world/geometry2d.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

std::optional<world::LaneMap::Found> nearest_lane(const RoadMap& map, const Ego& ego) {
    constexpr double first_reach = 10;      // [m]
    constexpr double farthest_reach = 300;  // [m]
    for (double reach = first_reach; reach < farthest_reach; reach *= 2) {
        const auto found = map.lanes.at(ego.position, reach);
        const auto nearest =
            std::min_element(found.begin(), found.end(), [](const auto& one, const auto& other) {
                return one.at.distance < other.at.distance;
            });
        if (nearest != found.end())
            return *nearest;
    }
    return std::nullopt;
}

}  // namespace

double steer_back(const RoadMap& map, const Ego& ego, std::uint32_t tries) {
    constexpr double ahead_on_lane = 6;     // [m]
    constexpr std::uint32_t on_a_side = 4;  // tries, at 45 degrees to the lane
    constexpr double gain = 1.5;
    const auto lane = nearest_lane(map, ego);
    if (!lane)
        return 0;
    const double aside =
        tries == 0 ? 0 : ((tries - 1) / on_a_side % 2 == 0 ? 1 : -1) * lane->at.distance;
    const Eigen::Vector2d to =
        world::point_at(map.town.lanes[lane->lane], lane->at.s + ahead_on_lane + aside)
            .position.head<2>() -
        ego.position.head<2>();
    const double bearing = std::atan2(world::cross(ego.direction, to), ego.direction.dot(to));
    return std::clamp(gain * bearing / ego.model->max_steering_angle, -1.0, 1.0);
}

/// Who was pushed off every road drives back to it, slowly, and stops for whatever is before the
/// car; held by that he goes back, and tries another place. Who was told to stand stands.
void DriverState::drive_back(const world::TickView& last, const Ego& ego, world::Control& control) {
    constexpr double slow = 1.5;         // [m/s]
    constexpr double braking = 2;        // [m/s^2]
    constexpr double kept = 0.6;         // [m] from what is ahead
    constexpr double patience = 3;       // [s]
    constexpr double back = 4;           // [m]
    constexpr double least_order = 0.1;  // [m/s]
    if (pid || speed_order.reacts_to_nothing() || speed_order.target() < least_order) {
        control.mutate_brake(0.5);
        return;
    }
    const double speed = std::max(ego.speed, 0.0);
    const double reach = kept + 0.3 * speed + speed * speed / (2 * braking);
    const bool held = something_is_before(last, ego, reach) || wheels_lead_into_town(ego, reach);
    held_ticks = held && speed < 0.1 ? held_ticks + 1 : 0;
    if (held_ticks * step > patience && back_off.make_room(back, last, ego)) {
        held_ticks = 0;
        ++strays;
        news = {world::EventKind::backed_off,
                0,
                fmt::format("backs off {:.1f} m, to get back to the road", back_off.distance())};
    }
    creep(held ? 0 : std::min(slow, speed_order.target()), ego.speed, 0, control);
    control.mutate_steer(steer_back(*map, ego, strays));
}

}  // namespace reprise::drivers
