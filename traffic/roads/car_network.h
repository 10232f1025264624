#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "world/town_generated.h"

namespace reprise::traffic {

/// What SUMO need know of a network: where cars drive. A street of one lane beside a pavement is
/// one of two lanes to SUMO, which then looks in each step whether somebody changes them: with 100
/// cars in Town 1 that, and what follows, was a tenth of a run's processor time. So it gets
/// - roads that cars drive on without their other lanes. Lanes keep their names; SUMO counts those
///   that are left, as RoadGraph does: RoadGraph::index_of. Where a road has no lanes for cars its
///   lanes stay, closed to all that SUMO drives here;
/// - no crossings and waiting areas, where it would look for cars: people walk without SUMO;
/// - junctions without the ways that led from or to what is gone; the other ones keep their rights;
/// - no word of where one may overtake through the oncoming lane (`neigh`): nobody does by SUMO's
///   rules (lcOpposite), but it looks.
/// Lanes that are not for cars, such as those of buses and bicycles, are on nobody's map of the
/// traffic: no route leads over them, nobody looks there for who stands in the way, who walks does
/// not look for cars there. SUMO itself would let buses and taxis change onto a bus lane.
///
/// `network`: a .net.xml that towns::check_network has passed, and `town` read out of it. What is
/// none, or has junctions whose rows do not fit their ways, is handed on as it is: SUMO says what
/// is wrong.
std::string network_for_cars(std::string_view network, const world::TownT& town);

/// [lane] Does SUMO, which runs with that network, have it? Of a junction only what leads from a
/// lane for cars to another one.
std::vector<bool> lanes_in_sumo(const world::TownT& town);

}  // namespace reprise::traffic
