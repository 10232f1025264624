#include "cli/trace/info.h"

#include <algorithm>
#include <cstdlib>
#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/process/guard.h"
#include "cli/process/reproduce.h"
#include "cli/process/say.h"
#include "cli/trace/trace_story.h"
#include "replay/imported.h"
#include "replay/level.h"
#include "replay/trace_reader.h"
#include "world/check.h"
#include "world/digest.h"
#include "world/printable.h"
#include "world/story/wording.h"
#include "world/tick.h"

namespace reprise::cli {

namespace {

/// Longer traces tell their events on request only: reading them takes about 15 us a tick.
constexpr std::uint64_t quickly_told = 20'000;

/// Terminal colours; nothing where stdout is none, or NO_COLOR is set.
struct Paint {
    bool on = isatty(STDOUT_FILENO) == 1 && std::getenv("NO_COLOR") == nullptr;

    /// To be printed as it is: what a terminal would obey in the text is written out.
    std::string operator()(const char* code, const std::string& text) const {
        const std::string clean = world::printable(text);
        return on ? fmt::format("\033[{}m{}\033[0m", code, clean) : clean;
    }
};

constexpr const char* bold = "1";
constexpr const char* dim = "2";
constexpr const char* red = "31";
constexpr const char* green = "32";

/// From the trace alone; of a slice, which lacks the start, from its scenario.
std::string run_again(const replay::TraceReader& trace) {
    return trace.first() > 1 ? run_command(trace.episode(), trace.episode().max_ticks)
                             : "reprise run " + shell_path(trace.path());
}

struct Screen {
    replay::TraceReader& trace;
    const TraceStory& story;
    bool long_form = false;
    Paint paint{};

    void row(const std::string& key, const std::string& value) const {
        painted_row(key, world::printable(value));
    }

    /// The value holds our own colours, and what else is in it was made printable.
    void painted_row(const std::string& key, const std::string& value) const {
        say_formatted(stdout,
                      fmt::format("  {}{}\n", paint(dim, fmt::format("{:<10}", key)), value));
    }

    std::string time(std::uint64_t tick) const {
        return fmt::format("{:.2f} s", world::seconds(tick, trace.episode().step_ns));
    }

    void print_import() const {
        const world::EpisodeT& episode = trace.episode();
        row("imported", "from " + episode.imported_from);
        row("holds", "poses only: it cannot be simulated again");
        row("town", episode.town);
        for (const world::ParameterT& parameter : episode.parameters)
            row(parameter.key, parameter.value);
    }

    void print_start() const {
        const world::EpisodeT& episode = trace.episode();
        row("scenario", fmt::format("{} ({})", episode.name, episode.scenario_path));
        row("town",
            fmt::format("{}, {} of traffic{}",
                        episode.town,
                        world::count_of(episode.cars, "car"),
                        episode.walkers == 0
                            ? ""
                            : fmt::format(", {} (seed {}, {:g} % cross anywhere)",
                                          world::count_of(episode.walkers, "walker"),
                                          episode.walker_seed,
                                          100 * episode.jaywalkers)));
        row("weather",
            fmt::format("{}, road friction {}", episode.weather_name, episode.road_friction));
        row("seed", std::to_string(episode.seed));
        std::string settings;
        for (const world::ParameterT& parameter : episode.parameters)
            settings += (settings.empty() ? "" : ", ") + parameter.key + " = " + parameter.value;
        if (!settings.empty())
            row("set", settings);
        for (const world::BranchT& branch : episode.branches) {
            row("branch",
                fmt::format("at tick {} ({}) {} ({}) {} from chain {}",
                            branch.tick,
                            time(branch.tick),
                            branch.name,
                            branch.scenario_path,
                            branch.scenario.empty() ? "went on" : "took over",
                            world::to_hex(branch.parent_chain)));
            for (const world::ParameterT& parameter : branch.parameters)
                row("", parameter.key + " = " + parameter.value);
        }
    }

    void print_length() const {
        const world::EpisodeT& episode = trace.episode();
        row("length",
            fmt::format("{} of {} ms = {}",
                        world::count_of(trace.ticks(), "tick"),
                        episode.step_ns / 1'000'000,
                        time(trace.ticks())));
        if (trace.slice())
            row("slice",
                fmt::format(
                    "ticks {} to {} of {}", trace.first(), trace.last(), trace.run_ticks()));
        if (trace.level() != replay::Level::full)
            row("level",
                fmt::format("{}: {}",
                            replay::to_word(trace.level()),
                            replay::lacks_text(shell_path(trace.path()), trace.level())));
    }

