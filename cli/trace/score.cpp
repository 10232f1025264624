#include "cli/trace/score.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/process/guard.h"
#include "cli/process/say.h"
#include "replay/score/driving_score.h"
#include "replay/score/score.h"
#include "replay/table/actor_search.h"
#include "world/check.h"
#include "world/story/crashes.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

using replay::DrivingScore;
using replay::Infraction;
using replay::InfractionKind;
using replay::Leaderboard;
using replay::VehicleScore;

/// What words about a trace need.
struct ScoreContext {
    const world::TownT& town;
    const world::ActorNames& names;
    std::uint64_t step_ns;

    double seconds(std::uint64_t tick) const { return static_cast<double>(tick * step_ns) / 1e9; }

    std::string lane(const Infraction& infraction) const {
        return infraction.lane < town.lanes.size() ? town.lanes[infraction.lane].name : "";
    }
};

/// "12,246 N s with van"; "61 % of its footprint"; "12.3 km/h above the limit".
std::string how_bad(const Infraction& infraction, const ScoreContext& context) {
    const auto kmh = [&] { return world::with_decimals(infraction.worst * 3.6, 1); };
    switch (infraction.kind) {
        case InfractionKind::collision_vehicle:
        case InfractionKind::collision_pedestrian:
        case InfractionKind::collision_static:
            return fmt::format("{} N s with {}",
                               world::with_thousands(infraction.worst),
                               context.names.name_of(infraction.other));
        case InfractionKind::opposite_lane:
        case InfractionKind::sidewalk:
            return fmt::format("{:.0f} % of its footprint", 100 * infraction.worst);
        case InfractionKind::red_light:
        case InfractionKind::stop_sign:
            return fmt::format("{} km/h at the line", kmh());
        case InfractionKind::speeding:
            return fmt::format("{} km/h above the limit", kmh());
        case InfractionKind::wrong_way:
        case InfractionKind::off_road:
            return fmt::format("{:.1f} m", infraction.worst);
        case InfractionKind::blocked:
            return fmt::format("stood {:.0f} s", infraction.worst);
    }
    return "";
}

/// "at 3.20 s on d1_d2_0, for 10.00 s"
std::string when_and_where(const Infraction& infraction, const ScoreContext& context) {
    std::string text = fmt::format("at {:.2f} s", context.seconds(infraction.first));
    if (const std::string lane = context.lane(infraction); !lane.empty())
        text += " on " + lane;
    if (infraction.last > infraction.first)
        text +=
            fmt::format(", for {:.2f} s", context.seconds(infraction.last - infraction.first + 1));
    return text;
}

/// [km] between two of a kind; of none all that was driven, which it is more than.
std::string km_between(const VehicleScore& vehicle, std::uint64_t count) {
    const double km = vehicle.driven / 1000;
    return count == 0 ? fmt::format("> {:.2f}", km)
                      : fmt::format("{:.2f}", km / static_cast<double>(count));
}

void print_infractions(const VehicleScore& vehicle, const ScoreContext& context) {
    say("  {:<24}{:>7}{:>12}   {}\n", "infractions", "count", "km between", "the worst");
    for (const InfractionKind kind : replay::all_infractions()) {
        const std::uint64_t count = vehicle.count(kind, context.step_ns);
        const Infraction* worst = vehicle.worst(kind);
        say("  {:<24}{:>7}{:>12}{}\n",
            title_of(kind),
            count == 0 ? "-" : std::to_string(count),
            km_between(vehicle, count),
            worst == nullptr
                ? std::string()
                : "   " + how_bad(*worst, context) + ", " + when_and_where(*worst, context));
    }
}

/// "0.60 (1 vehicle) x 0.49 (2 red lights)"; of the newer one "1 / (1 + 0.70 (1 vehicle))".
std::string factors_text(const DrivingScore& score, Leaderboard leaderboard) {
    std::string text;
    for (const DrivingScore::Factor& factor : score.factors) {
        if (factor.count == 0)
            continue;
        text += text.empty() ? "" : leaderboard == Leaderboard::additive ? " + " : " x ";
        text +=
            fmt::format("{:.2f} ({})", factor.value, world::count_of(factor.count, factor.what));
    }
    if (text.empty())
        return "1, nothing of its list";
    return leaderboard == Leaderboard::additive ? fmt::format("1 / (1 + {})", text) : text;
}

void print_leaderboard(const VehicleScore& vehicle,
                       const ScoreContext& context,
                       Leaderboard leaderboard) {
    std::optional<double> completion;
    if (vehicle.route)
        completion = vehicle.route->counted();
    const DrivingScore score =
        driving_score(leaderboard, leaderboard_counts(vehicle, context.step_ns), completion);
    std::string made_of =
        completion ? fmt::format("{:.1f} % of the route x ", 100 * *completion) : "no route; ";
    if (score.off_lane > 0)
        made_of += fmt::format(
            "{:.3f} ({:.1f} % off its lanes) x ", 1 - score.off_lane, 100 * score.off_lane);
    say("  {:<24}{:>7}   {}{}\n",
        leaderboard == Leaderboard::additive ? "Leaderboard 2.1" : "Leaderboard 1.0, 2.0",
        score.score ? fmt::format("{:.1f}", *score.score) : "-",
        made_of,
        factors_text(score, leaderboard));
}

