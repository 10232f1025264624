#include "cli/process/reproduce.h"

#include <algorithm>
#include <charconv>
#include <string_view>

#include "world/weather/weather_text.h"

namespace reprise::cli {

namespace {

constexpr std::string_view plain =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";

/// What --set takes for a parameter that is recorded as a Lua literal: texts without their quotes.
std::string setting(const std::string& literal) {
    if (literal.size() < 2 || literal.front() != '\'' || literal.back() != '\'')
        return literal;
    std::string text;
    for (std::size_t i = 1; i + 1 < literal.size(); ++i) {
        char c = literal[i];
        if (c == '\\') {
            c = literal[++i];
            c = c == 'n' ? '\n' : c == 'r' ? '\r' : c;
        }
        text += c;
    }
    return text;
}

}  // namespace

std::string decimal(double value) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof(text), value).ptr};
}

std::string shell_word(const std::string& word) {
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos)
        return word;
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string shell_path(const std::filesystem::path& path) {
    const std::string text = path.string();
    return shell_word(text.starts_with('-') ? "./" + text : text);
}

namespace {

std::string length(const world::EpisodeT& episode, std::uint64_t ticks) {
    return " --for " + decimal(static_cast<double>(ticks * episode.step_ns) / 1e9);
}

/// Where it may be another one than the scenario's own; one that has no name, the script says.
std::string weather(const world::EpisodeT& episode) {
    const auto preset = world::weather_of_text(episode.weather_name);
    const bool is_plain = preset && preset->name == world::weather_presets().front().name &&
                          preset->road_friction == episode.road_friction;
    if (!preset || (is_plain && episode.scenario.find("weather") == std::string::npos))
        return "";
    std::string text = " --weather " + preset->name;
    if (preset->road_friction != episode.road_friction)
        text += " --friction " + decimal(episode.road_friction);
    return text;
}

}  // namespace

std::string rerun_command(const std::filesystem::path& trace,
                          const world::EpisodeT& episode,
                          std::uint64_t ticks) {
    return "reprise run " + shell_path(trace) + length(episode, ticks);
}

std::string run_command(const world::EpisodeT& episode, std::uint64_t ticks) {
    std::string text = "reprise run " + shell_path(episode.scenario_path);
    if (!episode.town_path.empty())
        text += " --town " + shell_path(episode.town_path);
    text += " --seed " + std::to_string(episode.seed);
    text += length(episode, ticks);
    text += weather(episode);
    if (episode.walkers > 0 || episode.scenario.find("walkers") != std::string::npos)
        text += " --walkers " + std::to_string(episode.walkers);
    for (const world::ParameterT& parameter : episode.parameters)
        text += " --set " + shell_word(parameter.key + "=" + setting(parameter.value));
    return text;
}

std::uint64_t length_beyond(const world::EpisodeT& episode, std::uint64_t tick) {
    const std::uint64_t limit =
        episode.branches.empty() ? episode.max_ticks : episode.branches.back().max_ticks;
    return std::min(tick + 1, limit);
}

std::string recover_command(const std::filesystem::path& damaged) {
    std::filesystem::path out = damaged;
    if (damaged.extension() == ".partial")
        out.replace_extension();
    else
        out.replace_filename(damaged.stem().string() + "_recovered.mcap");
    return "reprise recover " + shell_path(damaged) + " -o " + shell_path(out);
}

}  // namespace reprise::cli
