#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace reprise::ground {

/// What a piece of ground is made of. Values are recorded (WheelState.surface).
enum class Surface : std::uint8_t {
    terrain,   ///< grass and earth beside the road, 5 cm below it
    road,      ///< lane ribbons and junction areas
    crossing,  ///< zebra crossings: road surface with stripes, no height of its own
    sidewalk,  ///< 15 cm above the road
    kerb,      ///< the vertical faces between road and sidewalk
    marking,   ///< painted lines, 5 mm above the road: for eyes only, not for wheels
    deck       ///< sides and undersides of bridges
};

/// Triangles, counter-clockwise seen from above. World frame, metres.
struct GroundMesh {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<Surface> surfaces;  ///< one for each triangle
};

/// Height of a sidewalk above its road. [m]
inline constexpr double kerb_height = 0.15;

/// Half of what a car needs: 1.9 m of car and 0.3 m of air on both sides. Road is at least this
/// wide on both sides of every path, and no sidewalk comes nearer. [m]
inline constexpr double car_clearance = 1.25;

}  // namespace reprise::ground
