#include "world/models/car_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace reprise::world {

namespace {

/// What the catalogue does not hold and follows from the kind of body: typical values from the
/// sources named in vehicle.h.
struct Kind {
    double com_height;   // [m]
    double front_share;  // of the weight
    bool front_driven;
    double clearance;           // [m] under the body; kerbs are 0.15 m
    double grip;                // force / load on dry asphalt
    double brake_deceleration;  // [m/s^2]
    double rolling_resistance;  // force / load
    double frequency;           // [Hz] body on its springs
};

Kind kind_of(BodyStyle body) {
    switch (body) {
        case BodyStyle::hatchback:
            return {0.54, 0.60, true, 0.22, 1.05, 9.5, 0.012, 1.4};
        case BodyStyle::sedan:
            return {0.54, 0.57, true, 0.22, 1.05, 9.5, 0.012, 1.4};
        case BodyStyle::suv:
            return {0.66, 0.55, true, 0.26, 1.05, 9.5, 0.012, 1.4};
        case BodyStyle::van:
            return {0.75, 0.55, true, 0.24, 1.00, 9.0, 0.012, 1.5};
        case BodyStyle::lorry:
            return {1.15, 0.42, false, 0.45, 0.85, 7.5, 0.008, 1.7};
        case BodyStyle::bus:
            return {1.15, 0.36, false, 0.32, 0.85, 7.5, 0.008, 1.6};
        case BodyStyle::wagon:
            return {0.56, 0.54, true, 0.22, 1.05, 9.5, 0.012, 1.4};
        case BodyStyle::coupe:
            return {0.46, 0.48, false, 0.19, 1.10, 10.2, 0.012, 1.7};
        case BodyStyle::pickup:
            return {0.72, 0.55, false, 0.28, 1.00, 9.0, 0.012, 1.5};
        case BodyStyle::minibus:
            return {0.85, 0.50, false, 0.26, 0.95, 8.5, 0.011, 1.5};
        case BodyStyle::motorcycle:
            return {0.18, 0.50, false, 0.22, 1.00, 8.8, 0.015, 2.4};
        case BodyStyle::bicycle:
            return {0.16, 0.45, false, 0.22, 0.80, 7.0, 0.006, 2.4};
    }
    return {};
}

constexpr double wrong_gear_speed = 2.0;  // [m/s]

/// Of the brush model; at z = 1 the whole contact slides.
double share_at(double z) {
    return z >= 1 ? 1 : z * (3 - z * (3 - z));
}

/// Where all the power is spent on air and rolling. [m/s]
double top_speed(const VehicleModel& model, double rolling_resistance) {
    const double air = 0.5 * air_density * model.drag_area;
    const double rolling = rolling_resistance * model.mass * gravity;
    double speed = std::cbrt(model.power / air);
    for (int i = 0; i < 20; ++i) {  // Newton, from above: convex, so it never overshoots
        const double rest = air * speed * speed * speed + rolling * speed - model.power;
        speed -= rest / (3 * air * speed * speed + rolling);
    }
    return speed;
}

}  // namespace

CarModel car_model(const VehicleModel& m) {
    const Kind kind = kind_of(m.body);
    CarModel car;
    car.catalogue = &m;
    car.track = m.track;
    car.com_ahead = kind.front_share * m.wheelbase;
    car.com_height = kind.com_height;
    car.front_share = kind.front_share;
    car.front_driven = kind.front_driven;
    car.grip = kind.grip;
    car.brake_deceleration = kind.brake_deceleration;
    car.rolling_resistance = kind.rolling_resistance;
    car.spring_frequency = 2 * std::numbers::pi * kind.frequency;

    const double box_height = m.height - kind.clearance;
    car.box_half = Eigen::Vector3d(m.length, m.width, box_height) / 2;
    car.box_centre = {m.length / 2 - m.rear_overhang - car.com_ahead,
                      0,
                      kind.clearance + box_height / 2 - kind.com_height};
    // Yaw and pitch: dynamic index k^2 / (a b) close to 1, as for most cars
    // (Mitschke/Wallentowitz); roll: as an even box.
    const double yaw = m.mass * car.com_ahead * (m.wheelbase - car.com_ahead);
    const double roll = m.mass / 12 * (m.width * m.width + m.height * m.height);
    car.inertia = {roll, 0.95 * yaw, yaw};
    car.powertrain = powertrain(m, top_speed(m, kind.rolling_resistance));
    return car;
}

CarModel unbalanced_model(const VehicleModel& m) {
    CarModel car = car_model(m);
    if (!is_two_wheeler(m.body))
        return car;
    // With the rider on it: V. Cossalter, "Motorcycle Dynamics", 2nd ed., 3.2 (0.5 to 0.7 m);
    // D. G. Wilson, "Bicycling Science", 4th ed., ch. 8 (about 1 m).
    const double com_height = m.body == BodyStyle::motorcycle ? 0.65 : 1.0;
    car.track = 0;
    car.box_centre.z() += car.com_height - com_height;
    car.com_height = com_height;
    car.brake_deceleration = 3;  // a hand's, not an emergency's: it does not turn over its front
    const double l2 = m.length * m.length;
    const double w2 = m.width * m.width;
    const double h2 = m.height * m.height;
    car.inertia = Eigen::Vector3d(w2 + h2, l2 + h2, l2 + w2) * (m.mass / 12);
    return car;
}

double drive_force(const CarModel& car, double throttle, bool reverse, double speed) {
    const double along = reverse ? -speed : speed;
    if (along < -wrong_gear_speed)
        return 0;
    const double rolling = std::max(along, 0.0);
    if (!reverse)
        return throttle * car.powertrain.largest_force(rolling);
    const double fading = std::clamp(reverse_speed - along, 0.0, 1.0);
    return -throttle * fading *
           (car.powertrain.gears > 0 ? car.powertrain.force(1, rolling)
                                     : car.powertrain.largest_force(rolling));
}

AckermannAngles ackermann(double steering_angle, double wheelbase, double track) {
    if (steering_angle == 0)
        return {0, 0};
    const double radius = wheelbase / std::tan(steering_angle);  // of the rear axle's middle
    return {std::atan(wheelbase / (radius - track / 2)),
            std::atan(wheelbase / (radius + track / 2))};
}

double brush_share(double slip, double cornering_stiffness, double grip) {
    return share_at(cornering_stiffness * std::abs(slip) / (3 * grip));
}

double held_share(double side_slip, double cornering_stiffness, double grip) {
    const double along = longitudinal_stiffness * held_slip / (3 * grip);
    const double across = cornering_stiffness * side_slip / (3 * grip);
    const double both = std::sqrt(along * along + across * across);
    return share_at(both) * along / both;
}

}  // namespace reprise::world
