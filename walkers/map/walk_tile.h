#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace reprise::walkers {

/// Areas of the navigation mesh; where surfaces meet at one height the highest number wins, so that
/// sidewalks do.
enum WalkArea : unsigned char { walk_road = 1, walk_crossing = 2, walk_sidewalk = 3 };

inline constexpr double walker_radius = 0.3;  ///< [m]
inline constexpr double walker_height = 1.8;  ///< [m]
inline constexpr double walker_climb = 0.3;   ///< [m] more than a kerb

/// How finely a map is made, and what counts as walkable.
struct TileRules {
    float cell = 0.3F;  ///< [m] of Recast's cells; 0.15 m gave the same ways
    int radius = 1;     ///< [cells] taken off along every edge
    float simplification =
        1;  ///< [cells] by which an outline may be off; below 1 oblique ones keep every step
    bool roads = true;    ///< else only sidewalks and crossings
    bool heights = true;  ///< inside of polygons as well

    int margin() const { return radius + 4; }  ///< [cells] around a tile: room for erosion
};

/// An upright convex prism.
struct TileShape {
    std::vector<float> corners;  ///< x, y, z
    float low = 0;
    float high = 0;
};

/// The triangles in and around a tile, in Recast's coordinates.
struct TileTriangles {
    std::vector<float> vertices;  ///< x, y, z
    std::vector<int> corners;     ///< three for each triangle
    std::vector<unsigned char> areas;
    std::vector<TileShape> holes;      ///< where something stands
    std::vector<TileShape> crossings;  ///< what is crossing, whatever its triangles say

    int count() const { return static_cast<int>(areas.size()); }
};

/// Where a tile is.
struct TilePlace {
    int column = 0;
    int row = 0;
    int cells = 0;               ///< along its sides, without the margin
    std::array<float, 3> low{};  ///< the margin included
    std::array<float, 3> high{};
};

/// One square of the map, ready for Detour. Empty `bytes`: nobody can walk there.
struct WalkTile {
    std::vector<unsigned char> bytes;
    std::size_t polygons = 0;
};

WalkTile make_walk_tile(const TileTriangles& triangles,
                        const TilePlace& place,
                        const TileRules& rules);

}  // namespace reprise::walkers
