// Must: make one file that shows a run in any browser of the last years, without a network; stay
//   near 10 MB for ten minutes among a hundred cars; hold whatever names a trace has.
// Assumes: browsers know DecompressionStream('deflate'): from 2020 on Chrome, 2023 on all others.
// Goes: all that comes from the trace is one block of bytes: the length of a JSON text (4 bytes,
// the
//   lowest first), that text, and columns of numbers. Pressed and in base64 it cannot be mistaken
//   for markup. A content policy names the digests of the scripts: no other one runs.
// Keeps: the web page's own files, as they were at build time.
#include "exchange/page/replay_page.h"

#include <algorithm>
#include <array>
#include <charconv>

#include <fmt/format.h>

#include "exchange/base64.h"
#include "exchange/page/number_column.h"
#include "exchange/page/page_actors.h"
#include "exchange/page/page_story.h"
#include "exchange/page/page_town.h"
#include "replay/imported.h"
#include "replay/level.h"
#include "replay_page_files.h"
#include "world/check.h"
#include "world/printable.h"

namespace reprise::exchange {

namespace {

using nlohmann::json;
namespace files = replay_page_files;

struct Script {
    const char* text;
    const char* sha256;  ///< in hexadecimal digits
};

/// In the order in which they use each other.
constexpr std::array scripts{Script{files::trace, files::trace_sha256},
                             Script{files::series, files::series_sha256},
                             Script{files::layers, files::layers_sha256},
                             Script{files::town, files::town_sha256},
                             Script{files::figures, files::figures_sha256},
                             Script{files::actors, files::actors_sha256},
                             Script{files::view, files::view_sha256},
                             Script{files::timeline, files::timeline_sha256},
                             Script{files::plots, files::plots_sha256},
                             Script{files::panels, files::panels_sha256},
                             Script{files::app, files::app_sha256}};

/// Markup means nothing in it any more.
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        constexpr std::string_view special = "&<>\"'";
        if (special.find(c) == std::string_view::npos)
            out += c;
        else
            out += fmt::format("&#{};", static_cast<int>(c));
    }
    return out;
}

/// As a content policy names a script.
std::string digest_source(std::string_view hex) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
        std::uint8_t byte = 0;
        std::from_chars(hex.data() + i, hex.data() + i + 2, byte, 16);
        bytes += static_cast<char>(byte);
    }
    return "'sha256-" + base64(bytes) + "'";
}

std::string policy() {
    std::string allowed;
    for (const Script& script : scripts)
        allowed += " " + digest_source(script.sha256);
    return fmt::format(
        "default-src 'none'; img-src data:; style-src {}; script-src{}; base-uri 'none'; "
        "form-action 'none'",
        digest_source(files::style_sha256),
        allowed);
}

std::string page_of(const std::string& title, const std::string& data) {
    std::string all_scripts;
    for (const Script& script : scripts)
        all_scripts += fmt::format("<script>{}</script>\n", script.text);
    std::string html;
    std::string_view rest = files::layout;
    while (!rest.empty()) {
        const std::size_t mark = rest.find("{{");
        html += rest.substr(0, mark);
        if (mark == std::string_view::npos)
            break;
        const std::size_t end = rest.find("}}", mark);
        const std::string_view name = rest.substr(mark + 2, end - mark - 2);
        html += name == "policy"    ? policy()
                : name == "title"   ? escaped(title)
                : name == "style"   ? std::string(files::style)
                : name == "scripts" ? all_scripts
                                    : data;
        rest.remove_prefix(end + 2);
    }
    return html;
}

/// Every so many ticks, so that no more places than wanted come out.
std::uint64_t chosen_interval(replay::TraceReader& trace, const PageOptions& options) {
    constexpr std::uint64_t most_looks = 16;
    const std::uint64_t ticks = options.last + 1 - options.first;
    if (ticks == 0)
        return 1;
    const std::uint64_t looks = std::min(most_looks, ticks);
    std::uint64_t places = 0;
    for (std::uint64_t i = 0; i < looks; ++i) {
        const std::uint64_t index = options.first + i * ticks / looks;
        const world::TickView view = trace.recorded(index).view;
        places += view.vehicles().size();
        if (view.traffic != nullptr)
            places += view.cars().size() + view.walkers().size();
    }
    places = places * ticks / looks;
    return std::max<std::uint64_t>(1, (places + options.most_places - 1) / options.most_places);
}

json settings_of(const std::vector<world::ParameterT>& parameters) {
    json settings = json::array();
    for (const world::ParameterT& parameter : parameters)
        settings.push_back({parameter.key, parameter.value});
    return settings;
}

