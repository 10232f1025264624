#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace reprise::replay {

/// What of a trace's ticks is wanted.
struct Selection {
    /// Paths such as vehicles, vehicles.position, vehicles.position.x; none: everything. What tells
    /// the elements of a list apart (id; actor; vehicle and index) always comes along.
    std::vector<std::string> fields;

    /// Only what belongs to this actor.
    std::optional<std::uint32_t> actor;
};

/// The fields of both streams, first level: vehicles, cars, signals, digests, ...
std::vector<std::string> top_level_fields();

}  // namespace reprise::replay
