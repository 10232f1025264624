#include "cli/trace/cat.h"

#include <algorithm>
#include <optional>
#include <unistd.h>

#include "cli/options/tick_range.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/trace/level_note.h"
#include "replay/table/actor_search.h"
#include "replay/table/json_lines.h"
#include "replay/table/kept.h"
#include "replay/table/table.h"
#include "replay/table/trace_parts.h"
#include "replay/table/whole_tables.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::cli {

namespace {

/// The tables that these options ask for; none: whatever is there.
std::vector<std::string> asked_tables(const CatOptions& options) {
    std::vector<std::string> tables;
    for (const std::string& field : options.fields)
        tables.push_back(replay::table_of({{field}, {}}));
    if (tables.empty() && options.topic == "traffic")
        tables.emplace_back("cars");
    if (!options.actor.empty())
        tables.emplace_back("vehicles");  // who is who
    return tables;
}

/// The table of no ticks that is asked for: lanes or actors.
std::optional<std::string> whole_table(const CatOptions& options) {
    const auto& names = replay::whole_table_names();
    for (const std::string& field : options.fields)
        if (std::find(names.begin(), names.end(), field) != names.end())
            return field;
    return std::nullopt;
}

int print_whole_table(const std::string& name,
                      const CatOptions& options,
                      replay::TraceReader& trace) {
    if (options.fields.size() > 1 || options.format != "csv" || !options.ticks.empty() ||
        !options.actor.empty())
        throw world::Error("--fields " + name +
                           ": a table of the whole trace: alone, with --format csv, without "
                           "--ticks and --actor");
    Output output("-");
    output.text = to_csv(read_whole_table(trace, name));
    output.finish();
    return exit_good;
}

/// Refuses what the trace's level leaves out, and says where it leaves out some.
void check_level(const CatOptions& options, const replay::TraceReader& trace) {
    const std::vector<std::string> tables = asked_tables(options);
    bool whole =
        !tables.empty() || (options.topic == "tick" && trace.level() != replay::Level::inputs);
    for (const std::string& table : tables) {
        require_kept(trace, table);
        whole = whole && kept(trace.level(), table) == replay::Kept::all;
    }
    if (!whole)
        print_level_note(trace);
}

}  // namespace

int cat(const CatOptions& options) {
    end_quietly_when_nobody_reads();
    replay::TraceReader trace(options.trace);
    if (const auto table = whole_table(options))
        return print_whole_table(*table, options, trace);
    const TickRange range = parse_ticks("--ticks", options.ticks, trace);
    check_level(options, trace);
    replay::Selection selection{options.fields, {}};
    if (!options.actor.empty())
        selection.actor = replay::find_actor(trace, options.actor);
    const std::uint64_t step_ns = trace.episode().step_ns;
    Output output("-");
    if (options.format == "csv") {
        world::ActorNames names;
        const replay::Table table(
            replay::table_of(selection), selection, step_ns, {&trace.recording().town, &names});
        append_csv_header(table, output.text);
        for (std::uint64_t index = trace.first(); index <= range.last; ++index) {
            const replay::RecordedTick tick = trace.recorded(index);
            names.hear(tick.view);
            if (index < range.first)
                continue;
            append_csv(table, tick, output.text);
            output.flush_if_large();
        }
    } else {
        const replay::JsonLines lines(selection, step_ns);
        for (std::uint64_t index = range.first; index <= range.last; ++index) {
            const replay::RecordedTick tick = trace.recorded(index);
            if (options.topic != "traffic")
                lines.append_tick(tick, output.text);
            if (options.topic != "tick")
                lines.append_traffic(tick, output.text);
            output.flush_if_large();
        }
    }
    output.finish();
    return exit_good;
}

int get(const GetOptions& options) {
    end_quietly_when_nobody_reads();
    if (!options.output.empty())
        refuse_overwriting(options.trace, options.output);
    const replay::mcap::Bytes bytes = replay::read_part(options.trace, options.part);
    if (options.output.empty() && options.part.ends_with(".bfbs") && isatty(STDOUT_FILENO) != 0)
        throw world::Error(options.part + " is binary: give -o FILE, or send it to a pipe");
    Output output(options.output);
    output.text.assign(bytes.begin(), bytes.end());
    if (options.output.empty() && isatty(STDOUT_FILENO) != 0)
        output.text = world::printable_lines(output.text);
    output.finish();
    return exit_good;
}

}  // namespace reprise::cli
