#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "world/tick.h"

namespace reprise::render {

/// How an actor moves at a tick. World frame.
struct Twist {
    Eigen::Vector3d origin{0, 0, 0};    ///< the actor's
    Eigen::Vector3d velocity{0, 0, 0};  ///< [m/s] of the origin
    Eigen::Vector3d turning{0, 0, 0};   ///< [rad/s]

    Eigen::Vector3d velocity_at(const Eigen::Vector3d& p_world) const {
        return velocity + turning.cross(p_world - origin);
    }

    /// Where what is with the actor now was a moment ago, had the actor moved evenly: with 3 m/s^2
    /// and 50 ms it is 4 mm off. [s]
    Eigen::Isometry3d back(double ago) const;
};

/// Of a vehicle, car, walker or prop; nothing when it is not in the tick.
std::optional<Twist> find_twist(const world::TickView& tick, std::uint32_t actor);

}  // namespace reprise::render
