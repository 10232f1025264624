#include "cli/options/tool_options.h"

#include <CLI/CLI.hpp>

#include "cli/options/option_checks.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

CLI::App& add_command(CLI::App& app, const char* name, const char* help, std::string& trace) {
    CLI::App& command = *app.add_subcommand(name, help);
    command.add_option("trace", trace, "The trace")->required()->type_name("T.mcap");
    return command;
}

/// Accepts only these words, and suggests the nearest.
CLI::Validator word_of(std::vector<std::string> words) {
    return CLI::Validator(
        [words](std::string& word) -> std::string {
            if (std::find(words.begin(), words.end(), word) != words.end())
                return "";
            std::string all;
            for (const std::string& one : words)
                all += (all.empty() ? "" : ", ") + one;
            return "'" + word + "' is none of " + all + world::did_you_mean(word, words);
        },
        "");
}

void add_cat(CLI::App& app, CatOptions& cat) {
    CLI::App& command = add_command(app, "cat", "Print ticks as JSON lines or CSV", cat.trace);
    command.add_option("--topic", cat.topic, "tick or traffic (default: both)")
        ->type_name("TOPIC")
        ->check(word_of({"tick", "traffic"}));
    add_ticks(command, cat.ticks);
    add_actor(command, cat.actor);
    command
        .add_option("--fields",
                    cat.fields,
                    "Only these, by commas, such as vehicles.position.x,vehicles.lamps")
        ->type_name("F,...")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter(',');
    command
        .add_option("--format", cat.format, "jsonl (default) or csv; csv holds one list's fields")
        ->type_name("FORMAT")
        ->check(word_of({"jsonl", "csv"}));
    command.footer(
        "Tables (--format csv): --fields vehicles, measurements, cars, walkers, events, ...; of "
        "the "
        "whole\n"
        "trace: --fields lanes, --fields actors. Their headings name units.\n"
        "Reals have the fewest digits that read back the same; in JSON 64-bit numbers are in "
        "quotes.\n"
        "Example: reprise cat a.mcap --actor ego --fields vehicles.position --format csv | head");
}

void add_get(CLI::App& app, GetOptions& get) {
    CLI::App& command = add_command(app, "get", "Take a part out of a trace", get.trace);
    command
        .add_option("part",
                    get.part,
                    "scenario (Lua), episode, town, metadata (JSON), network (XML), tick.bfbs, "
                    "traffic.bfbs (FlatBuffers schemas)")
        ->required()
        ->type_name("PART");
    command.add_option("-o,--output", get.output, "Where it goes (default: the standard output)")
        ->type_name("FILE");
}

void add_stats(CLI::App& app, StatsOptions& stats) {
    CLI::App& command =
        add_command(app, "stats", "Say what the vehicles of a trace did", stats.trace);
    add_ticks(command, stats.ticks);
    add_actor(command, stats.actor);
    command.add_flag("--json", stats.json, "As JSON, SI units");
}

void add_score(CLI::App& app, ScoreOptions& score) {
    CLI::App& command = add_command(
        app, "score", "Say what those who drove did wrong, and score the drive", score.trace);
    add_actor(command, score.actor);
    command.add_flag("--json", score.json, "As JSON, SI units: every infraction, every factor");
    command.footer(
        "Infractions by the CARLA paper's rules, and by traffic's; kilometres between two of a "
        "kind;\n"
        "route completion; the driving scores of CARLA's Leaderboard. docs/scoring.md says what "
        "counts.\n"
        "Example: reprise score a.mcap --actor ego");
}

void add_slice(CLI::App& app, SliceOptions& slice) {
    CLI::App& command = add_command(app, "slice", "Cut some ticks out of a trace", slice.trace);
    command.add_option("--ticks", slice.ticks, "Which, such as 100..200, 2.5s.. or ..10s")
        ->required()
        ->type_name("A..B");
    command.add_option("-o,--output", slice.output, "Where the slice goes")
        ->required()
        ->type_name("S.mcap");
    command.footer(
        "A slice is a trace: it can be read, played and rendered, and knows the names and the rigs "
        "of "
        "those who were there before. Only one that begins at tick 1 can be verified.");
}

