#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/compare/field_difference.h"
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
    std::string script;    ///< the last thing the scenario said before it: "tick 598 (29.90 s):
                           ///< set_speed of ego (1), cut_in.lua:31"; "" when nothing ever
    std::string again;     ///< the command that comes back to it; filled in by programs
    std::uint32_t actor_id = 0;  ///< 0: none
    bool unrecorded = false;     ///< only a stage's digest differs
};

/// A line in which two builds' fingerprints differ; "-" where one of them has no such line.
struct BuildDifference {
    std::string key;
    std::string expected;
    std::string found;
};

using Fingerprint = std::vector<world::ParameterT>;  ///< as in Episode.fingerprint

/// In the order of `expected`, then what only `found` has.
std::vector<BuildDifference> build_differences(const Fingerprint& expected,
                                               const Fingerprint& found);

/// A few lines for a person.
std::string to_text(const Divergence& divergence, std::uint64_t step_ns);

/// Compares two ticks of the same index byte by byte, then explains the first difference, stages in
/// their order.
std::optional<Divergence> compare(const RecordedTick& expected, const RecordedTick& found);

/// The first recorded field that differs, by more than is tolerated, whatever the digests say;
/// nothing when all agree.
std::optional<Divergence> compare_recorded(const RecordedTick& expected,
                                           const RecordedTick& found,
                                           Tolerance* tolerance = nullptr);

/// A field in which two ticks differ, and the stage that made it.
struct StageDifference {
    std::string stage;
    FieldDifference field;
};

/// Every recorded field in which two ticks of the same index differ, by more than is tolerated, and
/// without a tolerance the stages' digests; in the order of the stages. Of events all are told: one
/// more moves those behind it along.
std::vector<StageDifference> all_differences(const RecordedTick& expected,
                                             const RecordedTick& found,
                                             const std::optional<Tolerance>& tolerance);

/// How many ticks behind a difference that shows only in a digest are searched for one in the
/// record, and how many before one for what the scenario said last.
inline constexpr std::uint64_t longest_search = 1200;

/// Adds to the note where such a difference first shows in the record; nothing: within `searched`
/// ticks nowhere.
void add_first_recorded(Divergence& divergence,
                        const std::optional<Divergence>& recorded,
                        std::uint64_t searched);

/// Finds the first difference of two traces: the first tick whose digests differ, by binary search
/// along the chains; else the first whose bytes differ, then the lengths and how they ended. Equal
/// chains mean equal histories, so a difference in a trace of an hour takes about 20 ms. Equality
/// takes a look at every byte, about 0.2 s: of two packed chunks that are equal, neither is
/// unpacked. It includes that neither file was damaged; otherwise this throws world::Error.
/// Of runs with different starts (another seed, say) the chain is left out of the comparison,
/// because it differs from the first tick on; the note says what was different.
/// What differs only in a digest is followed until it shows in the record.
std::optional<Divergence> compare(TraceReader& expected, TraceReader& found);

/// Two traces that need not be equal to the bit, such as those of different builds: the first
/// recorded value outside of the tolerance. Digests are not compared; events, commands, ids,
/// counts, texts, lengths and verdicts must be equal. What the runs started from may be different:
/// `start_difference` says in what. Every tick of both is read and checked: about 0.1 ms a tick.
std::optional<Divergence> compare(TraceReader& expected, TraceReader& found, Tolerance& tolerance);

/// "the runs did not start from the same: seed 7 / 8", or "".
std::string start_difference(const TraceReader& expected, const TraceReader& found);

/// "their towns were read from 'a' / 'b'", or "": equal towns may lie anywhere, so this is none of
/// the differences.
std::string town_path_difference(const TraceReader& expected, const TraceReader& found);

/// How one run branched off the other, or both off a third: "branched at tick 250 (12.50 s) by
/// brake.lua". "" when they did not.
std::string branch_text(const world::EpisodeT& expected, const world::EpisodeT& found);

/// Fills in what the run was doing: the actor's name ("ego (1)") from the spawned events up to that
/// tick, and the last thing that its scenario said.
void add_context(Divergence& divergence, TraceReader& trace);

}  // namespace reprise::replay
