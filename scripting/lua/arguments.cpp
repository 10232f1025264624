#include "scripting/lua/arguments.h"

#include <cmath>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

constexpr double kmh = 1 / 3.6;  // [m/s]

[[noreturn]] void refuse_type(
    lua_State* L, int index, std::string_view who, std::string_view what, std::string_view wanted) {
    std::string got = lua_isnone(L, index) ? "nothing" : luaL_typename(L, index);
    if (lua_type(L, index) == LUA_TNUMBER || lua_type(L, index) == LUA_TSTRING)
        got = lua_type(L, index) == LUA_TSTRING ? "'" + text_of(L, index) + "'" : text_of(L, index);
    refuse(who, fmt::format("{} must be {}, got {}", what, wanted, got));
}

std::string named(std::string_view key) {
    return fmt::format("'{}'", key);
}

}  // namespace

void refuse(std::string_view who, const std::string& message) {
    throw world::Error(fmt::format("{}: {}", who, message));
}

double number_at(lua_State* L, int index, std::string_view who, std::string_view what) {
    if (lua_type(L, index) != LUA_TNUMBER)
        refuse_type(L, index, who, what, "a number");
    const double number = lua_tonumber(L, index);
    if (!std::isfinite(number))
        refuse_type(L, index, who, what, "a finite number");
    return number;
}

std::int64_t integer_at(lua_State* L, int index, std::string_view who, std::string_view what) {
    int whole = 0;
    const lua_Integer integer = lua_tointegerx(L, index, &whole);
    if (lua_type(L, index) != LUA_TNUMBER || whole == 0)
        refuse_type(L, index, who, what, "a whole number");
    return integer;
}

std::string text_at(lua_State* L, int index, std::string_view who, std::string_view what) {
    if (lua_type(L, index) != LUA_TSTRING)
        refuse_type(L, index, who, what, "a string");
    return text_of(L, index);
}

std::string name_at(lua_State* L, int index, std::string_view who, std::string_view what) {
    constexpr std::size_t longest_name = 100;
    const std::string name = text_at(L, index, who, what);
    if (name.empty() || name.size() > longest_name)
        refuse(who,
               fmt::format(
                   "{} must have 1 to {} characters, has {}", what, longest_name, name.size()));
    if (printable(name) != name)
        refuse(who, fmt::format("{} holds what cannot be shown: '{}'", what, printable(name)));
    return name;
}

void want_function(lua_State* L, int index, std::string_view who, std::string_view what) {
    if (lua_type(L, index) != LUA_TFUNCTION)
        refuse_type(L, index, who, what, "a function");
}

Fields::Fields(
    lua_State* L, int index, std::string who, std::vector<std::string> allowed, bool optional)
    : L_(L),
      index_(lua_absindex(L, index)),
      who_(std::move(who)) {
    if (optional && lua_isnoneornil(L, index_)) {
        index_ = 0;
        return;
    }
    if (lua_type(L, index_) != LUA_TTABLE)
        refuse_type(L, index_, who_, "the argument", "a table { key = value }");
    refuse_others(allowed);
}

/// Of several unknown keys the first in the alphabet is named: Lua's own order differs every run.
void Fields::refuse_others(const std::vector<std::string>& allowed) const {
    std::optional<std::string> unknown;
    bool positional = false;
    std::size_t entries = 0;
    lua_pushnil(L_);
    while (lua_next(L_, index_) != 0) {
        lua_pop(L_, 1);
        ++entries;
        if (lua_type(L_, -1) != LUA_TSTRING) {
            positional = true;
            continue;
        }
        const std::string key = text_of(L_, -1);
        bool known = false;
        for (const std::string& name : allowed)
            known = known || name == key;
        if (!known && (!unknown || key < *unknown))
            unknown = key;
    }
    Vm::of(L_).charge_walk(L_, entries);
    if (unknown) {
        std::string hint = world::did_you_mean(*unknown, allowed);
        if (hint.empty()) {
            hint = " (known:";
            for (const std::string& name : allowed)
                hint += (name == allowed.front() ? " " : ", ") + name;
            hint += ")";
        }
        refuse(who_, fmt::format("unknown key '{}'{}", *unknown, hint));
    }
    if (positional)
        refuse(who_, "every value needs its key: { key = value }");
}

void Fields::push(const char* key) const {
    if (index_ == 0) {
        lua_pushnil(L_);
        return;
    }
    lua_pushstring(L_, key);
    lua_rawget(L_, index_);
}

bool Fields::has(const char* key) const {
    push(key);
    const bool there = !lua_isnil(L_, -1);
    lua_pop(L_, 1);
    return there;
}

bool Fields::mentions(std::string_view key) const {
    bool found = false;
    if (index_ != 0)
        for (lua_pushnil(L_); lua_next(L_, index_) != 0;) {
            lua_pop(L_, 1);
            found = found || (lua_type(L_, -1) == LUA_TSTRING && text_of(L_, -1) == key);
        }
    return found;
}

std::optional<double> Fields::number(const char* key) const {
    push(key);
    std::optional<double> value;
    if (!lua_isnil(L_, -1))
        value = number_at(L_, -1, who_, named(key));
    lua_pop(L_, 1);
    return value;
}

std::optional<std::int64_t> Fields::integer(const char* key) const {
    push(key);
    std::optional<std::int64_t> value;
    if (!lua_isnil(L_, -1))
        value = integer_at(L_, -1, who_, named(key));
    lua_pop(L_, 1);
    return value;
}

std::optional<std::string> Fields::text(const char* key) const {
    push(key);
    std::optional<std::string> value;
    if (!lua_isnil(L_, -1))
        value = text_at(L_, -1, who_, named(key));
    lua_pop(L_, 1);
    return value;
}

std::optional<std::string> Fields::name(const char* key) const {
    push(key);
    std::optional<std::string> value;
    if (!lua_isnil(L_, -1))
        value = name_at(L_, -1, who_, named(key));
    lua_pop(L_, 1);
    return value;
}

std::optional<bool> Fields::flag(const char* key) const {
    push(key);
    std::optional<bool> value;
    if (!lua_isnil(L_, -1)) {
        if (lua_type(L_, -1) != LUA_TBOOLEAN)
            refuse_type(L_, -1, who_, named(key), "true or false");
        value = lua_toboolean(L_, -1) != 0;
    }
    lua_pop(L_, 1);
    return value;
}

std::optional<double> Fields::speed() const {
    const auto metric = number("speed");
    const auto hourly = number("speed_kmh");
    if (metric && hourly)
        refuse(who_, "give 'speed' or 'speed_kmh', not both");
    const std::optional<double> speed = hourly ? *hourly * kmh : metric;
    if (speed && *speed < 0)
        refuse(who_, fmt::format("the speed must not be below 0, got {}", number_text(*speed)));
    return speed;
}

}  // namespace reprise::scripting
