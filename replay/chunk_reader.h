#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/mcap/compression.h"
#include "replay/mcap/files.h"
#include "replay/mcap/mcap.h"
#include "replay/recorded_tick.h"

namespace reprise::replay {

/// The ticks that a chunk says it holds.
struct TickRange {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
};

/// One chunk in memory, unpacked and checked, damaged or not. Sound is a chunk with the messages of
/// its ticks in their order, their indexes behind it, and nothing else.
class ChunkReader {
  public:
    /// The bytes of one tick's messages; empty where damage took them, or there are none.
    struct Messages {
        mcap::View tick;
        mcap::View traffic;

        /// All that a trace of this level has of this tick.
        bool complete(Level level, std::uint64_t index) const;
    };

    /// Reads the chunk's record; `step_ns` turns log times into ticks.
    void load(const InputFile& file,
              const mcap::Chunk& chunk,
              const TickRange& ticks,
              std::uint64_t step_ns,
              Level level);

    /// What is wrong with it, or nothing.
    const std::optional<std::string>& damage() const { return damage_; }

    Messages messages(std::uint64_t tick) const { return messages_[tick - ticks_.first]; }

  private:
    void unpack(const mcap::Chunk& chunk, std::uint32_t crc);
    void find_messages(mcap::View records, std::uint64_t step_ns, Level level);
    bool message_indexes_agree(const InputFile& file, const mcap::Chunk& chunk);

    Decompressor decompressor_;
    TickRange ticks_;
    mcap::Bytes record_;   ///< header and packed bytes
    mcap::View packed_;    ///< in record_
    mcap::Bytes records_;  ///< unpacked
    std::size_t usable_ = 0;
    std::vector<Messages> messages_;  ///< in records_
    mcap::MessageEntries tick_entries_;
    mcap::MessageEntries traffic_entries_;
    std::optional<std::string> damage_;
};

}  // namespace reprise::replay
