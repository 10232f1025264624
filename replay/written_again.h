// Private to the room.
#pragma once

#include <optional>
#include <string>

#include "replay/opened_trace.h"

namespace reprise::replay {

/// Writes the trace again, without a file, from what was read of it, and compares every byte but
/// those within its chunks. Nothing when all are equal, else "... (byte 123, in ...)". The town
/// must have been read; `last_chain` is the last tick's. Whatever packs a chunk or the town so that
/// it unpacks to the same is as good: another libzstd packs otherwise.
std::optional<std::string> difference_from_written(const OpenedTrace& trace,
                                                   const world::Digest128& last_chain);

}  // namespace reprise::replay
