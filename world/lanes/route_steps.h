#pragma once

#include <cstdint>
#include <vector>

#include "world/lanes/route.h"
#include "world/town.h"

namespace reprise::world {

/// The link that leads from a lane's end onto `next`, an internal lane or one behind a junction;
/// null: they lie beside each other, or apart.
const Link* link_between(const TownT& town, std::uint32_t lane, std::uint32_t next);

/// The commands of a route whose pieces and length are known; see make_route.
std::vector<Route::Step> find_steps(const TownT& town, const Route& route);

}  // namespace reprise::world
