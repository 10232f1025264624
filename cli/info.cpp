#include "cli/info.h"

#include <fmt/format.h>

#include "cli/guard.h"
#include "cli/reproduce.h"
#include "replay/trace_reader.h"
#include "world/digest.h"
#include "world/tick.h"

namespace reprise::cli {

namespace {

void row(const std::string& key, const std::string& value) {
    fmt::print("  {:<12}{}\n", key, value);
}

void print_sizes(const replay::TraceReader& trace) {
    const double ticks = static_cast<double>(std::max<std::uint64_t>(trace.ticks(), 1));
    const double hours = ticks * static_cast<double>(trace.episode().step_ns) * 1e-9 / 3600;
    row("size",
        fmt::format("{:.2f} MB; a tick is {:.2f} kB, {:.2f} kB in the file; {:.0f} MB for an hour",
                    static_cast<double>(trace.file_size()) / 1e6,
                    static_cast<double>(trace.message_bytes()) / ticks / 1e3,
                    static_cast<double>(trace.file_size()) / ticks / 1e3,
                    static_cast<double>(trace.file_size()) / hours / 1e6));
}

}  // namespace

int info(const TraceOptions& options) {
    replay::TraceReader trace(options.trace);
    const world::EpisodeT& episode = trace.episode();
    const replay::Outcome& outcome = trace.outcome();
    fmt::print("{}\n", options.trace);
    row("scenario", fmt::format("{} ({})", episode.name, episode.scenario_path));
    row("town", episode.town);
    row("seed", std::to_string(episode.seed));
    row("traffic", fmt::format("{} cars", episode.cars));
    row("weather",
        fmt::format("{}, road friction {}", episode.weather_name, episode.road_friction));
    for (const world::ParameterT& parameter : episode.parameters)
        row("", parameter.key + " = " + parameter.value);
    row("length",
        fmt::format("{} ticks of {} ms = {:.2f} s",
                    trace.ticks(),
                    episode.step_ns / 1'000'000,
                    world::seconds(trace.ticks(), episode.step_ns)));
    row("outcome", outcome.verdict + (outcome.reason.empty() ? "" : ": " + outcome.reason));
    if (trace.ticks() > 0)
        row("chain", world::to_hex(trace.chain(trace.ticks())));
    print_sizes(trace);
    std::string build;
    for (const world::ParameterT& line : episode.fingerprint)
        build += (build.empty() ? "" : ", ") + line.key + " " + line.value;
    row("build", build);
    row("again", run_command(episode, episode.max_ticks));
    return exit_good;
}

}  // namespace reprise::cli
