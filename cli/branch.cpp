// `reprise branch`.
//   must      begin exactly where the recorded run was; ten what-ifs cost one way there; need no
//             driver in another program that is not named
//   assumes   the trace is whole ticks of one run, and this build makes the same ones
//   goes      all scripts are read first; a kernel follows the trace to the tick; then a copy of
//             this process for each script, with its own trace: the parent's ticks, then its own
//   keeps     nothing: no state is saved, a fork has all of it
#include "cli/branch.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/external/seats.h"
#include "cli/fingerprint/self_test.h"
#include "cli/fingerprint/this_build.h"
#include "cli/options/tick_option.h"
#include "cli/process/guard.h"
#include "cli/process/new_folder.h"
#include "cli/process/output.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "cli/run_again.h"
#include "files/output_place.h"
#include "kernel/verify.h"
#include "process/copy.h"
#include "replay/trace_reader.h"
#include "replay/trace_writer.h"
#include "scripting/scenario.h"
#include "scripting/spawned_names.h"
#include "world/check.h"
#include "world/external/external_drivers.h"
#include "world/printable.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;
using How = process::CopyResult::How;

struct WhatIf {
    std::string script;  ///< names the output; the parent trace when its own script goes on
    fs::path output;
    world::BranchT branch;
};

std::uint64_t branch_tick(const BranchOptions& options, const replay::TraceReader& trace) {
    const std::uint64_t tick =
        parse_tick("--at", options.at, trace.episode().step_ns, 0, BareNumber::refused);
    const auto& branches = trace.episode().branches;
    const std::uint64_t first = branches.empty() ? 1 : branches.back().tick + 1;
    if (first >= trace.ticks())
        throw world::Error(
            fmt::format("{}: too short to branch: it holds {} tick{}{}",
                        options.trace,
                        trace.ticks(),
                        trace.ticks() == 1 ? "" : "s",
                        branches.empty()
                            ? ""
                            : fmt::format(" and branched off itself at {}", branches.back().tick)));
    if (tick < first || tick >= trace.ticks())
        throw world::Error(
            fmt::format("--at {}: expected a tick from {} to {}: {} holds {} ticks{}",
                        options.at,
                        first,
                        trace.ticks() - 1,
                        options.trace,
                        trace.ticks(),
                        branches.empty() ? "" : ", and branched off itself before that"));
    return tick;
}

/// Whether each what-if gets its own trace in a folder; else the only one is written to -o.
bool wants_folder(const BranchOptions& options) {
    return options.scripts.size() > 1 || fs::path(options.output).extension() != ".mcap";
}

fs::path output_of(const BranchOptions& options, const std::string& script) {
    const fs::path output = options.output;
    return wants_folder(options) ? output / (fs::path(script).stem().string() + ".mcap") : output;
}

std::vector<WhatIf> plan(const BranchOptions& options,
                         std::uint64_t tick,
                         replay::TraceReader& trace) {
    scripting::Overrides overrides;
    overrides.duration = options.seconds;
    overrides.parameters = options.parameters;
    std::vector<WhatIf> all;
    if (options.scripts.empty())
        all.push_back(
            {options.trace, "", scripting::change_branch(overrides, trace.episode(), tick)});
    for (const std::string& script : options.scripts)
        all.push_back(
            {script, "", scripting::load_branch(script, overrides, trace.episode(), tick)});
    for (WhatIf& one : all) {
        one.branch.parent_chain = trace.chain(tick);
        one.output = output_of(options, one.script);
        refuse_overwriting(options.trace, one.output);
        for (const WhatIf& other : all)
            if (&other != &one && other.output == one.output)
                throw world::Error(fmt::format("{} and {} would both be written to {}",
                                               other.script,
                                               one.script,
                                               one.output.string()));
    }
    return all;
}

/// What drivers in other programs do behind a branch: those that took over, what they say; the
/// others what they did in the recorded run, as long as that lasted, and then they brake.
std::vector<world::Control> inputs(const Seats& seats,
                                   const world::ExternalDrivers& drivers,
                                   replay::TraceReader& trace,
                                   std::uint64_t tick) {
    std::vector<world::Control> all(seats.controls().begin(), seats.controls().end());
    const bool recorded = tick <= trace.ticks();
    const auto before =
        recorded ? trace.recorded(tick).view.controls() : std::span<const world::Control>();
    for (const auto& [actor, spawn] : drivers.spawns()) {
        if (seats.drives(actor))
            continue;
        const auto said = std::find_if(before.begin(), before.end(), [id = actor](const auto& one) {
            return one.actor() == id;
        });
        if (said != before.end())
            all.push_back(*said);
        else if (!recorded)
            all.emplace_back(0, 1, 0, actor, std::uint16_t{0}, false, false);
    }
    return all;
}

