#include "world/models/viewpoint.h"

#include <cmath>
#include <numbers>

namespace reprise::world {

namespace {

constexpr double fixed_within = 0.5;                              // [m] of a body
constexpr double down_from_seat = 2 * std::numbers::pi / 180;     // [rad]
constexpr double down_from_behind = 12 * std::numbers::pi / 180;  // [rad]

}  // namespace

bool is_carried_at(const Extent& extent, const Eigen::Vector3d& place) {
    return place.x() >= extent.rear - fixed_within && place.x() <= extent.front + fixed_within &&
           std::abs(place.y()) <= extent.half_width + fixed_within && place.z() >= -fixed_within &&
           place.z() <= extent.height + fixed_within;
}

Viewpoint drivers_eye(const VehicleModel& model) {
    return {{0.55 * model.wheelbase, 0, 0.85 * model.height}, -down_from_seat};
}

Viewpoint walkers_eye(const WalkerModel& model) {
    return {{model.shoulder_width / 2, 0, 0.93 * model.height}, -down_from_seat};
}

Viewpoint chase(const Extent& extent) {
    return {{extent.rear - 5.5, 0, extent.height + 1.6}, -down_from_behind};
}

}  // namespace reprise::world
