#include "cli/options/run_options.h"

#include <cstdlib>

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"
#include "cli/options/trace_options.h"

namespace reprise::cli {

namespace {

CLI::Validator seconds() {
    return {[](std::string& text) -> std::string {
                const double value = std::strtod(text.c_str(), nullptr);
                return value > 0 && value <= 86'400
                           ? ""
                           : "expected seconds above 0, 86400 at most, got '" + text + "'";
            },
            ""};
}

void add_set_and_for(CLI::App& command,
                     std::vector<std::string>& assignments,
                     std::optional<double>& limit,
                     const std::string& what_for) {
    command.add_option("--set", assignments, "Set a parameter of the scenario; may be given again")
        ->type_name("KEY=VALUE")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    command.add_option("--for", limit, what_for)->type_name("SECONDS")->check(seconds());
}

}  // namespace

void add_start(CLI::App& command, RunOptions& run, std::vector<std::string>& assignments) {
    command
        .add_option("--town",
                    run.town,
                    "Another town: its name or folder, a SUMO network (.net.xml[.gz]), or a map "
                    "(.xodr, .osm[.gz])")
        ->type_name("NET");
    command.add_option("--seed", run.seed, "What decides everything random")
        ->type_name("N")
        ->transform(whole_number());
    add_set_and_for(command, assignments, run.seconds, "End after this much simulated time");
}

void add_drivers(CLI::App& command, DriverOptions& options) {
    command
        .add_option(
            "--driver",
            options.drivers,
            "Who drives the actor of this name, spawned with driver = 'external': a program "
            "that is started, or one that runs already and comes to a socket or a port of this "
            "machine; may be given again. See docs/drivers.md")
        ->type_name("NAME=COMMAND|NAME=socket:PATH|NAME=tcp:PORT")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    command
        .add_option("--driver-timeout",
                    options.driver_timeout,
                    "End the run when a driver needs longer than this for an answer, in seconds of "
                    "real time (default: wait)")
        ->type_name("SECONDS")
        ->check(seconds());
}

void add_branch(CLI::App& app, BranchOptions& branch, std::vector<std::string>& assignments) {
    CLI::App& command = *app.add_subcommand(
        "branch",
        "What if: let another script, other parameters, or another driver take over in a recorded "
        "run");
    command.add_option("trace", branch.trace, "The trace")->required()->type_name("T.mcap");
    command
        .add_option(
            "--at", branch.at, "The last tick of what was, such as 250t, or time, such as 12.5s")
        ->required()
        ->type_name("TICK");
    command
        .add_option(
            "--script",
            branch.scripts,
            "What happens from there on; several share the way there. Without it the run's own "
            "script goes on where it is, and finds what --set says the next time it looks")
        ->type_name("WHAT_IF.lua")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        .add_option("-o,--output",
                    branch.output,
                    "A trace; or a folder, where a trace named like each script goes")
        ->required()
        ->type_name("B.mcap|DIR");
    add_set_and_for(command, assignments, branch.seconds, "End this long after the branch");
    add_drivers(command, branch);
    command.footer(
        "The run is simulated again up to that tick, and every tick compared with the trace; then\n"
        "each script goes on in a process of its own. Traffic, walkers, contacts and random "
        "streams\n"
        "are in their true state. Vehicles of other programs that no --driver is named for do "
        "what\n"
        "they did in the trace, and brake behind its end.\n"
        "Exit status: 0 all checks passed, 1 one failed, or a driver was lost, or the run came\n"
        "out differently, 2 bad input.\n"
        "Examples: reprise branch a.mcap --at 12.5s --script brake.lua swerve.lua -o what_if\n"
        "          reprise branch a.mcap --at 12.5s --set distance=10 -o closer.mcap\n"
        "          reprise branch a.mcap --at 12.5s --driver ego='./other_stack' -o other.mcap");
}

void add_run(CLI::App& app, RunOptions& run, std::vector<std::string>& assignments) {
    CLI::App& command = *app.add_subcommand("run", "Run a scenario and record it");
    command
        .add_option("scenario",
                    run.scenario,
                    "The scenario, a Lua file; or a trace, whose run is made again from what it "
                    "carries")
        ->required()
        ->type_name("SCENARIO.lua");
    command
        .add_option("-o,--output",
                    run.output,
                    "Where the trace goes (default: the scenario's name, in this folder)")
        ->type_name("T.mcap")
        ->check(CLI::Validator(
            [](std::string& path) -> std::string {
                return path.empty() ? "expected the path of a file, got ''" : "";
            },
            ""));
    add_start(command, run, assignments);
    command
        .add_option("--weather",
                    run.weather,
                    "Another weather than the scenario's at the start: pictures and road friction")
        ->type_name("PRESET,KEY=VALUE,...")
        ->check(a_weather());
    command
        .add_option("--friction",
                    run.friction,
                    "Of the road at the start, as a factor on dry asphalt's grip, instead of the "
                    "weather's")
        ->type_name("FACTOR")
        ->check(a_number_in(0.05, 2));
    command
        .add_option("--cars",
                    run.cars,
                    "Another number of cars in the background traffic; auto: as many as the town "
                    "carries")
        ->type_name("N|auto")
        ->transform(number_of_cars());
    command
        .add_option("--walkers",
                    run.walkers,
                    "People on foot in the background, instead of the scenario's number")
        ->type_name("N")
        ->transform(number_of_walkers());
    add_drivers(command, run);
    add_level(command, run.level, {"full", "keyed", "core", "inputs"});
    command.add_flag("--watch",
                     run.watch,
                     "Run again whenever the scenario, or a file that it names, is saved; until "
                     "Ctrl-C");
    command
        .add_option("--nudge",
                    run.nudge,
                    "A drill: in this tick move one recorded number (default: the first vehicle's "
                    "steering) by so many units in the last place (default 1), without a word in "
                    "the recording, to see verify and diff find it; such as 600:ego.velocity.x")
        ->type_name("TICK[:ACTOR.FIELD[:N]]");
    command.footer(
        "Exit status: 0 all checks passed, 1 a check failed, 2 bad input.\n"
        "Example: reprise run scenarios/free_drive.lua -o a.mcap --seed 7 --for 60");
}

std::pair<std::string, std::string> split_assignment(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw CLI::ValidationError("--set", "expected KEY=VALUE, got '" + text + "'");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace reprise::cli