json start_of(const world::EpisodeT& episode) {
    json start = {{"name", episode.name},
                  {"path", episode.scenario_path},
                  {"source", episode.scenario},
                  {"seed", std::to_string(episode.seed)},
                  {"weather", episode.weather_name},
                  {"friction", episode.road_friction},
                  {"cars", episode.cars},
                  {"settings", settings_of(episode.parameters)},
                  {"imported", episode.imported_from}};
    start["branches"] = json::array();
    for (const world::BranchT& branch : episode.branches)
        start["branches"].push_back({{"tick", branch.tick},
                                     {"name", branch.name},
                                     {"path", branch.scenario_path},
                                     {"source", branch.scenario},
                                     {"settings", settings_of(branch.parameters)}});
    return start;
}

/// What a spectator should know about what he does not see.
json notes_of(const replay::TraceReader& trace, const PageOptions& options, std::uint64_t every) {
    json notes = json::array();
    if (trace.ticks() == 0)
        notes.push_back("There is no tick in this trace.");
    if (trace.slice())
        notes.push_back(fmt::format("A slice: ticks {} to {} of a run of {}.",
                                    trace.first(),
                                    trace.last(),
                                    trace.run_ticks()));
    if (options.first != trace.first() || options.last != trace.last())
        notes.push_back(fmt::format("Shown are ticks {} to {} of the trace's {} to {}.",
                                    options.first,
                                    options.last,
                                    trace.first(),
                                    trace.last()));
    if (trace.level() == replay::Level::core)
        notes.push_back(
            "Traffic and walkers were stripped from this trace; `reprise expand` brings them "
            "back.");
    if (trace.level() == replay::Level::keyed)
        notes.push_back(
            "Stripped: where traffic and walkers were is kept once in 20 ticks, and interpolated "
            "between; `reprise expand` brings the rest back.");
    if (every > 1)
        notes.push_back(
            fmt::format("Positions are kept of one tick in {}; between, they are interpolated. "
                        "`--every 1` keeps all.",
                        every));
    if (replay::is_imported(trace))
        notes.push_back("Imported from " + trace.episode().imported_from + ": poses only.");
    return notes;
}

/// What would be invisible or turn the direction of writing is written out, as on a terminal.
void make_printable(json& value) {
    if (value.is_string())
        value = world::printable_lines(value.get_ref<const std::string&>());
    else if (value.is_structured())
        for (json& part : value)
            make_printable(part);
}

/// Reads the ticks: those to be drawn, what happened in all of them.
std::string read_ticks(replay::TraceReader& trace,
                       const PageOptions& options,
                       std::uint64_t every,
                       json& head) {
    PageActors actors;
    PageStory story(replay::is_imported(trace));
    std::uint64_t next_traffic = options.first;
    for (std::uint64_t index = trace.first(); index <= options.last; ++index) {
        const world::TickView view = trace.recorded(index).view;
        if (index < options.first) {
            story.learn(*view.tick);
            continue;
        }
        story.hear(*view.tick);
        const bool is_drawn = (index - options.first) % every == 0 || index == options.last;
        if (is_drawn)
            actors.add_bodies(view);
        // Of a stripped trace it comes seldom: whenever it is due.
        if (view.traffic != nullptr && (is_drawn || index >= next_traffic)) {
            actors.add_traffic(view);
            next_traffic = index + every;
        }
    }
    story.write(head);
    return actors.write(head);
}

}  // namespace

ReplayPage replay_page(replay::TraceReader& trace, const PageOptions& options) {
    if (trace.level() == replay::Level::inputs)
        throw world::Error(replay::lacks_text(trace.path().string(), trace.level()));
    const std::uint64_t every =
        options.every != 0 ? options.every : chosen_interval(trace, options);
    json head = {{"trace", trace.path().filename().string()},
                 {"start", start_of(trace.episode())},
                 {"town", page_town(trace.recording().town)},
                 {"verdict", trace.outcome().verdict},
                 {"reason", trace.outcome().reason},
                 {"step", static_cast<double>(trace.episode().step_ns) * 1e-9},
                 {"first", options.first},
                 {"last", options.last},
                 {"every", every},
                 {"notes", notes_of(trace, options, every)}};
    const std::string columns = read_ticks(trace, options, every, head);
    make_printable(head);
    const std::string text = head.dump(-1, ' ', false, json::error_handler_t::replace);
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8)
        bytes += static_cast<char>(text.size() >> shift & 0xff);
    bytes += text;
    bytes += columns;
    const std::string title = world::printable(trace.episode().name) + " - reprise";
    return {page_of(title, base64(pressed(bytes))), every};
}

}  // namespace reprise::exchange
