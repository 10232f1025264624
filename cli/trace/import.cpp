#include "cli/trace/import.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "cli/fingerprint/this_build.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/progress.h"
#include "cli/process/say.h"
#include "cli/town/towns.h"
#include "exchange/carla/carla_import.h"
#include "exchange/carla/carla_packet_kinds.h"
#include "files/output_place.h"
#include "kernel/pedestrians.h"
#include "replay/mcap/files.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/story/wording.h"
#include "world/tick.h"

namespace reprise::cli {

namespace {

namespace fs = std::filesystem;

void row(const std::string& key, const std::string& value) {
    say("  {:<10}{}\n", key, value);
}

std::uint64_t step_ns(const ImportOptions& options) {
    const auto step = static_cast<std::uint64_t>(std::llround(options.step_ms));
    if (options.step_ms < 1 || options.step_ms > 1000 ||
        std::abs(options.step_ms - static_cast<double>(step)) > 1e-9)
        throw world::Error(
            fmt::format("--step {}: expected whole milliseconds from 1 to 1000", options.step_ms));
    return step * 1'000'000;
}

std::optional<exchange::CarlaTown> read_town(const ImportOptions& options) {
    if (options.town.empty())
        return std::nullopt;
    towns::Network network = load_town(options.town, options.log);
    if (!network.notes.empty())
        say_lines(network.notes, stderr);
    exchange::CarlaTown town;
    town.town = towns::read_town(network);
    town.path = options.town;
    town.network = std::move(network.xml);
    return town;
}

void print_signals(const exchange::CarlaReport& report, bool has_town) {
    if (report.lights == 0)
        return;
    if (!has_town)
        row("left out", fmt::format("{} traffic lights: they need a --town", report.lights));
    else
        row("signals",
            fmt::format("{} of the town's {} show the nearest of {} traffic lights",
                        report.matched,
                        report.signals,
                        report.lights));
}

void print_skipped(const exchange::CarlaReport& report) {
    std::string text;
    for (const auto& [id, count] : report.skipped)
        text += fmt::format(
            "{}{} {}", text.empty() ? "" : ", ", count, exchange::carla_packet_name(id));
    if (!text.empty())
        row("left out", "packets: " + text);
}

void print_report(const ImportOptions& options, const exchange::CarlaReport& report) {
    constexpr double hilly = 1;  // [m]
    say("{}: {} of {} ms ({:.2f} s, {:.2f} MB)\n",
        options.output,
        world::count_of(report.ticks, "tick"),
        options.step_ms,
        world::seconds(report.ticks, step_ns(options)),
        static_cast<double>(fs::file_size(options.output)) / 1e6);
    row("from", report.source);
    row("holds",
        fmt::format("poses only, interpolated between {}: {}, {}",
                    world::count_of(report.frames, "frame"),
                    world::count_of(report.vehicles, "vehicle"),
                    world::count_of(report.walkers, "walker")));
    const char* key = "guessed";
    for (const std::string& guess : report.guessed) {
        row(key, guess);
        key = "";
    }
    if (report.jumps > 0)
        row("jumps", fmt::format("{}: an actor was put somewhere else", report.jumps));
    if (options.town.empty() && report.high - report.low > hilly)
        row("ground",
            fmt::format("a plain, but they were at {:.1f} to {:.1f} m: give the map as --town",
                        report.low,
                        report.high));
    print_signals(report, !options.town.empty());
    print_skipped(report);
    if (report.damage)
        row("lost",
            fmt::format("{} behind the last whole frame; byte {}: {}",
                        world::count_of(report.lost, "byte"),
                        report.damage->offset,
                        report.damage->what));
}

}  // namespace

int import_log(const ImportOptions& options) {
    const std::uint64_t step = step_ns(options);
    files::output_target(options.output, "the trace");
    refuse_overwriting(options.log, options.output);
    const replay::InputFile file(options.log, "CARLA recorder log");
    Progress progress("importing", "bytes", 2 * file.size());
    exchange::CarlaImportOptions wanted;
    wanted.name = fs::path(options.log).filename().string();
    wanted.town = read_town(options);
    wanted.timing = {step, kernel::walk_cycle_length};
    wanted.fingerprint = this_build();
    wanted.progress = [&](std::uint64_t bytes) { progress.update(bytes); };
    const exchange::CarlaReport report = exchange::import_carla(
        {options.log,
         file.size(),
         [&](std::uint64_t offset, std::span<std::uint8_t> out) { file.read(offset, out); }},
        wanted,
        options.output);
    progress.clear();
    print_report(options, report);
    return report.damage ? exit_with_loss : exit_good;
}

}  // namespace reprise::cli
