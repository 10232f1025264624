#include "cli/trace/diff.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/fingerprint/other_build.h"
#include "cli/process/guard.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "replay/compare/actor_comparison.h"
#include "replay/compare/divergence.h"
#include "replay/table/actor_search.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/story/wording.h"

namespace reprise::cli {

namespace {

/// Runs of one start cannot differ: each is simulated again, which tells the one that does not
/// repeat. Of different starts, both runs anew.
std::string commands_again(const DiffOptions& options,
                           replay::TraceReader& expected,
                           replay::TraceReader& found,
                           std::uint64_t tick) {
    const auto again = [&](replay::TraceReader& trace) {
        const world::EpisodeT& episode = trace.episode();
        return rerun_command(trace.path(),
                             episode,
                             tick == 0 ? world::tick_limit(episode) : length_beyond(episode, tick));
    };
    if (expected.chain(0) == found.chain(0) &&
        replay::branch_text(expected.episode(), found.episode()).empty())
        return "reprise verify " + shell_path(options.expected) + "; reprise verify " +
               shell_path(options.found);
    return again(expected) + " -o expected.mcap; " + again(found) +
           " -o found.mcap; reprise diff expected.mcap found.mcap";
}

/// What became of the comparison.
struct Comparison {
    std::optional<replay::Divergence> divergence;
    std::optional<replay::Tolerance> tolerance;  ///< what was given, and the largest within it
    std::vector<replay::StageDifference> all;    ///< when they were asked for
    std::optional<std::uint32_t> actor;          ///< whom alone it is about
};

/// Who has that name or id in both traces.
std::uint32_t same_actor(const DiffOptions& options,
                         replay::TraceReader& expected,
                         replay::TraceReader& found) {
    const std::uint32_t id = replay::find_actor(expected, options.actor);
    const std::uint32_t other = replay::find_actor(found, options.actor);
    if (id != other)
        throw world::Error(
            fmt::format("--actor {}: that is {} in {} and {} in {}, and actors are "
                        "compared by their id",
                        options.actor,
                        id,
                        options.expected,
                        other,
                        options.found));
    return id;
}

/// All that differs in the tick of the divergence, when both runs have it.
std::vector<replay::StageDifference> all_of(const Comparison& result,
                                            replay::TraceReader& expected,
                                            replay::TraceReader& found) {
    const std::uint64_t tick = result.divergence->tick;
    if (tick == 0 || tick > std::min(expected.ticks(), found.ticks()))
        return {};
    if (result.actor)
        return replay::all_differences(
            replay::ActorTick(expected.recorded(tick), *result.actor).view(),
            replay::ActorTick(found.recorded(tick), *result.actor).view(),
            result.tolerance);
    return replay::all_differences(expected.recorded(tick), found.recorded(tick), result.tolerance);
}

Comparison compare(const DiffOptions& options,
                   replay::TraceReader& expected,
                   replay::TraceReader& found) {
    Comparison result;
    if (options.tolerance)
        result.tolerance.emplace(replay::Tolerance{*options.tolerance});
    replay::Tolerance* const tolerance = result.tolerance ? &*result.tolerance : nullptr;
    if (!options.actor.empty()) {
        result.actor = same_actor(options, expected, found);
        result.divergence = replay::compare(expected, found, *result.actor, tolerance);
    } else if (tolerance != nullptr) {
        result.divergence = replay::compare(expected, found, *tolerance);
    } else {
        result.divergence = replay::compare(expected, found);
    }
    if (result.divergence)
        result.divergence->again =
            commands_again(options, expected, found, result.divergence->tick);
    if (result.divergence && options.all)
        result.all = all_of(result, expected, found);
    return result;
}

/// "largest difference 3e-09: ..." or that there was none.
std::string largest(const replay::Tolerance& tolerance) {
    if (tolerance.largest == 0)
        return "no recorded value differs";
    return fmt::format("largest difference {:.3g}: {} {} / {}",
                       tolerance.largest,
                       tolerance.field,
                       tolerance.expected,
                       tolerance.found);
}

/// "  physics       vehicles[id 1].velocity.x  8.1 / 8.2  (1 unit in the last place apart)".
void print_all(const Comparison& result) {
    say("all differences of tick {}: {}\n", result.divergence->tick, result.all.size());
    for (const auto& [stage, field] : result.all)
        say("  {:<14}{}  {} / {}{}\n",
            stage,
            field.field,
            field.expected,
            field.found,
            field.distance.empty() ? "" : "  (" + field.distance + ")");
}

void print_text(const DiffOptions& options,
                const Comparison& result,
                replay::TraceReader& expected,
                replay::TraceReader& found) {
    const std::string about = result.actor ? options.actor + " is " : "";
    if (result.divergence) {
        const std::string branched = replay::branch_text(expected.episode(), found.episode());
        if (!branched.empty() && result.divergence->tick > 0)
            say("{}equal for {}; {}; first difference:\n",
                about,
                world::count_of(result.divergence->tick - 1, "tick"),
                branched);
        else
            say("{}different\n", about);
        say_lines(to_text(*result.divergence, expected.episode().step_ns));
        if (!result.all.empty())
            print_all(result);
    } else if (result.tolerance) {
        say("{}equal within tolerance {:g}: {}, {}\n",
            about,
            result.tolerance->bound,
            world::count_of(expected.ticks(), "tick"),
            largest(*result.tolerance));
        if (const std::string note = start_difference(expected, found); !note.empty())
            say("  note      {}\n", note);
    } else if (result.actor) {
        say("{}equal: {}\n",
            about,
            world::count_of(std::min(expected.ticks(), found.ticks()), "tick"));
    } else {
        say("equal: {}, chain {}\n",
            world::count_of(expected.ticks(), "tick"),
            world::to_hex(expected.chain(expected.ticks())));
    }
    if (const std::string note = town_path_difference(expected, found); !note.empty())
        fmt::print("  note      {}\n", note);
}

using Json = nlohmann::ordered_json;

/// What has 64 bits is text: many readers of JSON keep 53.
Json json_of(const replay::Divergence& divergence, std::uint64_t step_ns) {
    return {{"tick", std::to_string(divergence.tick)},
            {"seconds", world::seconds(divergence.tick, step_ns)},
            {"stage", divergence.stage},
            {"actor", divergence.actor},
            {"actor_id", divergence.actor_id},
            {"field", divergence.field},
            {"expected", divergence.expected},
            {"found", divergence.found},
            {"note", divergence.note},
            {"script", divergence.script},
            {"again", divergence.again}};
}

Json json_of(const std::vector<replay::StageDifference>& all) {
    Json list = Json::array();
    for (const auto& [stage, field] : all)
        list.push_back({{"stage", stage},
                        {"field", field.field},
                        {"actor_id", field.actor},
                        {"expected", field.expected},
                        {"found", field.found},
                        {"distance", field.distance}});
    return list;
}

void print_json(const DiffOptions& options,
                const Comparison& result,
                replay::TraceReader& expected,
                replay::TraceReader& found) {
    const auto side = [](const std::string& path, replay::TraceReader& trace) {
        return Json{{"path", path},
                    {"ticks", std::to_string(trace.ticks())},
                    {"chain", world::to_hex(trace.chain(trace.ticks()))}};
    };
    Json out{{"result",
              result.divergence  ? "different"
              : result.tolerance ? "within_tolerance"
                                 : "equal"},
             {"expected", side(options.expected, expected)},
             {"found", side(options.found, found)},
             {"start", start_difference(expected, found)},
             {"town_path", town_path_difference(expected, found)},
             {"branch", replay::branch_text(expected.episode(), found.episode())},
             {"builds", Json::array()}};
    for (const replay::BuildDifference& line :
         replay::build_differences(expected.episode().fingerprint, found.episode().fingerprint))
        out["builds"].push_back(
            {{"key", line.key}, {"expected", line.expected}, {"found", line.found}});
    if (result.actor)
        out["actor"] = {{"name", options.actor}, {"id", *result.actor}};
    if (result.tolerance)
        out["tolerance"] = {{"bound", result.tolerance->bound},
                            {"largest", result.tolerance->largest},
                            {"field", result.tolerance->field},
                            {"expected", result.tolerance->expected},
                            {"found", result.tolerance->found}};
    if (result.divergence)
        out["divergence"] = json_of(*result.divergence, expected.episode().step_ns);
    if (options.all)
        out["all"] = json_of(result.all);
    // Names may be no UTF-8: JSON must be.
    say_lines(out.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

/// Two folders of pictures are another program's affair, see cli/reprise.cpp; one is a mistake.
void check_no_folder(const DiffOptions& options) {
    const bool first = std::filesystem::is_directory(options.expected);
    if (first == std::filesystem::is_directory(options.found))
        return;
    const std::string& folder = first ? options.expected : options.found;
    const std::string& other = first ? options.found : options.expected;
    throw world::Error(
        fmt::format("{}: expected a folder of pictures, as {} is one", other, folder));
}

}  // namespace

int diff(const DiffOptions& options) {
    check_no_folder(options);
    replay::TraceReader expected(options.expected);
    replay::TraceReader found(options.found);
    if (!options.json)
        print_other_build("recorded by different builds",
                          "expected",
                          expected.episode().fingerprint,
                          "found",
                          found.episode().fingerprint);
    const Comparison result = compare(options, expected, found);
    if (options.json)
        print_json(options, result, expected, found);
    else
        print_text(options, result, expected, found);
    return result.divergence ? exit_differs : exit_good;
}

}  // namespace reprise::cli
