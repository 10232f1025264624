// Private to the room.
#pragma once

#include <nlohmann/json.hpp>

#include "world/town_generated.h"

namespace reprise::exchange {

/// What a town looks like from above. Places are whole centimetres; a line is x, y of its first
/// point, then of each point the difference to the one before.
nlohmann::json page_town(const world::TownT& town);

}  // namespace reprise::exchange
