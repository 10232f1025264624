#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "replay/trace_reader.h"

namespace reprise::cli {

/// A tick's own bytes: a trace is read on while they are looked at.
struct KeptTick {
    explicit KeptTick(const replay::RecordedTick& tick)
        : tick_bytes(tick.tick_bytes.begin(), tick.tick_bytes.end()),
          traffic_bytes(tick.traffic_bytes.begin(), tick.traffic_bytes.end()) {}

    world::TickView view() const {
        return {world::GetTick(tick_bytes.data()), world::GetTraffic(traffic_bytes.data())};
    }

    std::vector<std::uint8_t> tick_bytes;
    std::vector<std::uint8_t> traffic_bytes;
};

/// A tick and, where they are asked for and there, those beside it.
struct KeptTicks {
    KeptTicks(replay::TraceReader& trace, std::uint64_t index, bool with_neighbours);

    KeptTick tick;
    std::optional<KeptTick> last;
    std::optional<KeptTick> next;
};

}  // namespace reprise::cli
