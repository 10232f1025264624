#include "cli/run.h"

#include <filesystem>
#include <fmt/format.h>

#include "cli/full_fingerprint.h"
#include "cli/guard.h"
#include "cli/self_test.h"
#include "cli/progress.h"
#include "cli/towns.h"
#include "kernel/kernel.h"
#include "replay/recording.h"
#include "replay/trace_writer.h"
#include "scripting/scenario.h"
#include "traffic/town_reader.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;
using Check = scripting::Scenario::Check;

replay::Recording prepare(const RunOptions& options) {
    replay::Recording recording;
    recording.episode = scripting::load_episode(
        options.scenario, {options.town, options.seed, options.seconds, options.parameters});
    world::EpisodeT& episode = recording.episode;
    const fs::path path = find_network(episode.town, options.scenario);
    traffic::Network network = traffic::load_network(path);
    if (!network.notes.empty())
        fmt::print(stderr, "{}", network.notes);
    recording.town = traffic::read_town(network);
    episode.town_path =
        episode.town;  // as it was named: equal runs write equal bytes in any folder
    episode.town = network.name;
    episode.town_digest = world::digest128(network.xml);
    for (const auto& [key, value] : full_fingerprint()) {
        world::ParameterT line;
        line.key = key;
        line.value = value;
        episode.fingerprint.push_back(line);
    }
    recording.network = std::move(network.xml);
    return recording;
}

fs::path output_path(const RunOptions& options) {
    if (!options.output.empty())
        return options.output;
    return fs::path(options.scenario).stem().string() + ".mcap";
}

/// What happened, as it happens: printed lines, collisions, checks.
void print_events(const world::TickView& tick, std::uint64_t step_ns, Progress& progress) {
    for (const world::Event* event : *tick.tick->events()) {
        std::string text = event->text() == nullptr ? "" : event->text()->str();
        switch (event->kind()) {
            case world::EventKind::printed:
                break;
            case world::EventKind::collision:
                text = fmt::format(
                    "collision of {} with {}, {:.0f} N s",
                    event->actor(),
                    event->other() == 0 ? "something fixed" : std::to_string(event->other()),
                    event->value());
                break;
            case world::EventKind::check_failed:
                text = "check failed: " + text;
                break;
            default:
                continue;
        }
        progress.clear();
        fmt::print("{:8.2f} s  {}\n", world::seconds(tick.index(), step_ns), text);
    }
}

const char* word(Check::Status status) {
    switch (status) {
        case Check::Status::pass:
            return "pass";
        case Check::Status::fail:
            return "FAIL";
        case Check::Status::not_evaluated:
            break;
    }
    return "NOT EVALUATED";
}

void print_summary(const replay::Recording& recording,
                   const kernel::Kernel& kernel,
                   const fs::path& path,
                   double wall_seconds) {
    const replay::Outcome outcome = kernel.outcome();
    const double simulated = world::seconds(outcome.ticks, recording.episode.step_ns);
    for (const Check& check : kernel.checks())
        fmt::print("  {:<14}{}{}\n",
                   word(check.status),
                   check.name,
                   check.detail.empty() ? "" : ": " + check.detail);
    fmt::print("{}: {} ({:.2f} s simulated in {:.2f} s, {:.0f} times real time)\n",
               outcome.verdict,
               outcome.reason,
               simulated,
               wall_seconds,
               simulated / std::max(wall_seconds, 1e-9));
    fmt::print("{}: {} ticks, {:.2f} MB\n",
               path.string(),
               outcome.ticks,
               static_cast<double>(fs::file_size(path)) / 1e6);
}

}  // namespace

int run(const RunOptions& options) {
    self_test();
    const replay::Recording recording = prepare(options);
    if (options.nudge_tick &&
        (*options.nudge_tick < 1 || *options.nudge_tick > recording.episode.max_ticks))
        throw world::Error(fmt::format("--nudge {}: the run has ticks 1 to {}",
                                       *options.nudge_tick,
                                       recording.episode.max_ticks));
    const fs::path path = output_path(options);
    replay::TraceWriter trace(path, recording);
    kernel::Kernel kernel(recording);
    if (options.nudge_tick)
        kernel.nudge(*options.nudge_tick);
    Progress progress("running", "ticks", recording.episode.max_ticks);
    while (!kernel.finished()) {
        const world::SealedTick& tick = kernel.step();
        trace.append(tick);
        print_events(tick.view(), recording.episode.step_ns, progress);
        progress.update(tick.view().index());
    }
    progress.clear();
    trace.close(kernel.outcome());
    print_summary(recording, kernel, path, progress.seconds());
    return kernel.outcome().verdict == "failed" ? exit_differs : exit_good;
}

}  // namespace reprise::cli
