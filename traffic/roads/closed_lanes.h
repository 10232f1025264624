#pragma once

#include "world/town.h"

namespace reprise::traffic {

/// SUMO's cars stay out of lanes that are not for cars, such as those of buses and bicycles: these
/// are on nobody's map of the traffic. No route leads over them, nobody looks there for who stands
/// in the way, nor slows down for their bends; who walks does not look for cars there. SUMO itself
/// lets buses and taxis change onto a bus lane.
/// SUMO must run.
void close_other_lanes(const world::TownT& town);

}  // namespace reprise::traffic
