#pragma once

#include <cstddef>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// At a junction of the type `zipper` cars of two lanes take turns. SUMO 1.15 knows how two do that
/// and ends the run ("Zipper junctions with more than two conflicting lanes are not supported") as
/// soon as a car comes to a link that has more foes. Such a junction becomes one of the type
/// `priority`, where who goes straight on goes first. Returns how many there were.
std::size_t mend_zippers(pugi::xml_node net);

}  // namespace reprise::towns
