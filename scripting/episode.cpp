#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scripting/lua/vm.h"
#include "scripting/run/files.h"
#include "scripting/run/tasks.h"
#include "scripting/scenario.h"
#include "scripting/words/header.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr std::uint64_t step_ns = 50'000'000;
constexpr std::uint32_t substeps = 10;
constexpr std::uintmax_t longest_file = std::uintmax_t{1} << 20U;  // [bytes]

/// Lua files beside a missing one, for the message.
std::vector<std::string> neighbours(const std::filesystem::path& path) {
    std::vector<std::string> names;
    std::error_code ignored;
    const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".lua")
            names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Throws world::Error for what is no text of a scenario.
void check_text(const std::string& shown, const std::string& source) {
    if (source.size() > longest_file)
        throw world::Error(fmt::format("'{}' is larger than 1 MB: not a scenario", shown));
    if (source.find_first_not_of(" \t\r\n") == std::string::npos)
        throw world::Error(
            fmt::format("'{}' is empty: a scenario file ends with: return scenario "
                        "'name' {{ ... }}",
                        shown));
    if (source.front() == '\x1b')
        throw world::Error(fmt::format("'{}' is compiled Lua: a scenario is Lua source", shown));
}

std::string read_source(const std::filesystem::path& path) {
    const std::string shown = path.string();
    std::error_code error;
    if (!std::filesystem::exists(path, error))
        throw world::Error(
            fmt::format("no scenario file '{}'{}",
                        shown,
                        world::did_you_mean(path.filename().string(), neighbours(path))));
    if (!std::filesystem::is_regular_file(path, error))
        throw world::Error(
            fmt::format("'{}' is not a file: name a scenario, such as cut_in.lua", shown));
    if (std::filesystem::file_size(path, error) > longest_file)
        throw world::Error(fmt::format("'{}' is larger than 1 MB: not a scenario", shown));
    std::ifstream file(path, std::ios::binary);
    const std::string source{std::istreambuf_iterator<char>(file), {}};
    if (!file)
        throw world::Error(fmt::format("cannot read '{}'", shown));
    check_text(shown, source);
    return source;
}

/// The text after `--set key=` as a value of the same type as the scenario's own.
Value replaced(const Value& own, const std::string& text, const std::string& where) {
    if (std::holds_alternative<std::string>(own))
        return text;
    if (std::holds_alternative<bool>(own)) {
        if (text != "true" && text != "false")
            throw world::Error(where + "must be true or false");
        return text == "true";
    }
    const auto number = parse_number(text);
    if (!number)
        throw world::Error(where + "must be a number");
    // Equal numbers become equal texts: 20, 20.0 and 2e1 where the scenario says 12 or 12.5.
    const auto* integer = std::get_if<std::int64_t>(&*number);
    const double real =
        integer != nullptr ? static_cast<double>(*integer) : std::get<double>(*number);
    if (std::holds_alternative<double>(own))
        return real;
    if (integer == nullptr && real == std::floor(real) && std::abs(real) < 0x1p53)
        return static_cast<std::int64_t>(real);
    return *number;
}

void override_parameters(Header& header, const Overrides& overrides, const std::string& script) {
    std::vector<std::string> names;
    for (const auto& [key, value] : header.parameters)
        names.push_back(key);
    for (const auto& [key, text] : overrides.parameters) {
        const std::string where =
            fmt::format("{}:{}: --set {}={}: ", script, header.line, key, text);
        const auto found = header.parameters.find(key);
        if (found == header.parameters.end())
            throw world::Error(where + (names.empty()
                                            ? "the scenario has no parameters"
                                            : "no parameter '" + key + "'" +
                                                  world::did_you_mean(key, names) + "; there are " +
                                                  fmt::format("{}", fmt::join(names, ", "))));
        found->second = replaced(found->second, text, where);
    }
}

std::vector<world::ParameterT> recorded(const std::map<std::string, Value>& parameters) {
    std::vector<world::ParameterT> list;
    for (const auto& [key, value] : parameters) {
        world::ParameterT parameter;
        parameter.key = key;
        parameter.value = literal(value);
        list.push_back(std::move(parameter));
    }
    return list;
}

/// Where a branch ends when nothing else is said, and when it is.
std::uint64_t limit_of_branch(const world::EpisodeT& run,
                              std::uint64_t tick,
                              std::optional<double> duration) {
    if (duration)
        return tick + std::max<std::uint64_t>(1, ticks_of(*duration, run.step_ns));
    return run.branches.empty() ? run.max_ticks : run.branches.back().max_ticks;
}

}  // namespace

