#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "world/tick_generated.h"

namespace reprise::kernel {

/// Who was put elsewhere in a tick, sorted: from there to here nobody has moved.
using Displaced = std::vector<std::uint32_t>;

inline Displaced displaced_by(std::span<const world::CommandT> commands) {
    Displaced actors;
    for (const world::CommandT& command : commands)
        if (command.kind == world::CommandKind::teleport)
            actors.push_back(command.actor);
    std::sort(actors.begin(), actors.end());
    return actors;
}

inline bool holds(const Displaced& displaced, std::uint32_t actor) {
    return std::binary_search(displaced.begin(), displaced.end(), actor);
}

}  // namespace reprise::kernel
