#include "cli/run.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "cli/external/seats.h"
#include "cli/fingerprint/self_test.h"
#include "cli/fingerprint/this_build.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/progress.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "cli/town/town_traffic.h"
#include "cli/town/towns.h"
#include "files/ending.h"
#include "files/output_place.h"
#include "kernel/kernel.h"
#include "replay/imported.h"
#include "replay/level.h"
#include "replay/slice.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "scripting/scenario.h"
#include "towns/town_reader.h"
#include "world/blockage.h"
#include "world/check.h"
#include "world/check_result.h"
#include "world/digest.h"
#include "world/lanes/density.h"
#include "world/recording.h"
#include "world/story/crashes.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;
using Check = world::CheckResult;

bool is_trace(const fs::path& path) {
    return path.extension() == ".mcap";
}

/// What a recorded run started from; of this only its length may be another.
world::Recording prepare_again(const RunOptions& options, replay::TraceReader& trace) {
    if (options.town || options.seed || options.weather || options.friction || options.cars ||
        options.walkers || !options.parameters.empty())
        throw world::Error(
            options.scenario +
            ": a recorded run is run again as it was: --town, --seed, --weather, "
            "--friction, --cars, --walkers and --set are for scenarios; to change them run its "
            "scenario");
    if (!options.drivers.empty())
        throw world::Error(options.scenario +
                           ": --driver: what the drivers of a recorded run did is in its trace; "
                           "`reprise branch` lets another one take over");
    world::Recording recording = trace.recording();
    world::EpisodeT& episode = recording.episode;
    if (options.seconds)
        world::limit_ticks(
            episode,
            std::max<std::uint64_t>(
                1,
                static_cast<std::uint64_t>(
                    std::llround(*options.seconds * 1e9 / static_cast<double>(episode.step_ns)))));
    episode.fingerprint = this_build();
    return recording;
}

world::Recording prepare(const RunOptions& options) {
    world::Recording recording;
    const scripting::Overrides overrides{options.town,
                                         options.seed,
                                         options.seconds,
                                         options.parameters,
                                         options.weather,
                                         options.friction,
                                         options.cars,
                                         options.walkers};
    recording.episode =
        options.source.empty()
            ? scripting::load_episode(options.scenario, overrides)
            : scripting::episode_of_text(options.scenario, options.source, overrides);
    world::EpisodeT& episode = recording.episode;
    towns::Network network = load_town(episode.town, options.scenario);
    if (!network.notes.empty())
        say_lines(network.notes, stderr);
    recording.town = towns::read_town(network);
    world::settle_cars(episode, recording.town);
    tell_if_crowded(episode, recording.town);
    episode.town_path =
        episode.town;  // as it was named: equal runs write equal bytes in any folder
    episode.town = network.name;
    episode.town_digest = world::digest128(network.xml);
    episode.fingerprint = this_build();
    recording.network = std::move(network.xml);
    return recording;
}

fs::path output_path(const RunOptions& options) {
    if (!options.output.empty())
        return options.output;
    const fs::path scenario = options.scenario;
    return scenario.stem().string() + (is_trace(scenario) ? "_again.mcap" : ".mcap");
}

std::optional<kernel::Nudge> planned_nudge(const RunOptions& options,
                                           const world::EpisodeT& episode) {
    if (options.nudge.empty())
        return std::nullopt;
    const kernel::Nudge nudge = kernel::parse_nudge(options.nudge);
    if (nudge.tick < 1 || nudge.tick > world::tick_limit(episode))
        throw world::Error(fmt::format(
            "--nudge {}: the run has ticks 1 to {}", options.nudge, world::tick_limit(episode)));
    return nudge;
}

/// What the drivers of a recorded run did in a tick; nothing behind its end.
std::span<const world::Control> inputs(replay::TraceReader& before, std::uint64_t tick) {
    if (tick > before.ticks())
        return {};
    return before.recorded(tick).view.controls();
}

/// What happened, as it happens: printed lines, blockages, checks; a collision when it is over,
/// under the time when it began.
class Commentary {
  public:
    /// `town` must outlive this.
    Commentary(const world::TownT& town, std::uint64_t step_ns, Progress& progress)
        : town_(&town),
          step_ns_(step_ns),
          progress_(&progress) {}

    void hear(const world::TickView& tick) {
        for (const world::Crash& crash : crashes_.hear(tick))
            tell(crash.tick, to_line(crash));
        if (tick.tick->commands() != nullptr)
            for (const world::Command* command : *tick.tick->commands())
                hear(*command);
        for (const world::Event* event : *tick.tick->events())
            hear(*event, tick.index());
        for (auto& [actor, stand] : stands_)
            if (const world::Measurement* measured = world::find(tick.measurements(), actor)) {
                ++stand.seen;
                const bool stands = std::abs(measured->speed()) < world::halted_speed;
                stand.stood += stands ? 1 : 0;
                stand.since = stands ? stand.since + 1 : 0;
                tell_end_of_road(actor, *measured, stand.since, tick.index());
            }
        last_ = tick.index();
    }

