#include "cli/trace/recover.h"

#include <filesystem>

#include <fmt/format.h>

#include "cli/process/guard.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "replay/recovery.h"
#include "world/story/wording.h"
#include "world/tick.h"

namespace reprise::cli {

namespace {

void row(const std::string& key, const std::string& value) {
    say("  {:<10}{}\n", key, value);
}

/// How many of the ticks that the run was given at most are missing: it may have ended before.
std::string missing(const replay::Recovery& recovery) {
    const std::uint64_t ticks = recovery.outcome.ticks;
    const world::EpisodeT& episode = recovery.episode;
    if (ticks >= episode.max_ticks)
        return "how the run ended";
    return fmt::format("all behind tick {}; the run was to end at tick {} ({:.2f} s) at the latest",
                       ticks,
                       episode.max_ticks,
                       world::seconds(episode.max_ticks, episode.step_ns));
}

void print_report(const RecoverOptions& options, const replay::Recovery& recovery) {
    const world::EpisodeT& episode = recovery.episode;
    say("{}: {} ({:.2f} s, {:.2f} MB) recovered from {}\n",
        options.output,
        world::count_of(recovery.outcome.ticks, "tick"),
        world::seconds(recovery.outcome.ticks, episode.step_ns),
        static_cast<double>(std::filesystem::file_size(options.output)) / 1e6,
        options.damaged);
    row("run",
        fmt::format("{} ({}) in {}, seed {}",
                    episode.name,
                    episode.scenario_path,
                    episode.town,
                    episode.seed));
    if (recovery.loss.empty()) {
        row("lost", "nothing");
        return;
    }
    row("lost", missing(recovery));
    row("why", recovery.loss);
    row("next", "reprise verify " + shell_path(options.output) + "    # are these ticks right?");
    row("",
        rerun_command(options.output, episode, episode.max_ticks) + "    # the whole run again");
}

}  // namespace

int recover(const RecoverOptions& options) {
    try {
        const replay::Recovery recovery = replay::recover(options.damaged, options.output);
        print_report(options, recovery);
        return recovery.loss.empty() ? exit_good : exit_with_loss;
    } catch (const replay::NothingToRecover& error) {
        say(stderr, "reprise: nothing can be recovered: {}\n", error.what());
        return exit_differs;
    }
}

}  // namespace reprise::cli
