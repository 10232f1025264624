#pragma once

#include "world/town_generated.h"

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Fills town.junctions, sorted by name. `net` is the network's root element.
void read_junctions(const pugi::xml_node& net, world::TownT& town);

/// Fills town.lanes, sorted by name, without links: centre lines, outlines, kinds, neighbours.
/// Junctions must be there.
void read_lanes(const pugi::xml_node& net, world::TownT& town);

/// A lane's centre line moved to the left by `offset`. [m] Corners are mitred up to twice the
/// offset.
std::vector<world::Vec3> offset_line(const std::vector<world::Vec3>& centre, double offset);

}  // namespace reprise::towns
