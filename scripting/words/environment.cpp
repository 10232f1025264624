#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/text.h"
#include "scripting/run/run.h"
#include "scripting/words/vocabulary.h"
#include "world/check.h"

// What is told to nobody's car: the weather and the signals.
namespace reprise::scripting {

namespace {

constexpr Key set_weather_key_rows[] = {
    {"over", "number", "[s] of the change; default at once"},
};

constexpr Key set_signal_key_rows[] = {
    {"duration", "number", "[s] for how long; default for good"},
    {"turn",
     "'straight'|'left'|'right'|'partially_left'|'partially_right'|'around'",
     "of the way that turns so"},
};

constexpr Key green_key_rows[] = {
    {"turn",
     "'straight'|'left'|'right'|'partially_left'|'partially_right'|'around'",
     "of the way that turns so"},
    {"timeout", "number", "[s] to give up after; default never"},
};

using world::SignalColor;

// --- Weather.

SaidWeather present_weather(const world::TickView& last) {
    return {*last.tick->weather(), last.tick->road_friction(), false, "changed"};
}

int set_weather(Run& run, lua_State* L) {
    const Fields options(L, 2, "set_weather", names_of(set_weather_key_rows), true);
    WeatherEntry entry;
    entry.over = options.number("over").value_or(0);
    if (entry.over < 0 || entry.over > 86'400)
        refuse("set_weather", "'over' must be in [0, 86400] s");
    lua_pushvalue(L, 1);
    if (lua_type(L, -1) != LUA_TSTRING && lua_type(L, -1) != LUA_TTABLE)
        refuse("set_weather",
               "needs a name or a table: set_weather 'hard_rain_sunset', "
               "set_weather({ rain_mm_h = 8, wetness = 0.6 }, { over = 10 })");
    entry.said = weather_at_top(L, "set_weather", present_weather(run.last));
    lua_pop(L, 1);
    entry.line = run.vm.line(L);
    run.weathers.change(
        entry, run.last, run.episode.step_ns, run.say(L, world::CommandKind::set_weather, 0));
    return 0;
}

// --- Signals.

std::vector<std::string> turn_names() {
    std::vector<std::string> names;
    for (const char* const* name = world::EnumNamesTurn(); *name != nullptr; ++name)
        names.emplace_back(*name);
    return names;
}

std::optional<world::Turn> turn_named(const char* who, const std::optional<std::string>& name) {
    if (!name)
        return std::nullopt;
    const std::vector<std::string> names = turn_names();
    const auto found = std::find(names.begin(), names.end(), *name);
    if (found == names.end())
        refuse(who,
               fmt::format("no turn '{}': 'straight', 'left', 'right', 'partially_left', "
                           "'partially_right', 'around'",
                           *name));
    return static_cast<world::Turn>(found - names.begin());
}

/// The signals that who comes along this lane looks at, ascending; of one turning where it is
/// named.
std::vector<std::uint32_t> signals_of(const world::TownT& town,
                                      std::uint32_t lane,
                                      std::optional<world::Turn> turn) {
    std::vector<std::uint32_t> found;
    for (const world::Link& link : town.lanes[lane].links)
        if (link.signal() != world::none && (!turn || link.turn() == *turn))
            found.push_back(link.signal());
    if (found.empty() && !turn)
        for (std::uint32_t i = 0; i < town.signals.size(); ++i)
            if (town.signals[i].lane == lane)
                found.push_back(i);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
}

/// The one that counts for who goes on: straight ahead where there is such a way, else the first.
std::optional<std::uint32_t> signal_of(const world::TownT& town,
                                       std::uint32_t lane,
                                       std::optional<world::Turn> turn) {
    auto found = signals_of(town, lane, turn ? turn : world::Turn::straight);
    if (found.empty() && !turn)
        found = signals_of(town, lane, std::nullopt);
    return found.empty() ? std::nullopt : std::optional(found.front());
}

std::optional<std::string> text_or_none(lua_State* L, int index, const char* who) {
    if (lua_isnoneornil(L, index))
        return std::nullopt;
    return text_at(L, index, who, "the turn");
}

std::optional<SignalColor> color_at_lane(Run& run, lua_State* L, const char* who) {
    const std::uint32_t lane = run.lane_named(L, text_at(L, 1, who, "the lane"));
    run.vm.charge(L, run.town.signals.size());
    const auto signal = signal_of(run.town, lane, turn_named(who, text_or_none(L, 2, who)));
    if (!signal)
        return std::nullopt;
    const auto colors = run.last.signals();
    return *signal < colors.size() ? colors[*signal] : SignalColor::off;
}

int signal(Run& run, lua_State* L) {
    const auto color = color_at_lane(run, L, "signal");
    if (color)
        lua_pushstring(L, world::EnumNameSignalColor(*color));
    else
        lua_pushnil(L);
    return 1;
}

/// For the prelude's wait_until_green(lane, options): the turn, and options of wait_until.
int wish_for_green(Run& run, lua_State* L) {
    const Fields options(L, 2, "wait_until_green", names_of(green_key_rows), true);
    const std::uint32_t lane = run.lane_named(L, text_at(L, 1, "wait_until_green", "the lane"));
    const auto turn = turn_named("wait_until_green", options.text("turn"));
    if (!signal_of(run.town, lane, turn))
        refuse("wait_until_green",
               fmt::format("no signal stands at the end of '{}'{}",
                           run.town.lanes[lane].name,
                           turn ? " for this turn" : ""));
    options.push("turn");
    lua_newtable(L);
    options.push("timeout");
    lua_setfield(L, -2, "timeout");
    return 2;
}

constexpr std::size_t few = 10;  ///< names in a message

/// Signals by the name of a lane or a crossing, of a junction, or of SUMO's program.
void add_signals_named(Run& run,
                       lua_State* L,
                       const std::string& name,
                       std::optional<world::Turn> turn,
                       std::vector<std::uint32_t>& signals) {
    const world::TownT& town = run.town;
    run.vm.charge(L, town.junctions.size() + town.lanes.size() + town.signals.size());
    if (const auto lane = world::find_lane(town, name)) {
        const auto found = signals_of(town, *lane, turn);
        if (found.empty())
            refuse(
                "set_signal",
                fmt::format(
                    "no signal stands at the end of '{}'{}", name, turn ? " for this turn" : ""));
        signals.insert(signals.end(), found.begin(), found.end());
        return;
    }
    if (turn)
        refuse("set_signal", "'turn' needs a lane: '" + name + "' is none");
    const auto junction = std::find_if(town.junctions.begin(),
                                       town.junctions.end(),
                                       [&](const auto& each) { return each.name == name; });
    const std::size_t before = signals.size();
    for (std::uint32_t i = 0; i < town.signals.size(); ++i) {
        const world::SignalT& each = town.signals[i];
        if (each.for_walkers)
            continue;
        const bool at_junction = junction != town.junctions.end() && each.lane != world::none &&
                                 town.lanes[each.lane].junction ==
                                     static_cast<std::uint32_t>(junction - town.junctions.begin());
        if (at_junction || each.program == name)
            signals.push_back(i);
    }
    if (signals.size() > before)
        return;
    std::vector<std::string> lit;
    for (const world::JunctionT& each : town.junctions)
        if (each.lit)
            lit.push_back(each.name);
    const std::string there =
        lit.empty()
            ? town.name + " has none"
            : fmt::format("lit in {}: {}{}",
                          town.name,
                          fmt::join(lit.begin(), lit.begin() + std::min(lit.size(), few), ", "),
                          lit.size() > few ? ", ..." : "");
    if (junction != town.junctions.end())
        refuse("set_signal", fmt::format("the junction '{}' has no signals ({})", name, there));
    const std::string hint = world::did_you_mean(name, lit);
    refuse("set_signal",
           fmt::format("no lane, junction or traffic light '{}' in {}{}",
                       name,
                       town.name,
                       hint.empty() ? " (" + there + ")" : hint));
}

std::vector<std::uint32_t> signals_at(Run& run, lua_State* L, std::optional<world::Turn> turn) {
    constexpr lua_Unsigned most_names = 100;
    std::vector<std::uint32_t> signals;
    if (lua_type(L, 1) != LUA_TTABLE) {
        const std::string name = text_at(L, 1, "set_signal", "the lane, junction or list of them");
        add_signals_named(run, L, name, turn, signals);
    } else {
        const lua_Unsigned count = lua_rawlen(L, 1);
        if (count == 0 || count > most_names)
            refuse("set_signal", "needs 1 to 100 names of lanes or junctions");
        for (lua_Unsigned i = 1; i <= count; ++i) {
            lua_rawgeti(L, 1, static_cast<lua_Integer>(i));
            const std::string name = text_at(L, -1, "set_signal", fmt::format("entry {}", i));
            add_signals_named(run, L, name, turn, signals);
            lua_pop(L, 1);
        }
    }
    std::sort(signals.begin(), signals.end());
    signals.erase(std::unique(signals.begin(), signals.end()), signals.end());
    return signals;
}

SignalColor wanted_color(lua_State* L) {
    struct Word {
        const char* word;
        SignalColor color;
    };

    constexpr std::array<Word, 5> words{{{"red", SignalColor::red},
                                         {"red_yellow", SignalColor::red_yellow},
                                         {"yellow", SignalColor::yellow},
                                         {"green", SignalColor::green},
                                         {"program", SignalColor::off}}};
    const std::string wanted = text_at(L, 2, "set_signal", "the colour");
    for (const Word& each : words)
        if (wanted == each.word)
            return each.color;
    refuse("set_signal",
           fmt::format("no colour '{}': 'red', 'red_yellow', 'yellow', 'green', or 'program' for "
                       "what the traffic light does by itself",
                       wanted));
}

int set_signal(Run& run, lua_State* L) {
    const Fields options(L, 3, "set_signal", names_of(set_signal_key_rows), true);
    const SignalColor color = wanted_color(L);
    const double duration = options.number("duration").value_or(0);
    if (options.has("duration") && !(duration > 0 && duration <= 86'400))
        refuse("set_signal", "'duration' must be in (0, 86400] s");
    if (color == SignalColor::off && options.has("duration"))
        refuse("set_signal", "'duration' has no effect with 'program'");
    auto signals = signals_at(run, L, turn_named("set_signal", options.text("turn")));
    world::CommandT& command = run.say(L, world::CommandKind::set_signal, 0);
    command.signals = std::move(signals);
    command.color = color;
    command.duration = duration;
    return 0;
}

constexpr Word environment_rows[] = {
    {"set_weather",
     acting<set_weather>,
     "(weather: WeatherName|table, options?: SetWeatherOptions)",
     "another weather by name or by numbers, at once or over a time"},
    {"signal",
     bound<signal>,
     "(lane: LaneName, turn?: "
     "'straight'|'left'|'right'|'partially_left'|'partially_right'|'around'): string?",
     "the colour at the end of the lane; nil where no signal stands"},
    {"set_signal",
     acting<set_signal>,
     "(where: string|string[], color: 'red'|'red_yellow'|'yellow'|'green'|'program', options?: "
     "SetSignalOptions)",
     "lanes or junctions: their signals show it, for a time or for good"},
    {"wait_until_green",
     nullptr,
     "(lane: LaneName, options?: GreenOptions): boolean",
     "until the light is green: true; false after the timeout"},
};

}  // namespace

constinit const WordList environment_words{Owner::global, "Weather and signals", environment_rows};
constinit const KeyList set_weather_keys{"SetWeatherOptions", "set_weather", set_weather_key_rows};
constinit const KeyList set_signal_keys{"SetSignalOptions", "set_signal", set_signal_key_rows};
constinit const KeyList green_keys{"GreenOptions", "wait_until_green", green_key_rows};

void add_environment_words(lua_State* L) {
    add_words(L, environment_words);
    add_function(L, "_wish_for_green", acting<wish_for_green>);  // for the prelude, which hides it
}

}  // namespace reprise::scripting
