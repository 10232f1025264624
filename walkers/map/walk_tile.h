#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace reprise::towns {

/// Areas of the navigation mesh; where surfaces meet at one height the highest number wins, so that
/// sidewalks do.
enum WalkArea : unsigned char { walk_road = 1, walk_crossing = 2, walk_sidewalk = 3 };

inline constexpr double walker_radius = 0.3;  ///< [m]
inline constexpr double walker_height = 1.8;  ///< [m]
inline constexpr double walker_climb = 0.3;   ///< [m] more than a kerb

inline constexpr float tile_cell = 0.3F;  ///< [m] of Recast's cells; 0.15 m gave the same ways
inline constexpr int tile_margin = 5;  ///< [cells] around a tile: its radius, and room for erosion

/// The triangles in and around a tile, in Recast's coordinates.
struct TileTriangles {
    std::vector<float> vertices;  ///< x, y, z
    std::vector<int> corners;     ///< three for each triangle
    std::vector<unsigned char> areas;

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

WalkTile make_walk_tile(const TileTriangles& triangles, const TilePlace& place);

}  // namespace reprise::towns
