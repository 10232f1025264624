#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/literals.h"
#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"
#include "scripting/words/header.h"
#include "scripting/words/vocabulary.h"
#include "world/check.h"
#include "world/lanes/density.h"

namespace reprise::scripting {

namespace {

constexpr double longest_run = 86'400;  // [s] a day
constexpr std::int64_t most_cars = 10'000;
constexpr std::int64_t most_walkers = 2'000;

bool is_word(const std::string& text) {
    constexpr const char* letters =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    return !text.empty() && text.find_first_not_of(letters) == std::string::npos;
}

/// The table `params` at the top of the stack.
std::map<std::string, Value> read_parameters(lua_State* L) {
    std::map<std::string, Value> parameters;
    std::optional<std::string> wrong;
    lua_pushnil(L);
    while (lua_next(L, -2) != 0) {
        const auto value = to_value(L, -1);
        const bool named = lua_type(L, -2) == LUA_TSTRING && is_word(text_of(L, -2));
        const std::string key = named ? text_of(L, -2) : "";
        if (!named)
            refuse("scenario", "params: every parameter needs a name: params = { gap = 12 }");
        const double* number = value ? std::get_if<double>(&*value) : nullptr;
        const bool usable = value && (number == nullptr || parse_number(number_text(*number)));
        if (!usable && (!wrong || key < *wrong))
            wrong = key;
        if (usable)
            parameters.emplace(key, *value);
        lua_pop(L, 1);
    }
    if (wrong)
        refuse(
            "scenario",
            fmt::format("params: '{}' must be a finite number, a string, true or false", *wrong));
    return parameters;
}

/// A list of entries, each { at =, over =, ... }; the first is the weather at the start.
void read_timeline(lua_State* L, Header& header) {
    constexpr lua_Unsigned most_entries = 1000;
    const lua_Unsigned count = lua_rawlen(L, -1);
    if (count > most_entries)
        refuse("scenario", fmt::format("a weather of more than {} entries", most_entries));
    SaidWeather before = header.weather;
    for (lua_Unsigned i = 1; i <= count; ++i) {
        lua_rawgeti(L, -1, static_cast<lua_Integer>(i));
        const std::string who = fmt::format("scenario: weather, entry {}", i);
        WeatherEntry entry = weather_entry_at_top(L, who, before);
        lua_pop(L, 1);
        entry.line = header.line;
        before = entry.said;
        if (i == 1 && (entry.at != 0 || entry.over != 0))
            refuse(who, "the first one is the weather at the start: at = 0, without 'over'");
        if (i == 1) {
            header.weather = entry.said;
            continue;
        }
        if (entry.at <= (header.timeline.empty() ? 0 : header.timeline.back().at))
            refuse(who, "comes before the one above it: entries are in the order of 'at'");
        header.timeline.push_back(std::move(entry));
    }
}

void read_weather(lua_State* L, const Fields& fields, Header& header) {
    header.weather = preset_weather("scenario", "clear_noon");
    fields.push("weather");
    if (lua_type(L, -1) == LUA_TTABLE && lua_rawlen(L, -1) > 0)
        read_timeline(L, header);
    else if (!lua_isnil(L, -1))
        header.weather = weather_at_top(
            L, lua_type(L, -1) == LUA_TSTRING ? "scenario" : "scenario: weather", header.weather);
    lua_pop(L, 1);
    if (const auto friction = fields.number("friction")) {
        header.friction = check_friction("scenario", *friction);
        if (!header.weather.names_friction)
            header.weather.friction = *friction;
    }
}

/// Of the background traffic: a number, or 'auto'.
std::uint32_t read_cars(lua_State* L, const Fields& fields) {
    fields.push("cars");
    const bool is_text = lua_type(L, -1) == LUA_TSTRING;
    lua_pop(L, 1);
    if (is_text) {
        const std::string said = fields.text("cars").value_or("");
        if (said != "auto")
            refuse("scenario",
                   fmt::format("'cars' must be a whole number or 'auto', got '{}'", said));
        return world::auto_cars;
    }
    const std::int64_t cars = fields.integer("cars").value_or(0);
    if (cars < 0 || cars > most_cars)
        refuse("scenario", fmt::format("'cars' must be in [0, {}]", most_cars));
    return static_cast<std::uint32_t>(cars);
}

constexpr Key header_key_rows[] = {
    {"town", "string", "its name, or the path of a network; default 'town1', --town overrides"},
    {"duration", "number", "[s] the run's limit; default 60, --for overrides"},
    {"seed", "integer", "of everything that is drawn; default 0, --seed overrides"},
    {"cars",
     "integer|'auto'",
     "of the background traffic, 0 to 10,000, or 'auto': as many as the town carries; default 0, "
     "--cars overrides"},
    {"walkers",
     "integer",
     "people on foot in the background, 0 to 2,000; default 0, --walkers overrides"},
    {"walker_seed", "integer", "who they are and where they go; default the seed"},
    {"jaywalkers", "number", "[0, 1] share of them that crosses the road anywhere; default 0.1"},
    {"weather",
     "WeatherName|table|table[]",
     "a preset's name, numbers, or a timeline of { at =, over =, ... }; default 'clear_noon'"},
    {"friction",
     "number",
     "factor on dry asphalt's grip, whatever the weather; default the weather's"},
    {"params",
     "table<string, number|string|boolean>",
     "the run function's parameters with their defaults; --set overrides"},
    {"run", "fun(p: table<string, any>)", "what happens; its end is the run's end", true},
};

void read_walkers(const Fields& fields, Header& header) {
    const std::int64_t walkers = fields.integer("walkers").value_or(0);
    if (walkers < 0 || walkers > most_walkers)
        refuse("scenario", fmt::format("'walkers' must be in [0, {}]", most_walkers));
    header.walkers = static_cast<std::uint32_t>(walkers);
    if (const auto seed = fields.integer("walker_seed")) {
        if (*seed < 0)
            refuse("scenario", "'walker_seed' must not be below 0");
        header.walker_seed = static_cast<std::uint64_t>(*seed);
    }
    header.jaywalkers = fields.number("jaywalkers").value_or(header.jaywalkers);
    if (header.jaywalkers < 0 || header.jaywalkers > 1)
        refuse("scenario", "'jaywalkers' must be in [0, 1]: a share of the walkers");
}

/// The call with the table. Upvalue 1: the name. Returns the table as the mark of a scenario.
int take_table(lua_State* L) {
    Vm& vm = Vm::of(L);
    const Fields fields(L, 1, "scenario", names_of(header_key_rows));
    if (vm.header == nullptr || vm.header->run != 0)
        refuse("scenario", "a file holds one scenario");
    Header header;
    header.line = vm.line(L);
    header.name = text_of(L, lua_upvalueindex(1));
    header.town = fields.text("town").value_or(header.town);
    read_weather(L, fields, header);
    header.has_duration = fields.has("duration");
    for (const char* key :
         {"town", "seed", "cars", "walkers", "walker_seed", "jaywalkers", "weather", "friction"})
        if (fields.has(key))
            header.of_world = key;
    header.duration = fields.number("duration").value_or(header.duration);
    if (header.duration <= 0 || header.duration > longest_run)
        refuse("scenario", "'duration' must be in (0, 86400] s");
    const std::int64_t seed = fields.integer("seed").value_or(0);
    if (seed < 0)
        refuse("scenario", "'seed' must not be below 0");
    header.seed = static_cast<std::uint64_t>(seed);
    header.cars = read_cars(L, fields);
    read_walkers(fields, header);
    if (fields.has("params")) {
        fields.push("params");
        if (lua_type(L, -1) != LUA_TTABLE)
            refuse("scenario", "'params' must be a table: params = { gap = 12 }");
        header.parameters = read_parameters(L);
        lua_pop(L, 1);
    }
    fields.push("run");
    want_function(L, -1, "scenario", "'run'");
    header.run = luaL_ref(L, LUA_REGISTRYINDEX);
    *vm.header = header;
    lua_settop(L, 1);
    return 1;
}

int scenario(lua_State* L) {
    const std::string name = text_at(L, 1, "scenario", "the name");
    if (!is_word(name))
        refuse("scenario",
               fmt::format("the name '{}' must be made of letters, digits and _", name));
    lua_settop(L, 1);
    lua_pushcclosure(L, guarded<take_table>, 1);
    return 1;
}

constexpr Word header_rows[] = {
    {"scenario",
     guarded<scenario>,
     "(name: string): fun(header: ScenarioHeader): table",
     "the file's last statement: return scenario 'name' { ... }"},
};

}  // namespace

constinit const WordList header_words{Owner::global, "The file", header_rows};
constinit const KeyList header_keys{"ScenarioHeader", "scenario", header_key_rows};

void add_header_words(lua_State* L) {
    add_words(L, header_words);
}

}  // namespace reprise::scripting
