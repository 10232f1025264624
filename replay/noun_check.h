#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "replay/mcap/mcap.h"

/// Whether bytes of unknown origin are what they claim to be. FlatBuffers' verifier looks at
/// offsets and lengths; ids, order, enumerators and presence are ours to check: afterwards everyone
/// may follow pointers and use indices without looking. Each answers what is wrong, or nothing.
/// Bytes must lie 8-aligned.
namespace reprise::replay {

std::optional<std::string> fault_of_tick(mcap::View bytes, std::uint64_t index);
std::optional<std::string> fault_of_command(mcap::View bytes);
std::optional<std::string> fault_of_inputs(mcap::View bytes, std::uint64_t index);
std::optional<std::string> fault_of_traffic(mcap::View bytes, std::uint64_t index);
std::optional<std::string> fault_of_episode(mcap::View bytes);
std::optional<std::string> fault_of_town(mcap::View bytes);

}  // namespace reprise::replay