void print_vehicle_score(const VehicleScore& vehicle, const ScoreContext& context) {
    say("{} ({}), {}: {} m in {:.2f} s\n",
        vehicle.name.empty() ? "actor" : vehicle.name,
        vehicle.id,
        vehicle.model,
        world::with_thousands(vehicle.driven),
        context.seconds(vehicle.ticks));
    print_infractions(vehicle, context);
    std::string way = "it was told no route";
    if (vehicle.route) {
        way = fmt::format("% of {} m", world::with_thousands(vehicle.route->length));
        if (vehicle.route->arrived_at != 0)
            way += fmt::format(", arrived at {:.2f} s", context.seconds(vehicle.route->arrived_at));
    }
    if (vehicle.ended) {
        way += fmt::format("; ended at {:.2f} s: it stood for three minutes",
                           context.seconds(vehicle.ended->tick));
    }
    say("\n  {:<24}{:>7}   {}\n",
        "route completion",
        vehicle.route ? fmt::format("{:.1f}", 100 * vehicle.route->completion) : "-",
        way);
    print_leaderboard(vehicle, context, Leaderboard::multiplicative);
    print_leaderboard(vehicle, context, Leaderboard::additive);
}

using Json = nlohmann::ordered_json;

Json json_of(const Infraction& infraction, const ScoreContext& context) {
    return {{"kind", name_of(infraction.kind)},
            {"first_tick", std::to_string(infraction.first)},
            {"last_tick", std::to_string(infraction.last)},
            {"seconds", context.seconds(infraction.first)},
            {"count", count_of(infraction, context.step_ns)},
            {"worst", infraction.worst},
            {"lane", context.lane(infraction)},
            {"x", infraction.position.x()},
            {"y", infraction.position.y()},
            {"z", infraction.position.z()},
            {"other", infraction.other}};
}

Json json_of(const DrivingScore& score) {
    const auto number = [](const std::optional<double>& value) {
        return value ? Json(*value) : Json();
    };
    Json factors = Json::array();
    for (const DrivingScore::Factor& factor : score.factors)
        factors.push_back({{"what", factor.what},
                           {"count", factor.count},
                           {"each", factor.each},
                           {"value", factor.value}});
    return {{"score", number(score.score)},
            {"completion", number(score.completion)},
            {"penalty", score.penalty},
            {"off_lane", score.off_lane},
            {"factors", factors}};
}

Json json_of(const VehicleScore& vehicle, const ScoreContext& context) {
    Json kinds = Json::object();
    for (const InfractionKind kind : replay::all_infractions()) {
        const std::uint64_t count = vehicle.count(kind, context.step_ns);
        kinds[name_of(kind)] = {
            {"count", count},
            {"episodes", vehicle.episodes(kind)},
            {"km_between",
             count == 0 ? Json() : Json(vehicle.driven / 1000 / static_cast<double>(count))}};
    }
    Json all = Json::array();
    for (const Infraction& infraction : vehicle.infractions)
        all.push_back(json_of(infraction, context));
    std::optional<double> completion;
    Json route;
    if (vehicle.route) {
        completion = vehicle.route->counted();
        route = {
            {"length", vehicle.route->length},
            {"completion", vehicle.route->completion},
            {"told_at_tick", std::to_string(vehicle.route->told_at)},
            {"arrived_at_tick",
             vehicle.route->arrived_at == 0 ? Json()
                                            : Json(std::to_string(vehicle.route->arrived_at))}};
    }
    const auto counts = leaderboard_counts(vehicle, context.step_ns);
    return {{"id", vehicle.id},
            {"name", vehicle.name},
            {"model", vehicle.model},
            {"seconds", context.seconds(vehicle.ticks)},
            {"driven", vehicle.driven},
            {"off_lane", vehicle.off_lane},
            {"ended_at_tick", vehicle.ended ? Json(std::to_string(vehicle.ended->tick)) : Json()},
            {"route", route},
            {"kinds", kinds},
            {"infractions", all},
            {"leaderboard_1_2",
             json_of(driving_score(Leaderboard::multiplicative, counts, completion))},
            {"leaderboard_2_1", json_of(driving_score(Leaderboard::additive, counts, completion))}};
}

/// Who is who, of the whole trace.
world::ActorNames names_in(replay::TraceReader& trace) {
    world::ActorNames names;
    if (const auto slice = trace.slice())
        for (const auto& [id, spawn] : slice->spawns)
            names.know(id, spawn.command.text);
    for (std::uint64_t index = trace.first(); index <= trace.last(); ++index)
        names.hear(trace.recorded(index).view);
    return names;
}

}  // namespace

int score(const ScoreOptions& options) {
    replay::TraceReader trace(options.trace);
    std::optional<std::uint32_t> actor;
    if (!options.actor.empty())
        actor = replay::find_actor(trace, options.actor);
    const std::vector<VehicleScore> scores = replay::score(trace, actor);
    if (scores.empty() && actor)
        throw world::Error("--actor " + options.actor +
                           ": only who drives with mass (autopilot, manual, external) is scored");
    const world::ActorNames names = names_in(trace);
    const ScoreContext context{trace.recording().town, names, trace.episode().step_ns};
    if (options.json) {
        Json vehicles = Json::array();
        for (const VehicleScore& vehicle : scores)
            vehicles.push_back(json_of(vehicle, context));
        const Json out{{"trace", options.trace}, {"vehicles", vehicles}};
        say_lines(out.dump(2, ' ', true, Json::error_handler_t::replace) + "\n");
        return exit_good;
    }
    if (scores.empty())
        say("{}: nobody drives with mass in it\n", options.trace);
    for (const VehicleScore& vehicle : scores) {
        if (&vehicle != &scores.front())
            say("\n");
        print_vehicle_score(vehicle, context);
    }
    return exit_good;
}

}  // namespace reprise::cli