    /// The run has ended before it knew that it would.
    void end() {
        for (const world::Crash& crash : crashes_.open())
            tell(crash.tick, to_line(crash));
        tell_who_stood();
    }

  private:
    /// Of one who drives by itself. [ticks]
    struct Stand {
        std::uint64_t seen = 0;
        std::uint64_t stood = 0;
        std::uint64_t since = 0;  ///< it stopped last; 0: it moves
    };

    /// Who has come to where no lane leads on, and stands there, is blocked by nothing.
    void tell_end_of_road(std::uint32_t actor,
                          const world::Measurement& measured,
                          std::uint64_t stood,
                          std::uint64_t tick) {
        constexpr std::uint64_t stands_ns = 2'000'000'000;
        constexpr double end = 15;  // [m] from the rear axle
        if (measured.lane() >= town_->lanes.size() ||
            stood != (stands_ns + step_ns_ - 1) / step_ns_)
            return;
        const world::LaneT& lane = town_->lanes[measured.lane()];
        if (lane.length - measured.lane_s() < end && !world::leads_on(*town_, lane))
            tell(tick,
                 fmt::format("{} stands at the end of its road: {} leads nowhere",
                             crashes_.names().name_of(actor),
                             lane.name));
    }

    /// Whatever was checked: a drive that was none is said to be none, as where a road ends.
    void tell_who_stood() {
        for (const auto& [actor, stand] : stands_)
            if (2 * stand.stood > stand.seen && stand.stood * step_ns_ >= world::blocked_after_ns)
                tell(last_,
                     fmt::format("{} stood for {:.0f} s of its {:.0f} s",
                                 crashes_.names().name_of(actor),
                                 world::seconds(stand.stood, step_ns_),
                                 world::seconds(stand.seen, step_ns_)));
    }

    /// Who drives by itself and was not told that it may overtake?
    void hear(const world::Command& command) {
        const bool spawns = command.kind() == world::CommandKind::spawn &&
                            command.driver() == world::Driver::autopilot &&
                            command.pilot() == world::Pilot::idm;
        if (spawns)
            patient_.insert(command.actor());
        if (command.kind() == world::CommandKind::spawn &&
            (command.driver() == world::Driver::autopilot ||
             command.driver() == world::Driver::external))
            stands_.try_emplace(command.actor());
        if (command.kind() == world::CommandKind::may_overtake && command.on())
            patient_.erase(command.actor());
    }

    void hear(const world::Event& event, std::uint64_t tick) {
        const std::string text = world::to_line(event);
        switch (event.kind()) {
            case world::EventKind::printed:
                return tell(tick, text);
            case world::EventKind::blocked:
                return tell(
                    tick,
                    fmt::format("{} is blocked {}{}",
                                crashes_.names().name_of(event.actor()),
                                text,
                                event.other() != 0 && patient_.contains(event.actor())
                                    ? "; it would look for a way around with may_overtake = true"
                                    : ""));
            case world::EventKind::overtakes:
                return tell(tick,
                            fmt::format("{} overtakes {} {}",
                                        crashes_.names().name_of(event.actor()),
                                        crashes_.names().name_of(event.other()),
                                        text));
            case world::EventKind::ran_red_light:
            case world::EventKind::ran_stop_sign:
            case world::EventKind::on_opposite_lane:
            case world::EventKind::on_sidewalk:
            case world::EventKind::left_road:
            case world::EventKind::speeding:
            case world::EventKind::wrong_way:
            case world::EventKind::wrecked:
            case world::EventKind::backed_off:
                return tell(tick, crashes_.names().name_of(event.actor()) + " " + text);
            case world::EventKind::check_failed:
                if (!world::tells_worst(event))  // else the summary says so
                    tell(tick, "check failed: " + text);
                return;
            default:
                return;
        }
    }

    void tell(std::uint64_t tick, const std::string& text) {
        progress_->clear();
        say("{:8.2f} s  {}\n", world::seconds(tick, step_ns_), text);
    }

    const world::TownT* town_;
    std::uint64_t step_ns_;
    Progress* progress_;
    world::CrashStory crashes_;
    std::set<std::uint32_t> patient_;  ///< ids
    std::map<std::uint32_t, Stand> stands_;
    std::uint64_t last_ = 0;  ///< tick
};

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

void print_summary(const world::Recording& recording,
                   const kernel::Kernel& kernel,
                   const world::Outcome& outcome,
                   const fs::path& path,
                   double wall_seconds) {
    const double simulated = world::seconds(outcome.ticks, recording.episode.step_ns);
    for (const Check& check : kernel.checks()) {
        const bool failed = check.status == Check::Status::fail;
        say("  {:<14}{}{}{}{}\n",
            word(check.status),
            check.name,
            check.detail.empty() ? "" : ": " + check.detail,
            failed
                ? fmt::format(" at {:.2f} s", world::seconds(check.tick, recording.episode.step_ns))
                : "",
            check.worst.empty() ? "" : "; " + check.worst);
    }
    say("{}: {} ({:.2f} s simulated in {:.2f} s, {:.0f} times real time)\n",
        outcome.verdict,
        outcome.reason,
        simulated,
        wall_seconds,
        simulated / std::max(wall_seconds, 1e-9));
    say("{}: {}, {:.2f} MB\n",
        path.string(),
        world::count_of(outcome.ticks, "tick"),
        static_cast<double>(fs::file_size(path)) / 1e6);
}

