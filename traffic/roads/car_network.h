#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "world/town_generated.h"

namespace reprise::traffic {

/// What SUMO need know of a network: where cars drive. A street of one lane beside a pavement is
/// one of two lanes to SUMO, which then looks in each step whether somebody changes them: that
/// costs more than to follow who drives ahead. So it gets
/// - roads that cars drive on without their other lanes. Lanes keep their names; SUMO counts those
///   that are left, as RoadGraph does: RoadGraph::index_of.
/// - no word of where one may overtake through the oncoming lane (`neigh`): nobody does by SUMO's
///   rules (lcOpposite), but it looks.
/// Lanes that are not for cars, such as those of buses and bicycles, are on nobody's map of the
/// traffic: no route leads over them, nobody looks there for who stands in the way, who walks does
/// not look for cars there. SUMO itself would let buses and taxis change onto a bus lane. Where a
/// road has no others, they stay, closed to all that SUMO drives here; so do crossings and waiting
/// areas. What is no network is handed on as it is: SUMO says what is wrong.
std::string network_for_cars(std::string_view network, const world::TownT& town);

/// [lane] Does SUMO, which runs with that network, have it? Of a junction only what leads from a
/// lane for cars to another one.
std::vector<bool> lanes_in_sumo(const world::TownT& town);

}  // namespace reprise::traffic
