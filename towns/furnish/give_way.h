#pragma once

#include <cstdint>
#include <vector>

#include "world/town_generated.h"

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// What a sign at the end of a driving lane would say, at junctions without lights. All lanes of a
/// road say the same.
enum class GiveWay : std::uint8_t {
    none,   ///< one way on goes first, or all give way to the right, or nobody is met
    yield,  ///< every way on from there on which a vehicle can be met gives way to one
    stop    ///< and all its links are stops; or all roads stop
};

/// One for each lane of the town. Links say whether one yields to anybody, walkers on a crossing
/// included, or stops; which of them yield to vehicles is in the network's <request> elements.
std::vector<GiveWay> read_give_way(const pugi::xml_node& net, const world::TownT& town);

}  // namespace reprise::towns
