#pragma once

#include <filesystem>
#include <memory>

#include "replay/recording.h"
#include "replay/trace_reader.h"
#include "world/tick.h"

namespace reprise::replay {

/// Writes a trace: an MCAP file with the channels /sim/tick and /sim/traffic, one chunk for 64
/// ticks, zstd level 1 on a thread of its own. Equal recordings and ticks give equal files.
///
/// It writes to PATH.partial and renames on close, so a file named PATH is always whole; what a
/// crash leaves behind is PATH.partial, readable up to its last whole chunk.
/// Errors (unwritable, disk full) throw world::Error; nothing that looks whole is left.
class TraceWriter {
  public:
    TraceWriter(const std::filesystem::path& path, const Recording& recording);
    ~TraceWriter();
    TraceWriter(const TraceWriter&) = delete;
    TraceWriter& operator=(const TraceWriter&) = delete;

    /// Ticks in order, the first has index 1. Costs the caller one copy, about 2 us.
    void append(const world::SealedTick& tick);
    void append(const RecordedTick& tick);

    /// Writes outcome, index and footer, and gives the file its name.
    void close(const Outcome& outcome);

  private:
    struct File;
    std::unique_ptr<File> file_;
};

}  // namespace reprise::replay
