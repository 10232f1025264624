#include "cli/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <cstdlib>

#include "cli/golden_options.h"
#include "cli/tool_options.h"
#include "cli/town_options.h"
#include "world/check.h"
#include "world/fingerprint.h"
#include "world/weather.h"

namespace reprise::cli {

namespace {

std::string version_text() {
    std::string text;
    for (const auto& [key, value] : world::build_fingerprint())
        text += key + std::string(key.size() < 13 ? 13 - key.size() : 1, ' ') + value + "\n";
    text.pop_back();
    return text;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

/// Accepts only words of the list, and suggests the nearest.
CLI::Validator one_of(std::vector<std::string> words, const std::string& what) {
    return CLI::Validator(
        [words, what](std::string& word) -> std::string {
            if (std::find(words.begin(), words.end(), word) != words.end())
                return "";
            return "no " + what + " '" + word + "'" + world::did_you_mean(word, words) +
                   "; there are " + joined(words);
        },
        "");
}

/// Decimal digits only: what CLI11 reads as a number may also be octal, negative or too large.
CLI::Validator whole_number() {
    return CLI::Validator(
        [](std::string& text) -> std::string {
            std::uint64_t value = 0;
            const char* end = text.data() + text.size();
            const auto [stop, error] = std::from_chars(text.data(), end, value);
            if (error != std::errc() || stop != end)
                return "expected a whole number from 0 to 18446744073709551615, got '" + text + "'";
            text = std::to_string(value);  // without the leading zeros of an octal number
            return "";
        },
        "");
}

}  // namespace

struct CommandLine::App {
    CLI::App app{
        "Reprise: runs scripted drives in live traffic, records every tick, proves that they "
        "replay\n"
        "bit for bit, and renders what the sensors saw under any weather.",
        "reprise"};
    std::vector<std::string> assignments;
    std::vector<std::string> accept_assignments;
    std::vector<std::string> branch_assignments;
    std::string size = "800x600";
    std::string mount;
    std::string threads;
};

CommandLine::~CommandLine() = default;

namespace {

void add_set_and_for(CLI::App& command,
                     std::vector<std::string>& assignments,
                     std::optional<double>& seconds,
                     const std::string& what_for) {
    command.add_option("--set", assignments, "Set a parameter of the scenario; may be given again")
        ->type_name("KEY=VALUE")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
    command.add_option("--for", seconds, what_for)
        ->type_name("SECONDS")
        ->check(CLI::Validator(
            [](std::string& text) -> std::string {
                const double value = std::strtod(text.c_str(), nullptr);
                return value > 0 && value <= 86'400
                           ? ""
                           : "expected seconds above 0, 86400 at most, got '" + text + "'";
            },
            ""));
}

/// What a run may be given besides its scenario.
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

CLI::Option& add_level(CLI::App& command,
                       std::string& level,
                       const std::vector<std::string>& words) {
    return *command
                .add_option("--level",
                            level,
                            "How much of each tick is kept: inputs (what was driven by hand, and "
                            "digests), core (all but the traffic), keyed (the traffic once a "
                            "second)" +
                                std::string(words.front() == "full" ? ", full (default)" : ""))
                ->type_name("LEVEL")
                ->check(one_of(words, "level"));
}

void add_strip(CLI::App& app, StripOptions& strip) {
    CLI::App& command = *app.add_subcommand(
        "strip", "Leave out of a trace what can be simulated again: expand brings it back");
    command.add_option("trace", strip.trace, "The trace")->required()->type_name("T.mcap");
    command.add_option("-o,--output", strip.output, "Where the smaller trace goes")
        ->required()
        ->type_name("S.mcap");
    add_level(command, strip.level, {"inputs", "core", "keyed"}).required();
    command.footer(
        "verify and diff work on the smaller trace; render needs the traffic.\n"
        "Example: reprise strip a.mcap -o small.mcap --level inputs");
}

void add_expand(CLI::App& app, ExpandOptions& expand) {
    CLI::App& command = *app.add_subcommand(
        "expand", "Simulate again what strip left out of a trace, checking every tick");
    command.add_option("trace", expand.trace, "The stripped trace")
        ->required()
        ->type_name("S.mcap");
    command.add_option("-o,--output", expand.output, "Where the full trace goes")
        ->required()
        ->type_name("T.mcap");
    command.footer(
        "The result is, byte for byte, the trace before it was stripped. Exit status: 0 done, 1 a\n"
        "tick came out differently (nothing is written), 2 bad input.");
}

void add_branch(CLI::App& app, BranchOptions& branch, std::vector<std::string>& assignments) {
    CLI::App& command = *app.add_subcommand(
        "branch", "What if: let another script, or other parameters, take over in a recorded run");
    command.add_option("trace", branch.trace, "The trace")->required()->type_name("T.mcap");
    command.add_option("--at", branch.at, "The last tick of what was, or time such as 12.5 or 12s")
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
    command.footer(
        "The run is simulated again up to that tick, and every tick compared with the trace; then\n"
        "each script goes on in a process of its own. Traffic, walkers, contacts and random "
        "streams\n"
        "are in their true state. Exit status: 0 all checks passed, 1 one failed, or the run came\n"
        "out differently, 2 bad input.\n"
        "Examples: reprise branch a.mcap --at 12.5 --script brake.lua swerve.lua -o what_if\n"
        "          reprise branch a.mcap --at 12.5 --set distance=10 -o closer.mcap");
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
    add_level(command, run.level, {"full", "keyed", "core", "inputs"});
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

void add_render(CLI::App& app,
                RenderOptions& render,
                std::string& size,
                std::string& mount,
                std::string& threads) {
    CLI::App& command = *app.add_subcommand("render", "Render what cameras saw, from a trace");
    command.add_option("trace", render.trace, "The trace")->required()->type_name("T.mcap");
    command.add_option("-o,--output", render.directory, "Folder for the pictures")
        ->required()
        ->type_name("DIR");
    command
        .add_option("--weather",
                    render.weather,
                    "Another weather than recorded: " + joined(world::weather_names()))
        ->type_name("NAME")
        ->check(one_of(world::weather_names(), "weather"));
    command
        .add_option("--camera",
                    render.cameras,
                    "rgb (default), depth, semantic; several by commas, each into its own folder")
        ->type_name("KIND")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter(',')
        ->check(one_of({"rgb", "depth", "semantic"}, "camera"));
    command.add_option("--size", size, "Of the pictures (default 800x600)")->type_name("WxH");
    command.add_option("--fov", render.fov_deg, "Horizontal field of view (default 90)")
        ->type_name("DEGREES")
        ->check(CLI::Range(1.0, 170.0));
    command.add_option("--from", render.from, "First tick, or time such as 2.5s")
        ->type_name("TICK");
    command.add_option("--to", render.to, "Last tick, or time")->type_name("TICK");
    command.add_option("--every", render.every, "Every so many ticks, or time (default 1s)")
        ->type_name("N");
    command
        .add_option(
            "--actor", render.actor, "The vehicle that carries the camera (default: the first)")
        ->type_name("ID");
    command
        .add_option(
            "--mount", mount, "Place on it: ahead of the rear axle, left, up (default 1,0,1.4)")
        ->type_name("X,Y,Z");
    command.add_option("--pitch", render.pitch_deg, "Camera up by this (default 0)")
        ->type_name("DEGREES");
    command.add_option("--yaw", render.yaw_deg, "Camera left by this (default 0)")
        ->type_name("DEGREES");
    command
        .add_option("--threads",
                    threads,
                    "How many work on a picture (default: all cores); the bytes stay the same")
        ->type_name("N");
    command.add_flag(
        "--portable",
        render.portable,
        "Make pictures whose bytes are the same on every x86-64 CPU (depth and semantic take "
        "twice as long, rgb 10 to 20 % longer)");
    command.footer(
        "Pictures are named by tick: DIR/000120.png. depth: 16-bit, millimetres; semantic: 8-bit\n"
        "class ids (CARLA 0.9.14); DIR/view/ holds versions of these two for people to look at.\n"
        "Example: reprise render a.mcap -o rain --weather hard_rain_sunset --every 20");
}

void add_diff(CLI::App& app, DiffOptions& diff) {
    CLI::App& command = *app.add_subcommand("diff", "Find the first difference of two traces");
    command.add_option("expected", diff.expected, "A trace")->required()->type_name("A.mcap");
    command.add_option("found", diff.found, "Another trace")->required()->type_name("B.mcap");
    command
        .add_option("--tolerance",
                    diff.tolerance,
                    "For traces of different builds: how far recorded reals may be apart, in their "
                    "unit; of those larger than 1, as a share. Digests do not count then; events, "
                    "ids, texts and verdicts must be equal")
        ->type_name("T")
        ->check(CLI::Validator(
            [](std::string& text) -> std::string {
                char* end = nullptr;
                const double bound = std::strtod(text.c_str(), &end);
                return end != text.c_str() && *end == '\0' && bound >= 0 && bound <= 1e6
                           ? ""
                           : "expected a number of 0 or more such as 1e-6, got '" + text + "'";
            },
            ""));
    command.add_flag("--json", diff.json, "For programs: one JSON object");
    command.add_flag("--all", diff.all, "Every field in which the first differing tick differs");
    command.footer("Exit status: 0 equal (within the tolerance), 1 different, 2 bad input.");
}

void add_recover(CLI::App& app, RecoverOptions& recover) {
    CLI::App& command = *app.add_subcommand(
        "recover", "Make a whole trace of what a crash, a full disk or damage left of one");
    command
        .add_option("damaged", recover.damaged, "What is left, such as a.mcap.partial; only read")
        ->required()
        ->type_name("IN");
    command.add_option("-o,--output", recover.output, "Where the whole trace goes")
        ->required()
        ->type_name("OUT.mcap");
    command.footer(
        "Keeps every tick up to the first that is not sound; a running simulation writes whole\n"
        "chunks of 64 ticks. Exit status: 0 nothing was lost, 1 nothing can be recovered,\n"
        "2 bad input, 3 recovered with loss.\n"
        "Example: reprise recover a.mcap.partial -o a.mcap");
}

/// CLI11 would only say that a command is missing.
void check_command(const CLI::App& app, const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    if (word.empty() || word.starts_with('-') ||
        std::find(names.begin(), names.end(), word) != names.end())
        return;
    throw CLI::ExtrasError("no command '" + word + "'" + world::did_you_mean(word, names) +
                               "; there are " + joined(names),
                           CLI::ExitCodes::ExtrasError);
}

std::pair<std::string, std::string> split_assignment(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
        throw CLI::ValidationError("--set", "expected KEY=VALUE, got '" + text + "'");
    return {text.substr(0, equals), text.substr(equals + 1)};
}

void read_size(const std::string& text, RenderOptions& render) {
    int used = 0;
    const int found = std::sscanf(text.c_str(), "%dx%d%n", &render.width, &render.height, &used);
    if (found != 2 || used != static_cast<int>(text.size()) || render.width < 1 ||
        render.height < 1 || render.width > 16384 || render.height > 16384)
        throw CLI::ValidationError("--size",
                                   "expected WIDTHxHEIGHT such as 800x600, got '" + text + "'");
}

void read_threads(const std::string& text, RenderOptions& render) {
    constexpr int most = 1024;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, render.threads);
    if (error != std::errc() || stop != end || render.threads < 1 || render.threads > most)
        throw CLI::ValidationError("--threads",
                                   "expected a number of threads from 1 to " +
                                       std::to_string(most) + ", got '" + text + "'");
}

/// Each kind has one folder.
void check_cameras(const std::vector<std::string>& cameras) {
    for (auto camera = cameras.begin(); camera != cameras.end(); ++camera)
        if (std::find(cameras.begin(), camera, *camera) != camera)
            throw CLI::ValidationError("--camera", "'" + *camera + "' is there twice");
}

void read_mount(const std::string& text, RenderOptions& render) {
    int used = 0;
    std::vector<double>& at = render.mount;
    const int found = std::sscanf(text.c_str(), "%lf,%lf,%lf%n", &at[0], &at[1], &at[2], &used);
    if (found != 3 || used != static_cast<int>(text.size()))
        throw CLI::ValidationError("--mount", "expected X,Y,Z such as 1,0,1.4, got '" + text + "'");
}

}  // namespace

CommandLine::CommandLine() : app_(std::make_unique<App>()) {
    CLI::App& app = app_->app;
    app.require_subcommand(1);
    app.set_version_flag("--version", version_text());
    app.get_formatter()->column_width(28);
    // The last word counts, as in every shell alias.
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    add_run(app, run, app_->assignments);

    CLI::App& verify_command =
        *app.add_subcommand("verify", "Simulate a trace again and compare every tick");
    verify_command.add_option("trace", verify.trace, "The trace")->required()->type_name("T.mcap");
    verify_command.footer(
        "Needs nothing but the trace. Exit status: 0 equal at every tick, 1 differs, 2 bad input.");

    CLI::App& info_command = *app.add_subcommand("info", "Say what is in a trace");
    info_command.add_option("trace", info.trace, "The trace")->required()->type_name("T.mcap");
    info_command.add_flag(
        "--long", info.long_form, "All lines of the build; events of long traces, too");
    info_command.add_flag("--json", info.json, "For programs: one JSON object");

    add_diff(app, diff);
    add_recover(app, recover);
    add_strip(app, strip);
    add_expand(app, expand);
    add_branch(app, branch, app_->branch_assignments);
    add_render(app, render, app_->size, app_->mount, app_->threads);
    add_tool_commands(app, tools);
    add_town_commands(app, town);
    add_golden_commands(app, test, accept, golden_list, [&](CLI::App& to) {
        add_start(to, accept.start, app_->accept_assignments);
    });
}

std::optional<int> CommandLine::parse(int argc, char** argv) {
    CLI::App& app = app_->app;
    try {
        check_command(app, argc > 1 ? argv[1] : "");
        app.parse(argc, argv);
        for (const std::string& assignment : app_->assignments)
            run.parameters.push_back(split_assignment(assignment));
        for (const std::string& assignment : app_->branch_assignments)
            branch.parameters.push_back(split_assignment(assignment));
        for (const std::string& assignment : app_->accept_assignments)
            accept.start.parameters.push_back(split_assignment(assignment));
        read_size(app_->size, render);
        if (!app_->mount.empty())
            read_mount(app_->mount, render);
        if (app.get_subcommand("render")->count("--threads") > 0)
            read_threads(app_->threads, render);
        check_cameras(render.cameras);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0)
            return app.exit(error);
        std::fprintf(stderr, "reprise: %s (reprise --help says more)\n", error.what());
        return 2;
    }
    command = app.get_subcommands().front()->get_name();
    if (render.cameras.empty())
        render.cameras = {"rgb"};
    return std::nullopt;
}

}  // namespace reprise::cli