void add_merge(CLI::App& app, MergeOptions& merge) {
    CLI::App& command = *app.add_subcommand("merge", "Join slices of one run");
    command.add_option("traces", merge.traces, "The slices, in any order")
        ->required()
        ->type_name("S.mcap")
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("-o,--output", merge.output, "Where the result goes")
        ->required()
        ->type_name("T.mcap");
    command.footer("When no tick is missing, the run comes out as it was recorded, byte for byte.");
}

void add_query(CLI::App& app, QueryOptions& query) {
    CLI::App& command = add_command(app, "query", "Ask a trace in SQL", query.trace);
    command.add_option("sql", query.sql, "One select; without it, the tables and their columns")
        ->type_name("SQL");
    command.add_option("--format", query.format, "csv (default) or jsonl")
        ->type_name("FORMAT")
        ->check(word_of({"csv", "jsonl"}));
    command.footer(
        "The trace is read where the statement looks, not copied; a condition on tick reads only "
        "these.\n"
        "Example: reprise query a.mcap 'select tick, speed from measurements where speed > 10'");
}

void add_export(CLI::App& app, ExportOptions& options) {
    CLI::App& command =
        add_command(app, "export", "Write a trace for other programs", options.trace);
    command
        .add_option("--to",
                    options.format,
                    "csv (a folder with a file for each table), jsonl, or foxglove (an MCAP file "
                    "for Foxglove and Lichtblick)")
        ->required()
        ->type_name("FORMAT")
        ->check(word_of({"csv", "jsonl", "foxglove"}));
    command.add_option("-o,--output", options.output, "The file or folder to write")
        ->required()
        ->type_name("PATH");
    add_ticks(command, options.ticks);
    add_actor(command, options.actor);
    command
        .add_option("--every",
                    options.every,
                    "Every so many ticks, or time (default all; of foxglove's scenes 0.1s); what "
                    "happened between is left out")
        ->type_name("N");
    command
        .add_option("--images",
                    options.images,
                    "foxglove: pictures that reprise render made, and points (ply, pcd, bin)")
        ->type_name("DIR");
    command.footer(
        "Example: reprise export a.mcap --to csv -o tables\n"
        "         reprise export a.mcap --to foxglove -o a.foxglove.mcap --images noon");
}

void add_show(CLI::App& app, ShowOptions& options) {
    CLI::App& command =
        add_command(app, "show", "Make a page of a trace, to watch it in a browser", options.trace);
    command
        .add_option("-o,--output", options.output, "The page to write (default: beside the trace)")
        ->type_name("PAGE.html");
    add_ticks(command, options.ticks);
    command
        .add_option("--every",
                    options.every,
                    "Where everybody is, every so many ticks, or time; between, it is interpolated "
                    "(default all, fewer of runs that would make the page larger than 10 MB)")
        ->type_name("N");
    command.footer(
        "One file that needs no network: the town from above, a time slider, events, checks and "
        "plots.\n"
        "Example: reprise show a.mcap -o replay.html");
}

void add_log_import(CLI::App& app, ImportOptions& options) {
    CLI::App& command =
        *app.add_subcommand("import", "Make a trace of a recording of CARLA's recorder");
    command.add_option("log", options.log, "The recording")->required()->type_name("CARLA.log");
    command.add_option("-o,--output", options.output, "Where the trace goes")
        ->required()
        ->type_name("T.mcap");
    command
        .add_option("--town",
                    options.town,
                    "The map, as a SUMO network that netconvert made from its OpenDRIVE file "
                    "(default: a plain)")
        ->type_name("NET");
    command.add_option("--step", options.step_ms, "Of a tick (default 50)")
        ->type_name("MILLISECONDS");
    command.footer(
        "The trace holds poses only: it can be read, played and rendered, but not simulated "
        "again.\n"
        "Exit status: 0 done, 2 bad input, 3 the log ends early, and its whole frames were "
        "imported.\n"
        "Example: reprise import crash.log -o crash.mcap --town Town01.net.xml");
}

}  // namespace

void add_tool_commands(CLI::App& app, ToolOptions& tools) {
    add_cat(app, tools.cat);
    add_get(app, tools.get);
    add_stats(app, tools.stats);
    add_score(app, tools.score);
    add_slice(app, tools.slice);
    add_merge(app, tools.merge);
    add_query(app, tools.query);
    add_export(app, tools.export_to);
    add_show(app, tools.show);
    add_log_import(app, tools.import_from);
}

}  // namespace reprise::cli
