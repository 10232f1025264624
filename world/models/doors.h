#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "world/models/catalogue.h"

namespace reprise::world {

inline constexpr std::uint8_t door_count = 4;  ///< front left, front right, rear left, rear right
inline constexpr double widest_door =
    1.15;                                 ///< [rad] as far as its check strap lets it: 66 degrees
inline constexpr double door_rate = 1.3;  ///< [rad/s]: a person's push

/// Has the model such a door? Two-wheelers and buses have none, lorries, vans, pickups and coupes
/// none behind.
bool has_door(const VehicleModel& model, std::uint8_t door);

/// An open door's leaf: a box. [m]
struct DoorLeaf {
    Eigen::Isometry3d pose;  ///< of its middle, x from the hinge to its edge
    Eigen::Vector3d half;
};

/// In the frame of the vehicle's pose; hinged at its front edge, opened by `angle`.
DoorLeaf door_leaf(const VehicleModel& model,
                   const Eigen::Isometry3d& pose_vehicle,
                   std::uint8_t door,
                   double angle);

}  // namespace reprise::world
