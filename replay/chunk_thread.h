#pragma once

#include <memory>

#include "replay/trace_file.h"

namespace reprise::replay {

/// Compresses and writes chunks on a thread of its own, in the order they come: the bytes do not
/// depend on timing. At most four chunks are under way: `exchange` blocks until fewer are.
class ChunkThread {
  public:
    /// From now until `finish` returns, the file belongs to the thread.
    explicit ChunkThread(TraceFile& file);
    ~ChunkThread();
    ChunkThread(const ChunkThread&) = delete;
    ChunkThread& operator=(const ChunkThread&) = delete;

    /// Takes a full chunk, gives an empty one in its place. Throws what went wrong on the thread.
    void exchange(std::unique_ptr<PendingChunk>& chunk);

    /// Throws what went wrong on the thread since, if anything. A flag's read.
    void check() const;

    /// Waits until all is written and gives the file back. Throws what went wrong on the thread.
    void finish();

  private:
    struct Shared;
    std::unique_ptr<Shared> shared_;
};

}  // namespace reprise::replay
