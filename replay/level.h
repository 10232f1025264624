#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "replay/recorded_tick.h"
#include "world/tick.h"

namespace reprise::replay {

/// "full", "keyed", "core", "inputs".
const char* to_word(Level level);
std::optional<Level> level_named(std::string_view word);

/// Whether a trace of this level has the traffic of this tick: keyed ones at 1, 21, 41, ...: where
/// `render --every 1s` looks.
bool holds_traffic(Level level, std::uint64_t tick);

/// In how many of the first `ticks` ticks there is traffic.
std::uint64_t traffic_ticks(Level level, std::uint64_t ticks);

/// "T.mcap holds inputs only; `reprise expand ...` makes the rest again".
std::string lacks_text(const std::string& trace, Level level);

/// Whether this tick holds only what level `inputs` keeps: all other levels record a weather.
bool is_inputs_only(const world::Tick& tick);

/// A tick with the fields index, digests and these controls alone: one that any reader decodes.
flatbuffers::DetachedBuffer inputs_of(const world::Tick& tick,
                                      const std::vector<world::Control>& controls);

/// Reduces each tick to what a level keeps. Ticks must come in order from 1 on: the spawn commands
/// say which actors have driver `manual`, whose controls are inputs.
class Reduction {
  public:
    explicit Reduction(Level level) : level_(level) {}

    /// Borrowed from the argument and from this until the next call. The argument must hold as
    /// much.
    RecordedTick of(const RecordedTick& tick);

  private:
    void note_drivers(const world::Tick& tick);

    Level level_;
    std::set<std::uint32_t> by_hand_;  ///< actors with driver manual
    flatbuffers::DetachedBuffer inputs_;
};

}  // namespace reprise::replay
