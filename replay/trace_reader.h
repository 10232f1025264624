#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "replay/recorded_tick.h"
#include "world/recording.h"
#include "world/tick.h"

namespace reprise::replay {

struct OpenedTrace;

/// Reads traces: the index first, ticks on demand, one chunk in memory. Every CRC is checked, every
/// length is distrusted. A trace that is not one, or is cut off, or damaged throws world::Error
/// with path and byte offset.
class TraceReader {
  public:
    explicit TraceReader(const std::filesystem::path& path);

    /// Opens whatever still has its start: all ticks up to the first that is not sound, whether the
    /// end is missing (a crash left PATH.partial behind) or the index or a chunk is damaged. `loss`
    /// says what was left out, "" for nothing but the index. Without its outcome the verdict is
    /// "error".
    static TraceReader salvage(const std::filesystem::path& path);
    const std::string& loss() const;

    ~TraceReader();
    TraceReader(TraceReader&&) noexcept;
    TraceReader& operator=(TraceReader&&) noexcept;

    const std::filesystem::path& path() const;

    /// Number of ticks; their indices are first() to last(). Only a slice of a run has a first one
    /// other than 1: see replay/slice.h.
    std::uint64_t ticks() const;
    std::uint64_t first() const;
    std::uint64_t last() const;

    /// How many ticks the run had: more than ticks() for a slice.
    std::uint64_t run_ticks() const;

    /// What the trace says of being a part of a run; nothing when it is the whole run.
    std::optional<world::SliceStart> slice() const;

    /// full when the trace does not say.
    Level level() const;

    /// The whole tick with this index, in [first(), last()]. The view lives until the next call on
    /// this reader. In order: about 20 us a tick with 100 cars; any other: one chunk is
    /// decompressed, about 1 ms. Throws world::Error, one line that says how to get it, when the
    /// trace's level leaves a part of it out.
    RecordedTick tick(std::uint64_t index);

    /// As much of it as the trace's level keeps.
    RecordedTick recorded(std::uint64_t index);

    /// Chain digest at a tick, as recorded; at 0: before the run's first one; of a slice also at
    /// first() - 1.
    world::Digest128 chain(std::uint64_t index);

    const world::EpisodeT& episode() const;
    const world::Outcome& outcome() const;

    /// Town, network and all: read on first use.
    const world::Recording& recording();

    /// Bytes of the file, and bytes of all messages before compression.
    std::uint64_t file_size() const;
    std::uint64_t message_bytes() const;

    /// Bytes of the file that its ticks take: what grows with the run, unlike town and index.
    std::uint64_t packed_bytes() const;

    /// Damage found in the chunk that holds this tick (CRC, decompression), or nothing. With
    /// damage, `tick` throws; `salvaged` gives the tick's bytes as far as they can be had: they are
    /// sound FlatBuffers of that tick, but their values may be wrong.
    std::optional<std::string> damage(std::uint64_t index);
    std::optional<RecordedTick> salvaged(std::uint64_t index);

    /// Any byte of the file that is not what a run would have written there, outside of the
    /// chunks: of those `damage(tick)` tells. The rest follows from the episode, the town, the
    /// chunks' places and the outcome; whether these are true only simulating them again can tell.
    /// Reads the file once, about 1 GB/s. Throws where the town is damaged.
    std::optional<std::string> damage();

    /// The chunk that holds this tick, unread by anyone: nothing about it was checked.
    PackedTicks packed(std::uint64_t index);

  private:
    explicit TraceReader(std::unique_ptr<OpenedTrace> file);
    std::unique_ptr<OpenedTrace> file_;
};

}  // namespace reprise::replay