world::EpisodeT load_episode(const std::filesystem::path& scenario_lua,
                             const Overrides& overrides) {
    world::EpisodeT episode =
        episode_of_text(scenario_lua.filename().string(), read_source(scenario_lua), overrides);
    episode.files = companions_of(episode.scenario, episode.parameters, scenario_lua.parent_path());
    return episode;
}

world::EpisodeT episode_of_text(const std::string& name,
                                const std::string& source,
                                const Overrides& overrides) {
    check_text(name, source);
    world::EpisodeT episode;
    episode.scenario = source;
    episode.scenario_path = name;
    Vm vm(episode.scenario_path);
    Header header = read_header(vm, episode.scenario);
    override_parameters(header, overrides, episode.scenario_path);

    const double duration = overrides.duration.value_or(header.duration);
    if (!(duration > 0) || duration > 86'400)
        throw world::Error(fmt::format("--for {}: must be in (0, 86400] s", duration));
    if (overrides.weather) {
        header.weather = preset_weather("--weather", *overrides.weather);
        if (header.friction)
            header.weather.friction = *header.friction;
    }
    episode.name = header.name;
    episode.town = overrides.town.value_or(header.town);
    episode.seed = overrides.seed.value_or(header.seed);
    episode.step_ns = step_ns;
    episode.substeps = substeps;
    episode.max_ticks = std::max<std::uint64_t>(1, ticks_of(duration, step_ns));
    episode.cars = overrides.cars.value_or(header.cars);
    episode.walkers = overrides.walkers.value_or(header.walkers);
    if (episode.walkers > 0) {
        episode.walker_seed = header.walker_seed.value_or(episode.seed);
        episode.jaywalkers = header.jaywalkers;
    }
    episode.road_friction = overrides.friction.value_or(header.weather.friction);
    episode.weather = header.weather.weather;
    episode.weather_name = header.weather.name;
    episode.parameters = recorded(header.parameters);
    return episode;
}

world::BranchT load_branch(const std::filesystem::path& scenario_lua,
                           const Overrides& overrides,
                           const world::EpisodeT& run,
                           std::uint64_t tick) {
    world::BranchT branch;
    branch.tick = tick;
    branch.scenario = read_source(scenario_lua);
    branch.scenario_path = scenario_lua.filename().string();
    Vm vm(branch.scenario_path);
    vm.in_branch = true;
    Header header = read_header(vm, branch.scenario);
    if (!header.of_world.empty())
        throw world::Error(fmt::format(
            "{}:{}: '{}' was decided when the run began: a what-if takes the world as it is{}",
            branch.scenario_path,
            header.line,
            header.of_world,
            header.of_world == "weather" ? "; set_weather changes the weather" : ""));
    override_parameters(header, overrides, branch.scenario_path);
    branch.name = header.name;
    branch.parameters = recorded(header.parameters);
    branch.files = companions_of(branch.scenario, branch.parameters, scenario_lua.parent_path());
    std::optional<double> duration = overrides.duration;
    if (!duration && header.has_duration)
        duration = header.duration;
    branch.max_ticks = limit_of_branch(run, tick, duration);
    return branch;
}

world::BranchT change_branch(const Overrides& overrides,
                             const world::EpisodeT& run,
                             std::uint64_t tick) {
    world::BranchT branch;
    branch.tick = tick;
    const auto script = std::find_if(run.branches.rbegin(),
                                     run.branches.rend(),
                                     [](const auto& earlier) { return !earlier.scenario.empty(); });
    const bool in_branch = script != run.branches.rend();
    branch.name = in_branch ? script->name : run.name;
    branch.scenario_path = in_branch ? script->scenario_path : run.scenario_path;
    Vm vm(branch.scenario_path);
    vm.in_branch = in_branch;
    Header header = read_header(vm, in_branch ? script->scenario : run.scenario);
    override_parameters(header, overrides, branch.scenario_path);
    branch.parameters = recorded(header.parameters);
    std::erase_if(branch.parameters, [&](const world::ParameterT& parameter) {
        return std::none_of(overrides.parameters.begin(),
                            overrides.parameters.end(),
                            [&](const auto& given) { return given.first == parameter.key; });
    });
    branch.max_ticks = limit_of_branch(run, tick, overrides.duration);
    return branch;
}

}  // namespace reprise::scripting