/// The kernel at the tick where the run branches.
struct There {
    kernel::Kernel* kernel;
    const world::SealedTick* tick;
    world::ExternalDrivers drivers;
    std::map<std::uint32_t, remote::Guide> guides;  ///< of those vehicles, by actor
    std::map<std::string, world::Driver> names;     ///< who drove whom; a name is given once

    void hear(const world::Tick& now, const world::TownT& town) {
        drivers.hear(now);
        for (const world::Command* command : *now.commands())
            if (command->kind() == world::CommandKind::spawn && command->text() != nullptr)
                names.emplace(command->text()->str(), command->driver());
        for (const auto& [actor, spawn] : drivers.spawns())
            guides.try_emplace(actor, town, actor).first->second.look(now);
    }
};

/// In the child: the parent's ticks as they are recorded, then what the script makes of it.
void go_on(There& there,
           replay::TraceReader& trace,
           const WhatIf& what_if,
           const BranchOptions& options) {
    kernel::Kernel& kernel = *there.kernel;
    world::Recording recording = trace.recording();
    recording.episode.branches.push_back(what_if.branch);
    recording.episode.fingerprint = this_build();
    replay::TraceWriter writer(
        what_if.output, recording, replay::Level::full, replay::Unfinished::remove);
    for (std::uint64_t index = 1; index <= what_if.branch.tick; ++index)
        writer.append(trace.tick(index));
    Seats seats(options.drivers, {options.driver_timeout}, recording);
    TickBytes before;
    if (what_if.branch.tick > 1) {
        const replay::RecordedTick recorded = trace.tick(what_if.branch.tick - 1);
        before = {recorded.tick_bytes, recorded.traffic_bytes};
    }
    seats.take_over(there.drivers, there.guides, before, *there.tick);
    kernel.branch(what_if.branch);
    for (std::uint64_t next = what_if.branch.tick + 1; !kernel.finished() && !seats.loss();
         ++next) {
        const world::SealedTick& tick = kernel.step(inputs(seats, there.drivers, trace, next));
        writer.append(tick);
        if (kernel.finished())
            seats.see_last(tick);
        else
            seats.go_on(tick, [&] { kernel.begin_step(); });
    }
    writer.close(seats.end(kernel.outcome()));
}

std::vector<process::CopyResult> go_on_in_copies(There& there,
                                                 replay::TraceReader& trace,
                                                 const std::vector<WhatIf>& what_ifs,
                                                 const BranchOptions& options) {
    there.kernel->rest();
    std::vector<process::Copy> copies;
    for (const WhatIf& what_if : what_ifs)
        copies.push_back({.subject = what_if.output, .work = [&] {
                              go_on(there, trace, what_if, options);
                              return "";
                          }});
    return process::run_copies(process::Children(), copies);
}

/// What became of one, and the exit code.
int report(const WhatIf& what_if, const process::CopyResult& result) {
    if (result.how != How::returned) {
        if (result.how == How::mistake)
            say(stderr, "reprise: {}\n", result.text);
        say("{}: nothing was written\n", what_if.output.string());
        return exit_bad_input;
    }
    const replay::TraceReader trace(what_if.output);
    const world::Outcome& outcome = trace.outcome();
    say("{}: {}, {} from tick {} on; {}: {}\n",
        what_if.output.string(),
        world::count_of(trace.ticks(), "tick"),
        what_if.branch.name,
        what_if.branch.tick + 1,
        outcome.verdict,
        outcome.reason);
    return outcome.verdict == "failed" || outcome.verdict == "driver_lost" ? exit_differs
                                                                           : exit_good;
}

/// Mistakes in --driver, before the long way to the tick.
void check_drivers(const BranchOptions& options) {
    for (const remote::SeatPlan& plan : parse_seats(options.drivers))
        if (plan.command.empty() && options.scripts.size() > 1)
            throw world::Error(fmt::format(
                "--driver {}={}: one driver comes there, and {} scripts need one each: "
                "name a command, or branch for each script",
                plan.actor,
                plan.port ? fmt::format("tcp:{}", *plan.port) : "socket:" + plan.socket.string(),
                options.scripts.size()));
}

/// The Lua texts of what goes on behind a branch, with what was said to their parameters.
std::vector<std::string> texts_of(const world::EpisodeT& episode, const world::BranchT& branch) {
    std::vector<std::string> texts{episode.scenario};
    const auto add_parameters = [&](const auto& parameters) {
        for (const auto& parameter : parameters)
            texts.push_back(parameter.value);
    };
    add_parameters(episode.parameters);
    const auto take_over = [&](const world::BranchT& by) {
        if (!by.scenario.empty())
            texts = {by.scenario};
        add_parameters(by.parameters);
    };
    for (const world::BranchT& one : episode.branches)
        take_over(one);
    take_over(branch);
    return texts;
}

