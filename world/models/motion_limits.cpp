#include "world/models/motion_limits.h"

#include <algorithm>
#include <cmath>

#include "world/transition.h"
#include "world/units.h"

namespace reprise::world {

namespace {

constexpr double used_grip = 0.55;       // of it: so far tyres answer nearly in proportion
constexpr double used_steering = 0.8;    // of its largest angle
constexpr double steepest_course = 0.5;  // [rad] to the road
constexpr double corner_error = 0.15;    // [m] by which a linear change is missed at its ends

}  // namespace

double quickest_shift(
    const CarModel& car, double distance, Shape shape, double speed, double road_friction) {
    if (distance == 0)
        return 0;
    if (speed < 0.1)
        return infinity;
    const double sharpest =
        std::tan(used_steering * car.catalogue->max_steering_angle) / car.catalogue->wheelbase;
    const double sideways =
        std::min(used_grip * car.grip * road_friction * gravity, speed * speed * sharpest);
    const double far = std::abs(distance);
    const double by_course = far * fastest_rate(shape) / (speed * steepest_course);
    const double by_grip = shape == Shape::linear
                               ? far / std::sqrt(2 * corner_error * sideways)
                               : std::sqrt(far * largest_acceleration(shape) / sideways);
    return std::max(by_course, by_grip);
}

double hardest_braking(const CarModel& car, double road_friction) {
    return std::min(car.brake_deceleration, car.grip * road_friction * gravity);
}

double hardest_accelerating(const CarModel& car, double speed, double road_friction) {
    const VehicleModel& model = *car.catalogue;
    const double driven = car.front_driven ? car.front_share : 1 - car.front_share;
    const double road = car.grip * road_friction * gravity * driven;
    const double resistance = air_density * model.drag_area * speed * speed / (2 * model.mass) +
                              car.rolling_resistance * gravity;
    return std::min(drive_force(car, 1, false, speed) / model.mass, road) - resistance;
}

}  // namespace reprise::world
