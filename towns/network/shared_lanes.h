#pragma once

#include <cstddef>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Edges whose two directions share one and the same ground name each other as `bidi`. SUMO 1.15
/// knows that of edges with a single lane only, and aborts on others as soon as a car comes there
/// (an assertion of MSLane::getBidiLane); newer versions of netconvert write it for every road.
/// Takes the attribute out where SUMO 1.15 cannot follow. Returns from how many roads, both
/// directions counted as one, inner edges of junctions left out.
std::size_t part_shared_lanes(pugi::xml_node net);

}  // namespace reprise::towns