/// Whom --driver names and nobody can be. Throws world::Error: rather than go on as recorded, with
/// a driver that waits for nothing.
void check_names(const There& there,
                 const BranchOptions& options,
                 const world::EpisodeT& episode,
                 const std::vector<WhatIf>& what_ifs) {
    std::vector<std::string> driven;
    for (const auto& [actor, spawn] : there.drivers.spawns())
        driven.push_back(spawn.command.text);
    for (const remote::SeatPlan& plan : parse_seats(options.drivers)) {
        const std::string& name = plan.actor;
        if (std::find(driven.begin(), driven.end(), name) != driven.end())
            continue;
        if (const auto known = there.names.find(name); known != there.names.end())
            throw world::Error(fmt::format(
                "--driver {}: at {} '{}' {}",
                name,
                options.at,
                name,
                known->second == world::Driver::external
                    ? "is there no longer"
                    : "is driven by nobody in another program: its driver is not 'external'"));
        const bool may_come = std::any_of(what_ifs.begin(), what_ifs.end(), [&](const auto& one) {
            const auto texts = texts_of(episode, one.branch);
            return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
                return scripting::may_name(text, name);
            });
        });
        if (!may_come)
            throw world::Error(
                fmt::format("--driver {}: nobody is called that{}; other programs "
                            "drive {} at {}",
                            name,
                            world::did_you_mean(name, driven),
                            driven.empty() ? "nobody" : fmt::format("{}", fmt::join(driven, ", ")),
                            options.at));
    }
}

/// Who of other programs' vehicles goes on without one.
void tell_undriven(const world::ExternalDrivers& drivers,
                   const BranchOptions& options,
                   std::uint64_t ticks) {
    const std::vector<remote::SeatPlan> plans = parse_seats(options.drivers);
    for (const auto& [actor, spawn] : drivers.spawns())
        if (std::none_of(plans.begin(), plans.end(), [name = spawn.command.text](const auto& plan) {
                return plan.actor == name;
            }))
            say(stderr,
                "reprise: '{0}' does what its driver did until tick {1}, then it brakes; --driver "
                "{0}=COMMAND lets another one take over\n",
                world::printable(spawn.command.text),
                ticks);
}

}  // namespace

int branch(const BranchOptions& options) {
    if (options.scripts.empty() && options.parameters.empty() && options.drivers.empty())
        throw world::Error(
            "branch: nothing would be different: give --script WHAT_IF.lua, which takes over, or "
            "--set KEY=VALUE, with which the run's own script goes on, or --driver NAME=COMMAND, "
            "which drives on");
    check_drivers(options);
    self_test();
    replay::TraceReader trace(options.trace);
    require_repeatable(trace);
    const std::uint64_t tick = branch_tick(options, trace);
    trace.tick(tick);  // says at once when the trace is not full
    const std::vector<WhatIf> what_ifs = plan(options, tick, trace);
    std::optional<NewFolder> folder;
    if (wants_folder(options))
        folder.emplace(options.output);
    for (const WhatIf& what_if : what_ifs)
        files::output_target(what_if.output, "the trace");  // rather now than after a long way
    print_recording_build(trace);
    kernel::Kernel kernel(trace.recording());
    There there{&kernel, nullptr, {}, {}, {}};
    Progress progress("going there", "ticks", tick);
    const auto divergence =
        kernel::follow(kernel, trace, tick, [&](const world::SealedTick& tick_there) {
            there.tick = &tick_there;  // of the last one it stays
            there.hear(*tick_there.view().tick, trace.recording().town);
            progress.update(tick_there.view().index());
        });
    progress.clear();
    if (divergence)
        return report_difference(options.trace,
                                 trace,
                                 *divergence,
                                 fmt::format(" before tick {}; nothing was written", tick));
    check_names(there, options, trace.episode(), what_ifs);
    tell_undriven(there.drivers, options, trace.ticks());
    const auto results = go_on_in_copies(there, trace, what_ifs, options);
    int code = exit_good;
    for (std::size_t i = 0; i < what_ifs.size(); ++i)
        code = std::max(code, report(what_ifs[i], results[i]));
    if (folder)
        folder->keep();
    for (const process::CopyResult& result : results)
        if (result.how == How::fault)
            throw std::runtime_error(result.text);
    return code;
}

}  // namespace reprise::cli
