#pragma once

#include "towns/network/network.h"
#include "world/town_generated.h"

namespace reprise::towns {

/// Reads the Town out of a network: lanes with neighbours and links, junctions, signals, sidewalks,
/// crossings; what stands beside the roads is the place's, the rest drawn by a fixed rule
/// (scenery.h). Pure: equal bytes in, equal Town out. Throws world::Error when there is no lane
/// that a car may use. Town 1: 60 ms.
world::TownT read_town(const Network& network);

/// Only its streets: lanes and junctions as read_town() has them, without what leads where, and
/// with nothing beside them. A tenth of the time, or less.
world::TownT read_streets(const Network& network);

}  // namespace reprise::towns
