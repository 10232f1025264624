#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "replay/outcomes.h"
#include "replay/trace_reader.h"
#include "world/story/crashes.h"

namespace reprise::cli {

/// What the events of a trace tell, in short.
struct TraceStory {
    /// Events of one kind.
    struct Kind {
        std::string name;  ///< such as printed
        std::uint64_t count = 0;
        std::uint64_t first = 0;  ///< tick
        std::uint64_t last = 0;
        std::string first_text;  ///< "ego since 12.30 s, ..."; a printed line
        std::string last_text;
    };

    struct Check {
        std::string status;  ///< passed, failed, not evaluated
        std::string text;    ///< its name, and why
        std::uint64_t tick = 0;
        std::string worst{};  ///< how bad a failed one became, and when
    };

    struct Actor {
        std::uint32_t id = 0;
        std::string name;
    };

    /// Those of the same two, in the order of their first one.
    struct Crashes {
        std::uint64_t count = 0;
        world::Crash worst;
        std::uint64_t first = 0;  ///< tick
        std::uint64_t last = 0;   ///< tick of the begin of the last one
    };

    bool whole = false;       ///< false: only the first and the last chunk were read
    std::vector<Kind> kinds;  ///< in the order of their first event; no checks, spawns, crashes
    std::vector<Crashes> crashes;
    std::vector<Check> checks;
    std::vector<Actor> actors;  ///< of the scenario
    std::uint64_t cars = 0;     ///< of the demand, in the last tick
    std::uint64_t walkers = 0;
    replay::ToldOutcome told;  ///< of the ticks that were read
};

/// Reads all ticks, about 15 us each; or, when not `all`, the first and the last 64 only.
TraceStory read_story(replay::TraceReader& trace, bool all);

/// Bytes of a channel's messages in all ticks before compression, from 16 ticks spread over them.
struct ChannelBytes {
    std::uint64_t tick = 0;
    std::uint64_t traffic = 0;
};

ChannelBytes sample_channels(replay::TraceReader& trace);

}  // namespace reprise::cli
