#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "replay/mcap/mcap.h"

namespace reprise::replay {

/// What a trace holds besides its ticks, by these names: scenario (Lua), episode and town (JSON),
/// network (XML), metadata (JSON), tick.bfbs and traffic.bfbs (the schemas that its ticks were
/// written with, as FlatBuffers' own binary schemas).
std::vector<std::string> part_names();

/// The bytes of a part, checked and unpacked. Throws world::Error when there is no such part.
mcap::Bytes read_part(const std::filesystem::path& trace, const std::string& name);

}  // namespace reprise::replay
