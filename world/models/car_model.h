#pragma once

#include <Eigen/Core>

#include "world/models/catalogue.h"
#include "world/models/powertrain.h"

namespace reprise::world {

/// A two-wheeler is a narrow car here: four wheels on a track of 0.4 m, and a centre of mass so low
/// that it slides before it tips. It neither leans (pictures show the lean that its speed and yaw
/// rate ask for) nor falls over, unless something hits it: see unbalanced_model().
///
/// Constants of one model, derived from the catalogue. SI; body frame: x ahead, y left, z up,
/// origin in the centre of mass.
struct CarModel {
    const VehicleModel* catalogue;
    double track;        ///< between the wheel centres of an axle [m]
    double com_ahead;    ///< of the rear axle [m]
    double com_height;   ///< above the ground at rest [m]
    double front_share;  ///< of the weight, on the front axle
    bool front_driven;
    double grip;                 ///< tyre on dry asphalt: largest force / load
    double brake_deceleration;   ///< [m/s^2] of the brakes at full pedal
    double rolling_resistance;   ///< force / load
    double spring_frequency;     ///< [rad/s] natural frequency of the body on its springs
    Eigen::Vector3d inertia;     ///< [kg m^2] about x, y, z
    Eigen::Vector3d box_half;    ///< of the collision box [m]
    Eigen::Vector3d box_centre;  ///< in the body frame
    Powertrain powertrain;
};

CarModel car_model(const VehicleModel& model);

/// The same when nobody keeps its balance. A two-wheeler's wheels are in one line then, and its
/// centre of mass is as high as with its rider: it falls over. A car is what it is.
CarModel unbalanced_model(const VehicleModel& model);

inline constexpr double gravity = 9.81;       ///< [m/s^2]
inline constexpr double air_density = 1.225;  ///< [kg/m^3] ICAO standard atmosphere, sea level
inline constexpr double steering_rate = 0.7;  ///< [rad/s] of the front wheels

// Cornering stiffness of the tyres per load [1/rad]: Gillespie gives 0.12 to 0.2 per degree for
// passenger cars. The softer front axle makes every model understeer: here 1.6 degrees for each g.
inline constexpr double front_cornering = 9.0;
inline constexpr double rear_cornering = 12.0;

/// Along the wheel tyres are stiffer: 15 to 25 (Pacejka, 3rd ed., ch. 1 and 4).
inline constexpr double longitudinal_stiffness = 20.0;  ///< force / load for a unit of slip
/// Slip that ABS and traction control let no wheel exceed: where the largest force is, and much of
/// the lateral force is left (Bosch, "Automotive Handbook", ABS: 0.08 to 0.3).
inline constexpr double held_slip = 0.12;
/// Of the largest force, when a wheel is locked (J. Y. Wong, "Theory of Ground Vehicles", ch. 1,
/// mean of peak and sliding values: asphalt 0.88, wet 0.87, packed snow 0.75).
inline constexpr double sliding_share = 0.85;

inline constexpr double reverse_speed = 8.0;  ///< [m/s] fastest speed backwards

/// What the pedal asks of the engine: force at the wheels along x, a share of what the best gear
/// gives at this speed. [N]; throttle in [0, 1], speed along x. The gear that is in may give less
/// (world/models/driveline.h). Zero while the car still rolls faster than 2 m/s against the
/// chosen direction.
double drive_force(const CarModel& car, double throttle, bool reverse, double speed);

/// Angles of the left and the right front wheel that turn the car about one centre. [rad]
struct AckermannAngles {
    double left;
    double right;
};

AckermannAngles ackermann(double steering_angle, double wheelbase, double track);

/// Share of the friction limit that a tyre's lateral force reaches, in [0, 1].
/// Brush model with parabolic pressure (Pacejka, "Tire and Vehicle Dynamics", 3rd ed., 3.2;
/// Mitschke/Wallentowitz, part I): 3z - 3z^2 + z^3, z = stiffness * |slip| / (3 * grip), full
/// sliding from z = 1. `slip` is the tangent of the slip angle, `cornering_stiffness` the
/// force per radian and load, `grip` the largest force per load.
double brush_share(double slip, double cornering_stiffness, double grip);

/// Share of the friction limit that such a tyre gives along the wheel when it slips both ways: by
/// `held_slip` along it, and by the tangent `side_slip` of its slip angle. In [0, 1]. The force of
/// a brush points against the slip (Pacejka, 3.2.3).
double held_share(double side_slip, double cornering_stiffness, double grip);

}  // namespace reprise::world
