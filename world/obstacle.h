#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace reprise::world {

/// Something that stands beside the road and stops a car. World frame; metres and radians.
struct Obstacle {
    enum class Shape : std::uint8_t { box, cylinder, prism };

    Eigen::Vector3d position;  ///< middle of the foot, on the ground
    double yaw = 0;
    Eigen::Vector3d half;  ///< half sizes; a cylinder's are (radius, radius, half height)
    double radius = 0;     ///< of the bounding circle
    Shape shape = Shape::box;
    std::vector<Eigen::Vector3d> corners = {};  ///< a prism's foot, seen from its middle: convex
    double depth = 0;      ///< of its lower end below the ground: a building's foundation
    double breaks_at = 0;  ///< [N s] of a hit that breaks it off; 0: it stands whatever hits it
    std::uint32_t town_prop = 0;  ///< of what may break off: its index in Town.props
};

}  // namespace reprise::world
