#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "towns/bridges/road_chains.h"
#include "towns/maps/map_shapes.h"

namespace reprise::towns {

/// Which points of a road network lie over or under others, as the ways of its map say.
struct Levels {
    std::map<std::uint32_t, int> levels;  ///< point: 0 is the ground; those beneath a bridge and on
                                          ///< it; others may have any height
    /// Points around each place where roads cross on one level without a junction, as maps have it
    /// by mistake: all at one height, so that one can drive there.
    std::vector<std::vector<std::uint32_t>> crossed;
    /// Points of roads that touch each other on one level: at nearly one height.
    std::vector<std::vector<std::uint32_t>> touching;
    /// The points of each bridge and tunnel that is raised or lowered; none of those that are not.
    /// The same map has them in the same order.
    std::vector<std::vector<std::uint32_t>> spans;
    int crossings = 0;  ///< places where one road passes over another
};

/// `ways` have a layer. It says only who is above: where layer 3 crosses nothing but the ground it
/// becomes level 1, and a bridge over nothing that is in the network has no level at all. A bridge
/// or tunnel that crosses something has its level on all of its length. Those in `flat`, by their
/// index in Levels::spans, are taken for roads that cross on one level without a junction.
Levels find_levels(const RoadChains& roads,
                   const std::vector<MapShape>& ways,
                   const std::set<std::uint32_t>& flat);

}  // namespace reprise::towns
