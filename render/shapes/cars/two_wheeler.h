#pragma once

#include <Eigen/Geometry>

#include "render/shapes/cars/car_shape.h"
#include "world/tick.h"

namespace reprise::render {

/// Where a rider holds on. Frame of the vehicle, left side; the right side mirrors y. [m]
struct Seat {
    Eigen::Vector3d saddle;  ///< middle
    Eigen::Vector3d grip;    ///< left hand, wheel straight ahead
    Eigen::Vector3d foot;    ///< left foot on its peg; a bicycle's: middle of the cranks
    double crank;            ///< [m] length; 0: pegs that do not turn
    double lean;             ///< [rad] of the rider's trunk
};

Seat seat_of(const CarShape& shape);

/// Frame, engine, saddle: all that does not turn with the handlebar. In the vehicle's frame.
Mesh two_wheeler_mesh(const CarShape& shape);

/// Fork, handlebar and head lamp, around the vertical through the front axle. Frame: x ahead,
/// origin on the ground below the front axle.
Mesh fork_mesh(const CarShape& shape);

/// A wheel with wire spokes or cast ones around its y axis.
Mesh thin_wheel_mesh(const CarShape& shape);

/// A bicycle's crank with its pedal, from the origin down by the crank's length.
Mesh crank_mesh(const CarShape& shape);

/// How far a two-wheeler leans into a bend, towards its left positive, for speed [m/s] and yaw rate
/// [rad/s]: so that weight and centrifugal force meet in the tyres' line. [rad]
double lean_angle(double speed, double yaw_rate);

/// Where a two-wheeler with mass is seen. Its four-wheeled body stays upright in a bend and rolls
/// outwards on its springs; it is seen leaning as much as the bend asks for, or as it lies.
Eigen::Isometry3d leaning_pose(const world::VehicleState& vehicle);

}  // namespace reprise::render
