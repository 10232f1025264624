#pragma once

#include <cstdint>

#include "world/models/catalogue.h"

namespace reprise::world {

/// What a walker carries. Any number of them, as long as hands suffice.
struct Carried {
    bool phone = false;  ///< looks at it, and is slower for it
    bool shopping_bags = false;
    bool guitar_case = false;
    bool suitcase = false;
    bool rolling_bag = false;
    bool umbrella = false;  ///< open when it rains in the tick
    bool backpack = false;
};

/// By the model and the bits of the look alone.
Carried carried_by(const WalkerModel& model, std::uint32_t look);

}  // namespace reprise::world
