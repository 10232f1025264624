#include "scripting/run/weathers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"
#include "scripting/run/tasks.h"
#include "world/check.h"
#include "world/weather/weather_field.h"
#include "world/weather/weather_mix.h"
#include "world/weather/weather_text.h"

namespace reprise::scripting {

namespace {

using world::Weather;
using world::WeatherField;

/// A row of the weather's numbers: those that scripts of old could not say leave no trace in Lua
/// when they are not said.
std::optional<double> said_number(const Fields& fields, const WeatherField& field) {
    if (!fields.mentions(field.key))
        return std::nullopt;
    const auto value = fields.number(field.key);
    if (value && (*value < field.low || *value > field.high))
        refuse(fields.who(),
               fmt::format("'{}' must be in [{}, {}], got {}",
                           field.key,
                           number_text(field.low),
                           number_text(field.high),
                           number_text(*value)));
    return value;
}

Weather numbers(const Fields& fields, const Weather& before) {
    Weather weather = before;
    std::vector<const WeatherField*> seen;
    for (const WeatherField& field : world::weather_fields()) {
        const auto value = said_number(fields, field);
        if (!value)
            continue;
        for (const WeatherField* earlier : seen)
            if (earlier->get == field.get)
                refuse(fields.who(),
                       fmt::format("'{}' and '{}' say the same", earlier->key, field.key));
        seen.push_back(&field);
        (weather.*field.set)(field.kept(*value));
    }
    return weather;
}

SaidWeather said_by(const Fields& fields, const SaidWeather& before) {
    SaidWeather said = before;
    said.names_friction = false;
    if (const auto preset = fields.text("preset"))
        said = preset_weather(fields.who(), *preset);
    const Weather base = said.weather;
    said.weather = numbers(fields, base);
    if (const auto friction = fields.number("friction")) {
        said.friction = check_friction(fields.who(), *friction);
        said.names_friction = true;
    }
    constexpr std::string_view mark = ", changed";
    const bool changed = !(said.weather == base) || said.names_friction;
    if (changed && !std::string_view(said.name).ends_with(mark))
        said.name += mark;
    return said;
}

std::vector<std::string> keys(bool timed) {
    std::vector<std::string> all{"preset"};
    for (const WeatherField& field : world::weather_fields())
        all.emplace_back(field.key);
    all.emplace_back("friction");
    if (timed)
        all.insert(all.end(), {"at", "over"});
    return all;
}

}  // namespace

double check_friction(const std::string& who, double friction) {
    if (!(friction > 0 && friction <= 2))
        refuse(
            who,
            fmt::format("'friction' must be in (0, 2], as a factor on dry asphalt's grip, got {}",
                        number_text(friction)));
    return friction;
}

SaidWeather preset_weather(const std::string& who, const std::string& text) {
    try {
        const world::WeatherPreset preset = world::read_weather(text);
        return {preset.weather, preset.road_friction, false, preset.name};
    } catch (const world::Error& error) {
        refuse(who, error.what());
    }
}

SaidWeather weather_at_top(lua_State* L, const std::string& who, const SaidWeather& before) {
    if (lua_type(L, -1) == LUA_TSTRING)
        return preset_weather(who, text_of(L, -1));
    return said_by(Fields(L, -1, who, keys(false)), before);
}

WeatherEntry weather_entry_at_top(lua_State* L, const std::string& who, const SaidWeather& before) {
    const Fields fields(L, -1, who, keys(true));
    WeatherEntry entry;
    const auto at = fields.number("at");
    if (!at)
        refuse(who, "an entry of a timeline needs its time: { at = 10, rain_mm_h = 5 }");
    entry.at = *at;
    entry.over = fields.number("over").value_or(0);
    for (const double time : {entry.at, entry.over})
        if (time < 0 || time > 86'400)
            refuse(who, "'at' and 'over' must be in [0, 86400] s");
    entry.said = said_by(fields, before);
    return entry;
}

void Weathers::plan(std::vector<WeatherEntry> timeline, std::optional<double> fixed_friction) {
    timeline_ = std::move(timeline);
    fixed_friction_ = fixed_friction;
}

void Weathers::begin(const WeatherEntry& to, const world::TickView& last, std::uint64_t step_ns) {
    Change change{*last.tick->weather(),
                  last.tick->road_friction(),
                  to.said,
                  last.index(),
                  std::max<std::uint64_t>(1, ticks_of(to.over, step_ns)),
                  to.line};
    if (fixed_friction_ && !to.said.names_friction)
        change.to.friction = change.friction_from;
    change_ = std::move(change);
}

void Weathers::change(const WeatherEntry& to,
                      const world::TickView& last,
                      std::uint64_t step_ns,
                      world::CommandT& command) {
    begin(to, last, step_ns);
    fill(command, last);
}

/// What the change under way makes of the weather in the next tick; done with its last one.
void Weathers::fill(world::CommandT& command, const world::TickView& last) {
    const Change& change = *change_;
    const std::uint64_t passed = last.index() + 1 - change.start;
    const double share = static_cast<double>(passed) / static_cast<double>(change.ticks);
    const double way = change.to.friction - change.friction_from;
    command.kind = world::CommandKind::set_weather;
    command.lane = world::none;
    command.line = change.line;
    command.text = change.to.name;
    command.weather = mixed(change.from, change.to.weather, share);
    command.road_friction = share >= 1 ? change.to.friction : change.friction_from + share * way;
    if (passed >= change.ticks)
        change_.reset();
}

void Weathers::advance(const world::TickView& last, world::TickDraft& next, std::uint64_t step_ns) {
    for (; next_entry_ < timeline_.size() &&
           ticks_of(timeline_[next_entry_].at, step_ns) <= last.index();
         ++next_entry_)
        begin(timeline_[next_entry_], last, step_ns);
    if (change_)
        fill(next.tick.commands.emplace_back(), last);
}

void Weathers::digest(world::Hasher& hasher) const {
    if (next_entry_ > 0)
        hasher.add(std::uint64_t{next_entry_});
    if (change_) {
        hasher.add(change_->start);
        hasher.add(change_->ticks);
        hasher.add(change_->to.weather);
        hasher.add(change_->to.friction);
    }
}

}  // namespace reprise::scripting
