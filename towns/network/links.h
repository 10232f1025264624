#pragma once

#include "world/town_generated.h"

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Fills the lanes' links and town.signals, sorted by (program, index), out of the network's
/// <connection> elements. Lanes must be there.
void read_links(const pugi::xml_node& net, world::TownT& town);

}  // namespace reprise::towns
