#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "world/town_generated.h"

namespace reprise::scripting {

/// Something that is wrong in a scenario, in this line of it.
struct Finding {
    std::uint32_t line = 0;
    std::string message;
};

/// Reads a scenario that the compiler takes, without running it: words, keys, models, weathers,
/// drivers, lanes and parameters that are not there, also where no run comes along. Lanes are
/// looked up in `town`, if any. What it cannot decide it lets pass. By line.
std::vector<Finding> lint(std::string_view source, const world::TownT* town);

}  // namespace reprise::scripting
