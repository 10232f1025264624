#include "cli/trace/export.h"

#include <cstdio>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "cli/options/tick_option.h"
#include "cli/options/tick_range.h"
#include "cli/process/guard.h"
#include "cli/process/new_folder.h"
#include "cli/process/output.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "cli/trace/level_note.h"
#include "exchange/foxglove.h"
#include "replay/table/actor_search.h"
#include "replay/table/json_lines.h"
#include "replay/table/kept.h"
#include "replay/table/table.h"
#include "replay/table/whole_tables.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;

/// A table on its way into its file.
struct TableFile {
    replay::Table table;
    std::unique_ptr<Output> output;
};

using Actor = std::optional<std::uint32_t>;  ///< nobody: all

/// Lanes and actors; of one actor its row.
void export_whole_tables(replay::TraceReader& trace, const Actor& actor, const fs::path& folder) {
    for (const std::string& name : replay::whole_table_names()) {
        replay::WholeTable table = read_whole_table(trace, name);
        if (actor && name == "actors")
            std::erase_if(table.rows, [&](const std::vector<replay::Value>& row) {
                return row.front() != replay::Value(std::int64_t{*actor});
            });
        Output output((folder / (name + ".csv")).string());
        output.text = to_csv(table);
        output.finish();
    }
}

/// Files of those tables of which the trace has anything; of one actor those that tell of actors.
void export_csv(replay::TraceReader& trace,
                const TickRange& range,
                std::uint64_t every,
                const Actor& actor,
                const fs::path& folder) {
    NewFolder made(folder);
    export_whole_tables(trace, actor, folder);
    world::ActorNames names;
    std::vector<TableFile> files;
    for (const std::string& name : replay::Table::names()) {
        if (kept(trace.level(), name) == replay::Kept::nothing ||
            (actor && !replay::Table::has_actors(name)))
            continue;
        TableFile file{
            replay::Table(
                name, {{}, actor}, trace.episode().step_ns, {&trace.recording().town, &names}),
            std::make_unique<Output>((folder / (name + ".csv")).string())};
        append_csv_header(file.table, file.output->text);
        files.push_back(std::move(file));
    }
    Progress progress("exporting", "ticks", range.last);
    for (std::uint64_t index = trace.first(); index <= range.last; ++index) {
        const replay::RecordedTick tick = trace.recorded(index);
        names.hear(tick.view);
        if (index < range.first || (index - range.first) % every != 0)
            continue;
        for (const TableFile& file : files) {
            append_csv(file.table, tick, file.output->text);
            file.output->flush_if_large();
        }
        progress.update(index);
    }
    progress.clear();
    for (const TableFile& file : files)
        file.output->finish();
    made.keep();
}

void export_jsonl(replay::TraceReader& trace,
                  const TickRange& range,
                  std::uint64_t every,
                  const Actor& actor,
                  const std::string& path) {
    const replay::JsonLines lines({{}, actor}, trace.episode().step_ns);
    Output output(path);
    for (std::uint64_t index = range.first; index <= range.last; index += every) {
        const replay::RecordedTick tick = trace.recorded(index);
        lines.append_tick(tick, output.text);
        lines.append_traffic(tick, output.text);
        output.flush_if_large();
    }
    output.finish();
}

void export_foxglove(replay::TraceReader& trace,
                     const TickRange& range,
                     std::uint64_t every,
                     const ExportOptions& options) {
    const exchange::FoxgloveOptions wanted{range.first, range.last, every, options.images};
    const auto done = exchange::export_foxglove(trace, wanted, options.output);
    say(stderr,
        "{}: {}, {}{}{}\n",
        options.output,
        world::count_of(done.messages, "message"),
        world::count_of(done.images, "picture among them", "pictures among them"),
        done.clouds == 0 ? "" : " and " + world::count_of(done.clouds, "point cloud"),
        done.located ? "" : "; no /location: the road network lies nowhere on the globe");
}

/// Every so many ticks; unless said, all of them, and scenes ten times a second.
std::uint64_t interval(const ExportOptions& options, std::uint64_t step_ns) {
    const std::string usual = options.format == "foxglove" ? "0.1s" : "1";
    const std::string& text = options.every.empty() ? usual : options.every;
    const std::uint64_t every = parse_tick("--every", text, step_ns, 1);
    if (every < 1)
        throw world::Error("--every: expected 1 tick at least, got '" + text + "'");
    return every;
}

}  // namespace

int export_trace(const ExportOptions& options) {
    refuse_overwriting(options.trace, options.output);
    if (options.format != "foxglove" && !options.images.empty())
        throw world::Error("--images: only --to foxglove takes pictures");
    if (options.format == "foxglove" && !options.actor.empty())
        throw world::Error("--actor: only of --to csv and --to jsonl; scenes show everybody");
    replay::TraceReader trace(options.trace);
    const TickRange range = parse_ticks("--ticks", options.ticks, trace);
    const std::uint64_t every = interval(options, trace.episode().step_ns);
    if (options.format == "foxglove") {
        export_foxglove(trace, range, every, options);
        return exit_good;
    }
    Actor actor;
    if (!options.actor.empty())
        actor = replay::find_actor(trace, options.actor);
    print_level_note(trace);
    if (options.format == "csv")
        export_csv(trace, range, every, actor, options.output);
    else
        export_jsonl(trace, range, every, actor, options.output);
    say(stderr,
        "{}: {}\n",
        options.output,
        world::count_of((range.last - range.first) / every + 1, "tick"));
    return exit_good;
}

}  // namespace reprise::cli
