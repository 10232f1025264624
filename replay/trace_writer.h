#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "files/output_file.h"
#include "replay/trace_reader.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::replay {

/// What becomes of a file whose run or whose writing stopped early. A run's ticks are worth
/// keeping.
using files::Unfinished;

/// Writes a trace: an MCAP file with the channels /sim/tick and /sim/traffic, one chunk for 64
/// ticks, zstd level 1 on a thread of its own. Equal recordings and ticks give equal files.
///
/// It writes to PATH.partial and renames on close, so a file named PATH is always whole; what a
/// crash leaves behind is PATH.partial, readable up to its last whole chunk.
/// Errors (unwritable, disk full) throw world::Error; nothing that looks whole is left.
class TraceWriter {
  public:
    /// `level`: how much of each tick is kept. `slice`: the trace is of a part of a run, and this
    /// is where it begins; of level inputs only at tick 1.
    TraceWriter(const std::filesystem::path& path,
                const world::Recording& recording,
                Level level = Level::full,
                Unfinished unfinished = Unfinished::keep,
                const std::optional<world::SliceStart>& slice = std::nullopt);
    ~TraceWriter();
    TraceWriter(const TraceWriter&) = delete;
    TraceWriter& operator=(const TraceWriter&) = delete;

    /// Ticks in order, the first has index 1 or is the slice's, with as much in them as the level
    /// keeps. Costs the caller one copy, about 2 us.
    void append(const world::SealedTick& tick);
    void append(const RecordedTick& tick);

    /// Writes outcome, index and footer, and gives the file its name. A slice without the run's
    /// last tick cannot show how the run ended, and does not say it.
    void close(const world::Outcome& outcome);

  private:
    struct File;
    std::unique_ptr<File> file_;
};

}  // namespace reprise::replay