    void print_outcome() const {
        const world::Outcome& outcome = trace.outcome();
        const bool bad = outcome.verdict == "failed" || outcome.verdict == "error";
        painted_row("outcome",
                    paint(bad ? red : green, outcome.verdict) +
                        (outcome.reason.empty() ? "" : ": " + world::printable(outcome.reason)));
        for (const TraceStory::Check& check : story.checks)
            painted_row("",
                        fmt::format("{}  {}{}",
                                    paint(check.status == "passed" ? green : red, check.status),
                                    world::printable(check.text),
                                    check.status == "failed" ? ", at " + time(check.tick) : "") +
                            (check.worst.empty() ? "" : "; " + world::printable(check.worst)));
    }

    void print_events() const {
        if (!story.whole) {
            row("events", "in so many ticks told by `reprise info --long` only, failed checks too");
            return;
        }
        print_crashes();
        const char* key = "events";
        for (const TraceStory::Kind& kind : story.kinds) {
            row(key, fmt::format("{} {}", kind.count, kind.name));
            row("", fmt::format("  {:>9}  {}", time(kind.first), kind.first_text));
            if (kind.count > 1)
                row("", fmt::format("  {:>9}  {}", time(kind.last), kind.last_text));
            key = "";
        }
    }

    /// One line for all crashes of the same two.
    void print_crashes() const {
        constexpr std::size_t most = 12;
        const auto& crashes = story.crashes;
        for (std::size_t i = 0; i < std::min(most, crashes.size()); ++i) {
            const TraceStory::Crashes& all = crashes[i];
            std::string line = fmt::format("{:>9}  {}", time(all.worst.tick), to_line(all.worst));
            if (all.count > 1)
                line += fmt::format(
                    "; the worst of {} from {} to {}", all.count, time(all.first), time(all.last));
            row(i == 0 ? "crashes" : "", line);
        }
        if (crashes.size() > most)
            row("",
                fmt::format(
                    "{:>9}  {} of others", "", world::count_of(crashes.size() - most, "pair")));
    }

    void print_actors() const {
        constexpr std::size_t most = 6;
        std::vector<std::string> words;
        for (std::size_t i = 0; i < std::min(most, story.actors.size()); ++i)
            words.push_back(fmt::format("{} ({})", story.actors[i].name, story.actors[i].id));
        if (story.actors.size() > most)
            words.push_back(fmt::format("{} more", story.actors.size() - most));
        if (trace.level() == replay::Level::full)
            words.push_back(fmt::format("in the end {} and {} around",
                                        world::count_of(story.cars, "car"),
                                        world::count_of(story.walkers, "walker")));
        if (!words.empty())
            row("actors", fmt::format("{}", fmt::join(words, ", ")));
    }

    void print_size() const {
        const double hours =
            world::seconds(std::max<std::uint64_t>(trace.ticks(), 1), trace.episode().step_ns) /
            3600;
        const auto an_hour = [&](std::uint64_t bytes) {
            return static_cast<double>(bytes) / hours / 1e6;
        };
        row("size",
            fmt::format(
                "{:.2f} MB, {:.2f} of them ticks; a simulated hour of these takes {:.0f} MB",
                static_cast<double>(trace.file_size()) / 1e6,
                static_cast<double>(trace.packed_bytes()) / 1e6,
                an_hour(trace.packed_bytes())));
        const ChannelBytes channels = sample_channels(trace);
        row("",
            fmt::format("unpacked about {:.0f} MB: /sim/tick {:.0f}, /sim/traffic {:.0f}",
                        an_hour(channels.tick + channels.traffic),
                        an_hour(channels.tick),
                        an_hour(channels.traffic)));
    }

    void print_build() const {
        const auto& lines = trace.episode().fingerprint;
        if (long_form) {
            const char* key = "build";
            for (const world::ParameterT& line : lines) {
                row(key, line.key + " " + line.value);
                key = "";
            }
            return;
        }
        std::string text;
        for (std::size_t i = 0; i < std::min<std::size_t>(2, lines.size()); ++i)
            text += (text.empty() ? "" : ", ") + lines[i].key + " " + lines[i].value;
        row("build", text + " (as the file says; all lines: --long)");
    }

