#pragma once

#include <vector>

#include "ground/mesh/polygons.h"
#include "ground/mesh/surface_height.h"

namespace reprise::ground {

/// Less than this of sidewalk, joined to nothing else, is no place to walk. [m2]
inline constexpr double least_island = 4.0;

/// As above for the island in the middle of a crossing: a place for one person to wait. [m2]
inline constexpr double least_refuge = 1.0;

/// Islands that are narrower, in the mean, hold nobody. [m]
inline constexpr double least_island_width = 0.6;

/// Unless they are larger than this: narrow as they are, somebody drew a sidewalk. [m2]
inline constexpr double most_strip = 10.0;

/// Patches closer than this in plan are joined. [m]
inline constexpr double joined_within = 0.05;

/// A connected piece of a sidewalk's top. Looks into its slab.
struct Patch {
    const Area* area = nullptr;
    const SurfaceHeight* height = nullptr;  ///< of the road beside it
    std::vector<world::Loop> borders;       ///< of the area: the outer one first, then holes
    world::Box box;
    bool at_crossing = false;
};

/// In plan; 0 where they overlap. [m]
double distance_between(const world::Loop& one, const world::Loop& other);

/// Is all of an island too small or too narrow to be one?
bool is_splinter(const Area& island, bool at_crossing);

/// Which patches are left over, as between the paths of cars: those that are, with all that they
/// are joined to, a splinter. One for each patch; areas of one origin.
std::vector<bool> find_splinters(const std::vector<Patch>& patches);

}  // namespace reprise::ground
