#include "cli/diff.h"

#include <fmt/format.h>

#include "cli/guard.h"
#include "cli/other_build.h"
#include "cli/reproduce.h"
#include "replay/divergence.h"
#include "replay/trace_reader.h"
#include "world/digest.h"

namespace reprise::cli {

namespace {

/// One more run when both started from the same, so that one sees which of them it takes after;
/// else both runs anew.
std::string commands_again(const DiffOptions& options,
                           replay::TraceReader& expected,
                           replay::TraceReader& found,
                           std::uint64_t tick) {
    const auto again = [&](replay::TraceReader& trace) {
        const world::EpisodeT& episode = trace.episode();
        return rerun_command(
            trace.path(), episode, tick == 0 ? episode.max_ticks : length_beyond(episode, tick));
    };
    if (expected.chain(0) == found.chain(0))
        return again(expected) + " -o again.mcap; reprise diff " + shell_path(options.expected) +
               " again.mcap";
    return again(expected) + " -o expected.mcap; " + again(found) +
           " -o found.mcap; reprise diff expected.mcap found.mcap";
}

}  // namespace

int diff(const DiffOptions& options) {
    replay::TraceReader expected(options.expected);
    replay::TraceReader found(options.found);
    print_other_build("recorded by different builds",
                      "expected",
                      expected.episode().fingerprint,
                      "found",
                      found.episode().fingerprint);
    auto divergence = replay::compare(expected, found);
    if (!divergence) {
        fmt::print("equal: {} ticks, chain {}\n",
                   expected.ticks(),
                   world::to_hex(expected.chain(expected.ticks())));
        return exit_good;
    }
    divergence->again = commands_again(options, expected, found, divergence->tick);
    fmt::print("different\n{}", to_text(*divergence, expected.episode().step_ns));
    return exit_differs;
}

}  // namespace reprise::cli
