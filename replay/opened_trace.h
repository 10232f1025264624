// Private to the room.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "replay/chunk_reader.h"
#include "replay/mcap/aligned_copy.h"
#include "replay/mcap/files.h"
#include "replay/recorded_tick.h"
#include "replay/trace_facts.h"
#include "replay/trace_index.h"
#include "world/recording.h"

namespace reprise::replay {

/// What a TraceReader holds: the file, what was read of it when it was opened, and the chunk in
/// memory.
struct OpenedTrace {
    static constexpr std::uint64_t none_loaded = 0;

    InputFile input;
    TraceIndex index;
    std::vector<TickRange> ranges;  ///< of index.chunks, without gaps
    world::Recording recording;
    Level level = Level::full;
    bool has_town = false;  ///< recording.town and .network are read
    world::Outcome outcome;
    world::Digest128 first_chain;
    world::SliceStart slice;  ///< of a whole run: from tick 1 on, and no run_ticks
    std::string loss;         ///< what a salvage left out
    ChunkReader loaded_chunk;
    std::uint64_t loaded = none_loaded;  ///< first tick of the chunk in memory
    mcap::Bytes packed;                  ///< as handed out by packed()
    AlignedCopy tick_copy;
    AlignedCopy traffic_copy;

    OpenedTrace(const std::filesystem::path& path, bool salvage);

    TraceIndex find_index(bool salvage) const;

    std::uint64_t ticks() const { return last() + 1 - slice.first; }

    std::uint64_t last() const { return ranges.empty() ? slice.first - 1 : ranges.back().last; }

    std::uint64_t step_ns() const { return recording.episode.step_ns; }

    /// Who made it, and the episode.
    void read_start();

    void read_level(const std::string& word);

    void read_slice(const std::map<std::string, std::string>& facts);

    void check_end_of_slice() const;

    /// Throws when metadata of this name is not what follows from the rest.
    void compare_facts(const char* name, const Facts& written, const Facts& found) const;

    [[noreturn]] void fail_attachment(const std::string& name, const std::string& fault);

    /// Chunks hold ticks 1, 2, ... in order.
    void find_ranges();

    std::optional<TickRange> range_of(const mcap::Chunk& chunk) const;

    /// Keeps the chunks up to the first that is not sound.
    void drop_broken_end();

    /// How the run ended, when that was written and all its ticks are there.
    void salvage_outcome();

    std::string cut_off() const;

    void read_outcome();

    std::size_t chunk_of(std::uint64_t tick) const;

    void load(std::uint64_t tick);

    std::string describe_damage(std::uint64_t tick) const;

    /// The tick's bytes, or what is wrong with them. The chunk must be loaded.
    std::optional<std::string> take(std::uint64_t tick, RecordedTick& out);

    void read_town();
};

}  // namespace reprise::replay
