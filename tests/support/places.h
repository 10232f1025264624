#pragma once

#include <string>
#include <vector>

#include "world/town.h"

/// Places with junctions and bridges, built in code.
namespace reprise::test {

/// A lane of 3.5 m (driving, internal) or 2.5 m (sidewalk) through these points; no links.
world::LaneT lane(const std::string& name, world::LaneKind kind, std::vector<world::Vec3> centre);

/// Three arms of one lane each way meet around (50, -4): west, east and south, with sidewalks, a
/// crossing over the southern arm (x 46.5 to 53.5, y -14 to -11), and walking areas of which the
/// south-western one lies in the way of cars that turn right. z = slope * x.
world::TownT t_junction(double slope = 0);

/// A road that comes from the north and bends to the east: junction 101 of
/// tests/towns/village.osm as netconvert makes it, with sidewalks along the northern arm only,
/// and one walking area that lies across the carriageway.
world::TownT bend();

/// A road along the x axis at z = 0, and one along the y axis that crosses it at z = 6.
world::TownT bridge();

}  // namespace reprise::test