/// `rest`: where what was recorded until then is to be found. Returns the exit code.
int tell_stopped(int signal, std::uint64_t ticks, const std::string& rest) {
    say(stderr,
        "reprise: stopped ({}) {}\n",
        strsignal(signal),
        ticks == 0 ? "before the first tick; nothing was recorded"
                   : fmt::format("behind tick {}{}", ticks, rest));
    return exit_stopped + signal;
}

/// How a recorded run ended, when it was with a driver in another program or a client, whose
/// controls are in its trace only until then.
std::optional<world::Outcome> recorded_end(const std::optional<replay::TraceReader>& before) {
    if (!before || !world::is_early_end(before->outcome()))
        return std::nullopt;
    return before->outcome();
}

}  // namespace

int run(const RunOptions& options) {
    self_test();
    std::optional<replay::TraceReader> before;  // when it is a recorded run
    if (is_trace(options.scenario)) {
        replay::require_simulated(before.emplace(options.scenario));
        replay::require_start_of_run(*before);
    }
    const world::Recording recording = before ? prepare_again(options, *before) : prepare(options);
    const std::optional<kernel::Nudge> nudge = planned_nudge(options, recording.episode);
    const fs::path path = output_path(options);
    refuse_overwriting(options.scenario, path);
    const fs::path target = files::output_target(path, "the trace");
    const std::string rest = "; what was recorded until then is in " + target.string() +
                             ".partial: " + recover_command(target.string() + ".partial");
    // Before there is a file: from here on, a signal ends the run behind a tick.
    const files::StopRequest stop;
    std::optional<replay::TraceWriter> trace;
    trace.emplace(target, recording, *replay::level_named(options.level));
    say_when_crashing(rest);
    kernel::Kernel kernel(recording);
    if (nudge)
        kernel.nudge(*nudge);
    Seats seats(
        options.drivers, {options.driver_timeout, [&] { return stop.signal() != 0; }}, recording);
    Progress progress("running", "ticks", world::tick_limit(recording.episode));
    Commentary commentary(recording.town, recording.episode.step_ns, progress);
    const std::optional<world::Outcome> ended_before = recorded_end(before);
    std::uint64_t index = 0;
    const auto step = [&]() -> const world::SealedTick& {
        try {
            return kernel.step(before ? inputs(*before, index + 1) : seats.controls());
        } catch (const world::Error& error) {
            throw index == 0 ? error : world::Error(error.what() + rest);
        }
    };
    // That nobody drives who was just spawned is known behind their first tick only.
    const auto show_drivers = [&](const world::SealedTick& tick) {
        try {
            seats.go_on(tick, [&] { kernel.begin_step(); });
        } catch (const world::Error& error) {
            if (index > 1 || stop.signal() != 0)
                throw world::Error(error.what() + rest);
            trace.reset();
            fs::remove(target.string() + ".partial");  // nothing happened yet
            throw;
        }
    };
    try {
        while (!kernel.finished() && stop.signal() == 0 && !seats.loss() &&
               !(ended_before && index >= ended_before->ticks)) {
            const world::SealedTick& tick = step();
            ++index;
            trace->append(tick);
            commentary.hear(tick.view());
            progress.update(index);
            if (!before && stop.signal() == 0) {
                if (kernel.finished())
                    seats.see_last(tick);
                else
                    show_drivers(tick);
            }
        }
    } catch (const world::Error&) {
        if (stop.signal() == 0)
            throw;  // else it is the signal that counts: nobody reads what we print
    }
    commentary.end();
    progress.clear();
    say_when_crashing("");
    if (!kernel.finished() && stop.signal() != 0) {
        trace.reset();
        return tell_stopped(stop.signal(), index, rest);
    }
    const bool ended_again = ended_before && !kernel.finished();
    const world::Outcome outcome = ended_again ? *ended_before : seats.end(kernel.outcome());
    trace->close(outcome);
    print_summary(recording, kernel, outcome, path, progress.seconds());
    if (nudge && nudge->tick > outcome.ticks)
        throw world::Error(fmt::format("--nudge {}: the run ended at tick {}; nothing was nudged",
                                       nudge->text,
                                       outcome.ticks));
    if (seats.loss() && seats.loss()->ours)
        return exit_our_fault;
    const std::vector<Check> checks = kernel.checks();
    const bool failed = std::any_of(checks.begin(), checks.end(), [](const Check& check) {
        return check.status == Check::Status::fail;
    });
    const bool good = outcome.verdict != "failed" && outcome.verdict != "driver_lost";
    return good && !failed ? exit_good : exit_differs;
}

}  // namespace reprise::cli
