#pragma once

#include <cstddef>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Who joins a road of several lanes, as from a ramp, lets those pass who are on the lane that he
/// joins. netconvert makes him wait for a gap in all of them (its --check-lane-foes.all is off),
/// which beside a busy motorway takes minutes. Two ways onto different lanes of one road that keep
/// a body's width apart, bends swept by a bus included, have nothing to do with each other from
/// here on: their bits in `response` and `foes` are taken out. Tight turns keep them, and so do
/// ways that cross. Returns the number of pairs of ways; what is sound keeps every byte.
std::size_t part_joined_lanes(pugi::xml_node net);

}  // namespace reprise::towns
