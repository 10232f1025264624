#include "cli/trace/stats.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "cli/options/tick_range.h"
#include "cli/process/guard.h"
#include "cli/process/output.h"
#include "cli/process/say.h"
#include "cli/trace/level_note.h"
#include "replay/table/actor_search.h"
#include "replay/table/statistics.h"
#include "replay/table/value.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

using replay::TraceStatistics;
using replay::VehicleStatistics;

double seconds(std::uint64_t ticks, std::uint64_t step_ns) {
    return static_cast<double>(ticks * step_ns) / 1e9;
}

/// "96 to 100, 99.2 on average" or "100 throughout".
std::string range_text(const replay::CountRange& range) {
    if (range.least == range.most)
        return fmt::format("{} throughout", range.most);
    return fmt::format("{} to {}, {:.1f} on average", range.least, range.most, range.mean);
}

void print_vehicle(const VehicleStatistics& one, std::uint64_t step_ns) {
    const auto row = [](const char* key, const std::string& value) {
        say("  {:<18}{}\n", key, value);
    };
    const auto share = [&](std::uint64_t ticks) {
        return fmt::format("{:.2f} s, {:.0f} %",
                           seconds(ticks, step_ns),
                           100.0 * static_cast<double>(ticks) / static_cast<double>(one.ticks));
    };
    say("\n{} ({}), {}, {:.2f} s\n",
        one.name.empty() ? "actor" : one.name,
        one.id,
        one.model,
        seconds(one.ticks, step_ns));
    row("distance", fmt::format("{:.1f} m", one.distance));
    row("speed",
        fmt::format("{:.2f} m/s on average ({:.1f} km/h), {:.2f} at most ({:.1f} km/h)",
                    one.mean_speed,
                    one.mean_speed * 3.6,
                    one.max_speed,
                    one.max_speed * 3.6));
    row("standing", share(one.standing));
    row("hard brakes",
        fmt::format("{} of {} m/s2 or more; hardest {}",
                    one.hard_brakes,
                    replay::hard_brake,
                    world::with_decimals(one.max_deceleration, 1)));
    row("least gap ahead",
        std::isfinite(one.least_gap) ? fmt::format("{:.2f} m, while driving", one.least_gap) : "-");
    row("collisions",
        one.collisions == 0
            ? "none"
            : fmt::format("{}; {} N s in all", one.collisions, world::with_thousands(one.impulse)));
    row("on opposite lane", share(one.on_opposite_lane));
    row("on the sidewalk", share(one.on_sidewalk));
}

void print_screen(const StatsOptions& options,
                  const replay::TraceReader& trace,
                  const TraceStatistics& all) {
    const std::uint64_t step_ns = trace.episode().step_ns;
    const auto row = [](const char* key, const std::string& value) {
        say("  {:<18}{}\n", key, value);
    };
    const auto ticks = static_cast<double>(std::max<std::uint64_t>(all.ticks, 1));
    const auto size = [&](std::uint64_t bytes) {
        return fmt::format("{:.2f} MB, {:.2f} kB a tick",
                           static_cast<double>(bytes) / 1e6,
                           static_cast<double>(bytes) / ticks / 1e3);
    };
    say("{}: {} in {}\n", options.trace, trace.episode().name, trace.episode().town);
    row("length",
        fmt::format(
            "{}, {:.2f} s", world::count_of(all.ticks, "tick"), seconds(all.ticks, step_ns)));
    if (all.traffic_ticks > 0) {
        row("cars", range_text(all.cars));
        row("walkers", range_text(all.walkers));
    }
    row("events",
        fmt::format("{}, collisions {}; commands {}", all.events, all.collisions, all.commands));
    row("/sim/tick", size(all.tick_bytes));
    row("/sim/traffic", size(all.traffic_bytes));
    row("the file", size(trace.file_size()));
    for (const VehicleStatistics& vehicle : all.vehicles)
        print_vehicle(vehicle, step_ns);
}

/// A flat JSON object, as the values come.
class JsonObject {
  public:
    explicit JsonObject(std::string& out) : out_(out) { out_ += '{'; }

    ~JsonObject() { out_ += '}'; }

    JsonObject(const JsonObject&) = delete;
    JsonObject& operator=(const JsonObject&) = delete;

    std::string& key(const char* name) {
        out_.append(first_ ? "\"" : ",\"").append(name).append("\":");
        first_ = false;
        return out_;
    }

    void add(const char* name, const replay::Value& value) {
        replay::append_json(value, key(name));
    }

  private:
    std::string& out_;
    bool first_ = true;
};

void append_range(const replay::CountRange& range, std::string& out) {
    JsonObject object(out);
    object.add("least", static_cast<std::int64_t>(range.least));
    object.add("most", static_cast<std::int64_t>(range.most));
    object.add("mean", range.mean);
}

void append_vehicle(const VehicleStatistics& one, std::uint64_t step_ns, std::string& out) {
    JsonObject object(out);
    object.add("id", std::int64_t{one.id});
    object.add("name", one.name);
    object.add("model", one.model);
    object.add("seconds", seconds(one.ticks, step_ns));
    object.add("distance", one.distance);
    object.add("mean_speed", one.mean_speed);
    object.add("max_speed", one.max_speed);
    object.add("standing_seconds", seconds(one.standing, step_ns));
    object.add("hard_brakes", static_cast<std::int64_t>(one.hard_brakes));
    object.add("max_deceleration", one.max_deceleration);
    object.add("collisions", static_cast<std::int64_t>(one.collisions));
    object.add("impulse", one.impulse);
    object.add("on_opposite_lane_seconds", seconds(one.on_opposite_lane, step_ns));
    object.add("on_sidewalk_seconds", seconds(one.on_sidewalk, step_ns));
    object.add("least_gap",
               std::isfinite(one.least_gap) ? replay::Value(one.least_gap) : replay::Value());
}

std::string to_json(const replay::TraceReader& trace, const TraceStatistics& all) {
    const std::uint64_t step_ns = trace.episode().step_ns;
    std::string out;
    {
        JsonObject object(out);
        object.add("ticks", all.ticks);
        object.add("seconds", seconds(all.ticks, step_ns));
        if (all.traffic_ticks > 0) {
            append_range(all.cars, object.key("cars"));
            append_range(all.walkers, object.key("walkers"));
        }
        object.add("events", all.events);
        object.add("commands", all.commands);
        object.add("collisions", all.collisions);
        object.add("tick_bytes", all.tick_bytes);
        object.add("traffic_bytes", all.traffic_bytes);
        object.add("file_bytes", trace.file_size());
        object.key("vehicles") += '[';
        for (const VehicleStatistics& vehicle : all.vehicles) {
            if (&vehicle != &all.vehicles.front())
                out += ',';
            append_vehicle(vehicle, step_ns, out);
        }
        out += ']';
    }
    return out + "\n";
}

}  // namespace

int stats(const StatsOptions& options) {
    end_quietly_when_nobody_reads();
    replay::TraceReader trace(options.trace);
    const TickRange range = parse_ticks("--ticks", options.ticks, trace);
    std::optional<std::uint32_t> actor;
    if (!options.actor.empty())
        actor = replay::find_actor(trace, options.actor);
    TraceStatistics all = replay::statistics(trace, range.first, range.last);
    if (actor)
        std::erase_if(all.vehicles, [&](const auto& vehicle) { return vehicle.id != *actor; });
    print_level_note(trace);
    if (options.json)
        say_lines(to_json(trace, all));
    else
        print_screen(options, trace, all);
    return exit_good;
}

}  // namespace reprise::cli
