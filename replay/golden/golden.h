#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "replay/trace_reader.h"

namespace reprise::replay {

/// How often a golden says something, in seconds of the run. A candidate is read with its golden's.
struct Sampling {
    std::uint64_t checkpoints = 1;
    std::uint64_t states = 1;

    bool operator==(const Sampling&) const = default;
};

/// What the command line gave a case: a scenario with another town, seed, length or parameters.
struct GivenSetup {
    std::string town;     ///< "": the scenario's; a path is relative to the golden's folder
    std::string seed;     ///< "": the scenario's
    std::string seconds;  ///< "": the scenario's
    std::vector<std::pair<std::string, std::string>> parameters;

    bool operator==(const GivenSetup&) const = default;
};

/// How a check ended.
struct GoldenCheck {
    std::string status;      ///< passed, failed, not_evaluated
    std::uint64_t tick = 0;  ///< of the failure; 0 otherwise
    std::uint32_t line = 0;  ///< in the scenario
    std::string name;
    std::string detail;  ///< such as "at least 9.04, allowed 2"

    /// Without `line`: a comment in the scenario moves its lines and changes nothing.
    bool operator==(const GoldenCheck& other) const;
};

struct GoldenEvent {
    std::uint64_t tick = 0;
    std::string kind;   ///< as world::EventKind names it
    std::string actor;  ///< "ego#1"; "" for none
    std::string other;  ///< likewise
    std::string text;
    std::uint32_t line = 0;  ///< in the scenario; 0: none
    std::string value;       ///< shortest decimal that reads back the same; "": 0
    std::string place;       ///< "x y z" likewise; "": none

    /// Without `line`, as above.
    bool operator==(const GoldenEvent& event) const;

    /// Equal in tick, kind, actors and text; value, place and line may differ.
    bool same_story(const GoldenEvent& other) const;
};

/// What happened in the ticks since the last checkpoint, condensed.
struct Checkpoint {
    std::uint64_t tick = 0;           ///< the last one that it covers
    std::string history;              ///< of these stages in every tick from the first one to this
    std::vector<std::string> stages;  ///< of each stage's digests since the last checkpoint

    bool operator==(const Checkpoint&) const = default;
};

/// The demand's cars and walkers at a checkpoint: their counts, and a digest of their states.
struct BackgroundState {
    std::uint64_t tick = 0;
    std::uint64_t cars = 0;
    std::uint64_t walkers = 0;
    std::string digest;

    bool operator==(const BackgroundState&) const = default;
};

/// An actor of the scenario at one instant: metres, metres a second, radians. Recorded values only,
/// nothing computed with libm, so that a golden is the same text on every CPU.
struct ActorState {
    std::uint64_t tick = 0;
    std::string actor;
    std::vector<std::pair<std::string, std::string>> values;  ///< name, shortest decimal

    bool operator==(const ActorState&) const = default;
};

/// A run condensed to what people review in a text file beside the scenario: what was promised,
/// what happened, where everyone was, and digests of all the rest.
struct Golden {
    // Where it comes from. Not compared: a run that goes the same way is the same run.
    std::string because;
    std::string scenario;         ///< file name
    std::string scenario_digest;  ///< XXH3-64 of its text
    GivenSetup given;
    std::vector<std::string> pins;         ///< what is compared: pins.h; none: everything
    std::vector<world::ParameterT> build;  ///< fingerprint, line by line
    std::vector<std::pair<std::string, std::string>> starts;  ///< town, seed, parameters, ...
    std::string chain;                                        ///< of the whole run, start included

    // What is compared.
    std::uint64_t step_ns = 0;
    Sampling sampling;
    std::string verdict;  ///< passed, failed, completed
    std::string reason;
    std::uint64_t ticks = 0;
    std::vector<GoldenCheck> checks;  ///< by line
    std::vector<GoldenEvent> events;
    std::vector<Checkpoint> checkpoints;
    std::vector<BackgroundState> background;
    std::vector<ActorState> states;
};

/// Names of Checkpoint::stages, in the order of the step. The scenario's own digest is none of
/// them: it holds how much memory Lua needs and how many instructions, which code without effect
/// changes; what a scenario does shows in events, checks and all other stages.
const std::vector<std::string>& golden_stages();

/// Condenses a run; `because`, `given` stay empty. Without a sampling it chooses one: once a second
/// unless the run is longer than ten minutes or has many actors, so that a minute stays under 25
/// kB. About 20 us a tick.
Golden make_golden(TraceReader& trace, std::optional<Sampling> sampling = {});

/// The file's text: JSON with one fact a line, sealed by a digest in the last one. Throws
/// world::Error for a text that is not UTF-8.
std::string to_text(const Golden& golden);

/// Reads what to_text wrote. Anything else - another format, cut off, merged, edited - throws
/// world::Error, "cut_in.golden:12: ...".
Golden parse_golden(const std::string& text, const std::string& path);

/// Reads a file; throws world::Error when that cannot be done.
Golden load_golden(const std::filesystem::path& path);

/// "2.85": a tick's time in seconds, exact for steps of whole milliseconds.
std::string golden_seconds(std::uint64_t tick, std::uint64_t step_ns);

/// "2.85 s", as every command tells times.
std::string time_text(std::uint64_t tick, std::uint64_t step_ns);

}  // namespace reprise::replay
