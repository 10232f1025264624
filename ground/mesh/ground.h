#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "world/town_generated.h"

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

/// The ground that wheels and walkers stand on, and that cameras see: the same triangles for both.
/// Sidewalk slabs are cut clear of everything that cars drive over; every level of a town with
/// bridges keeps its own height. A pure function of the town: same bytes every time.
/// Town 1: about 40 ms and 7,400 triangles.
GroundMesh build_ground(const world::TownT& town);

/// Painted lines of the town (Surface::marking). Derived, because road networks do not hold them:
/// dashes between lanes of one direction; between directions a centre line, dashed in towns and
/// solid near junctions, in bends and on fast or wide roads; edge lines where there is no kerb;
/// stop lines at signals and stop signs, shark's teeth where one must give way; arrows where lanes
/// lead to different turns; zebra stripes.
GroundMesh build_markings(const world::TownT& town);

}  // namespace reprise::ground
