#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "replay/trace_reader.h"
#include "world/tick.h"

namespace reprise::replay {

/// The first difference between two runs.
struct Divergence {
    std::uint64_t tick = 0;
    std::string
        stage;  ///< scenario, controls, traffic, pedestrians, physics, measurements;
                ///< "start" when only what the runs started from differs, "end" when one
                ///< goes on or ends otherwise, "encoding" when equal values have other bytes
    std::string actor;     ///< "ego (1)", or ""
    std::string field;     ///< such as vehicles[id 1].velocity.x
    std::string expected;  ///< value in the first run: decimal and, for reals, the hex bits
    std::string found;     ///< value in the second run
    std::string note;      ///< how far apart; when the recorded fields agree and only the unrounded
                           ///< state differs; what the runs did not have in common at the start
    std::uint32_t actor_id = 0;  ///< 0: none
};

/// A few lines for a person.
std::string to_text(const Divergence& divergence, std::uint64_t step_ns);

/// Compares two ticks of the same index byte by byte, then explains the first difference, stages in
/// their order.
std::optional<Divergence> compare(const RecordedTick& expected, const RecordedTick& found);

/// Finds the first difference of two traces: the first tick whose digests or bytes differ, then the
/// lengths and how they ended. Chunks with equal bytes are passed over without unpacking: an hour
/// takes about 0.2 s. Of runs with different starts (another seed, say) the chain is left out of
/// the comparison, because it differs from the first tick on; the note says what was different.
/// "Equal" includes that neither file was damaged; otherwise this throws world::Error.
std::optional<Divergence> compare(TraceReader& expected, TraceReader& found);

/// Fills in the actor's name ("ego (1)") from the run's spawned events up to that tick.
void name_actor(Divergence& divergence, TraceReader& trace);

}  // namespace reprise::replay
