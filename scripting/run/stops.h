#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scripting/run/places.h"
#include "world/lanes/planner.h"
#include "world/town.h"

namespace reprise::scripting {

/// Searches that choose_lanes makes at most; 0: there is nothing to choose.
std::size_t searches_for(std::span<const StopLanes> stops);

/// A lane of each stop, so that the way through all of them costs least by the planner's measure,
/// from `here` to the end of the last one; equal ways take the lower index. Where no way leads
/// through all of them, the first of each.
std::vector<std::uint32_t> choose_lanes(const world::TownT& town,
                                        const world::Planner& planner,
                                        std::optional<world::LanePlace> here,
                                        std::span<const StopLanes> stops);

}  // namespace reprise::scripting