    void print(const std::string& path) const {
        const world::EpisodeT& episode = trace.episode();
        say_formatted(stdout, paint(bold, path) + "\n");
        if (replay::is_imported(trace))
            print_import();
        else
            print_start();
        print_length();
        print_outcome();
        print_events();
        print_actors();
        if (trace.ticks() > 0)
            row("chain", world::to_hex(trace.chain(trace.last())));
        print_size();
        print_build();
        if (replay::is_imported(trace))
            return;
        row("checked", "that it agrees with itself; `reprise verify` simulates it again");
        if (trace.first() > 1 && !episode.branches.empty())
            return;  // the run before the branch is in another trace
        row("again", run_again(trace));
    }
};

using Json = nlohmann::ordered_json;

Json json_of(const TraceStory& story) {
    Json out{{"whole", story.whole},
             {"checks", Json::array()},
             {"crashes", Json::array()},
             {"kinds", Json::array()},
             {"actors", Json::array()},
             {"cars", story.cars},
             {"walkers", story.walkers}};
    for (const TraceStory::Check& check : story.checks)
        out["checks"].push_back({{"status", check.status},
                                 {"text", check.text},
                                 {"tick", std::to_string(check.tick)},
                                 {"worst", check.worst}});
    for (const TraceStory::Kind& kind : story.kinds)
        out["kinds"].push_back({{"kind", kind.name},
                                {"count", std::to_string(kind.count)},
                                {"first_tick", std::to_string(kind.first)},
                                {"last_tick", std::to_string(kind.last)},
                                {"first", kind.first_text},
                                {"last", kind.last_text}});
    for (const TraceStory::Crashes& crashes : story.crashes)
        out["crashes"].push_back({{"actor", crashes.worst.actor},
                                  {"other", crashes.worst.other},
                                  {"count", std::to_string(crashes.count)},
                                  {"first_tick", std::to_string(crashes.first)},
                                  {"last_tick", std::to_string(crashes.last)},
                                  {"worst_tick", std::to_string(crashes.worst.tick)},
                                  {"worst_impulse", crashes.worst.impulse},
                                  {"worst_duration", crashes.worst.duration},
                                  {"worst", to_line(crashes.worst)}});
    for (const TraceStory::Actor& actor : story.actors)
        out["actors"].push_back({{"id", actor.id}, {"name", actor.name}});
    return out;
}

Json json_of(const std::vector<world::ParameterT>& parameters) {
    Json out = Json::object();
    for (const world::ParameterT& parameter : parameters)
        out[parameter.key] = parameter.value;
    return out;
}

/// What has 64 bits is text: many readers of JSON keep 53.
void print_json(const std::string& path, replay::TraceReader& trace, const TraceStory& story) {
    const world::EpisodeT& episode = trace.episode();
    const ChannelBytes channels = sample_channels(trace);
    Json branches = Json::array();
    for (const world::BranchT& branch : episode.branches)
        branches.push_back({{"tick", std::to_string(branch.tick)},
                            {"name", branch.name},
                            {"script", branch.scenario.empty() ? "" : branch.scenario_path},
                            {"parameters", json_of(branch.parameters)},
                            {"parent_chain", world::to_hex(branch.parent_chain)}});
    const Json out{{"path", path},
                   {"name", episode.name},
                   {"scenario", episode.scenario_path},
                   {"imported_from", episode.imported_from},
                   {"town", episode.town},
                   {"seed", std::to_string(episode.seed)},
                   {"step_ns", std::to_string(episode.step_ns)},
                   {"ticks", std::to_string(trace.ticks())},
                   {"first_tick", std::to_string(trace.first())},
                   {"run_ticks", std::to_string(trace.run_ticks())},
                   {"max_ticks", std::to_string(episode.max_ticks)},
                   {"seconds", world::seconds(trace.ticks(), episode.step_ns)},
                   {"traffic", episode.cars},
                   {"walkers", episode.walkers},
                   {"walker_seed", std::to_string(episode.walker_seed)},
                   {"jaywalkers", episode.jaywalkers},
                   {"weather", episode.weather_name},
                   {"road_friction", episode.road_friction},
                   {"parameters", json_of(episode.parameters)},
                   {"verdict", trace.outcome().verdict},
                   {"reason", trace.outcome().reason},
                   {"chain", world::to_hex(trace.chain(trace.last()))},
                   {"events", json_of(story)},
                   {"level", replay::to_word(trace.level())},
                   {"branches", branches},
                   {"bytes", std::to_string(trace.file_size())},
                   {"tick_bytes", std::to_string(trace.packed_bytes())},
                   {"unpacked_bytes",
                    {{"/sim/tick", std::to_string(channels.tick)},
                     {"/sim/traffic", std::to_string(channels.traffic)}}},
                   {"build", json_of(episode.fingerprint)},
                   {"checked", "that it agrees with itself; not simulated again"},
                   {"again", replay::is_imported(trace) ? "" : run_again(trace)}};
    say_lines(out.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace

int info(const InfoOptions& options) {
    replay::TraceReader trace(options.trace);
    const TraceStory story = read_story(trace, options.long_form || trace.ticks() <= quickly_told);
    const auto contradiction = story.told.contradiction(trace, story.whole);
    if (contradiction && !replay::is_imported(trace))
        throw world::Error(
            fmt::format("{}: {}: it was changed after it was recorded; `reprise "
                        "verify` names the first difference",
                        options.trace,
                        *contradiction));
    if (options.json)
        print_json(options.trace, trace, story);
    else
        Screen{trace, story, options.long_form}.print(options.trace);
    return exit_good;
}

}  // namespace reprise::cli
