#pragma once

#include <cstdint>
#include <span>

#include "world/tick.h"

namespace reprise::replay {

/// How much of its ticks a trace holds. The kernel is deterministic: the rest can be made again.
enum class Level : std::uint8_t {
    inputs,  ///< index, digests and what was driven by hand: what re-simulation needs and checks
    core,    ///< /sim/tick
    keyed,   ///< and /sim/traffic in every 20th tick
    full
};

/// One recorded tick's bytes, verified as FlatBuffers. Borrowed from the reader. What the trace's
/// level leaves out: `view.traffic` is null and `traffic_bytes` empty; of `inputs`, fields of
/// `view.tick` are null.
struct RecordedTick {
    world::TickView view;
    std::span<const std::uint8_t> tick_bytes;
    std::span<const std::uint8_t> traffic_bytes;
};

/// Some ticks as they lie in the file. Equal bytes are equal ticks, without unpacking them.
struct PackedTicks {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::span<const std::uint8_t> bytes;  ///< borrowed from the reader
};

}  // namespace reprise::replay
