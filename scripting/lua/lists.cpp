#include "scripting/lua/lists.h"

#include <cstdint>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"

namespace reprise::scripting {

namespace {

void want_list(lua_State* L, int index, const char* who) {
    if (lua_type(L, index) != LUA_TTABLE)
        refuse(who, std::string("a table is needed, got ") + luaL_typename(L, index));
}

std::int64_t size_of(lua_State* L, int index) {
    return static_cast<std::int64_t>(lua_rawlen(L, index));
}

std::int64_t position_or(
    lua_State* L, int index, const char* who, const char* what, std::int64_t otherwise) {
    return lua_isnoneornil(L, index) ? otherwise : integer_at(L, index, who, what);
}

/// How many elements [first, last] has; refuses what cannot be in memory.
std::uint64_t count_of(const char* who, std::int64_t first, std::int64_t last) {
    if (first > last)
        return 0;
    const std::uint64_t count =
        static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first) + 1;
    constexpr std::uint64_t most = 1'000'000;
    if (count == 0 || count > most)
        refuse(who, "more than 1,000,000 elements in one call");
    return count;
}

void copy_element(lua_State* L, std::int64_t source, int to_table, std::int64_t target) {
    lua_rawgeti(L, 1, source);
    lua_rawseti(L, to_table, target);
}

}  // namespace

int insert_element(lua_State* L) {
    want_list(L, 1, "table.insert");
    const std::int64_t end = size_of(L, 1) + 1;
    const int arguments = lua_gettop(L);
    if (arguments != 2 && arguments != 3)
        refuse("table.insert", "needs a table, perhaps a position, and one value");
    std::int64_t position = end;
    if (arguments == 3)
        position = integer_at(L, 2, "table.insert", "the position");
    if (position < 1 || position > end)
        refuse("table.insert",
               fmt::format("the position must be in [1, {}], got {}", end, position));
    Vm::of(L).charge(L, static_cast<std::uint64_t>(end - position) + 2);
    for (std::int64_t i = end; i > position; --i)
        copy_element(L, i - 1, 1, i);
    lua_rawseti(L, 1, position);
    return 0;
}

int remove_element(lua_State* L) {
    want_list(L, 1, "table.remove");
    const std::int64_t size = size_of(L, 1);
    const std::int64_t position = position_or(L, 2, "table.remove", "the position", size);
    // As in Lua: the place behind the end may be named, and 0 in an empty list.
    const bool at_the_end = position == size + 1 || (size == 0 && position == 0);
    if (!at_the_end && (position < 1 || position > size))
        refuse("table.remove",
               fmt::format("the position must be in [1, {}], got {}", size + 1, position));
    if (!at_the_end)
        Vm::of(L).charge(L, static_cast<std::uint64_t>(size - position) + 2);
    lua_rawgeti(L, 1, position);
    for (std::int64_t i = position; i < size; ++i)
        copy_element(L, i + 1, 1, i);
    lua_pushnil(L);
    lua_rawseti(L, 1, at_the_end ? position : size);
    return 1;
}

int join_elements(lua_State* L) {
    const char* const who = "table.concat";
    want_list(L, 1, who);
    const std::string separator = lua_isnoneornil(L, 2) ? "" : text_at(L, 2, who, "the separator");
    const std::int64_t first = position_or(L, 3, who, "the first position", 1);
    const std::int64_t last = position_or(L, 4, who, "the last position", size_of(L, 1));
    const std::uint64_t count = count_of(who, first, last);
    Vm::of(L).charge(L, count * 4 + 5);
    std::string joined;
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::int64_t position = first + static_cast<std::int64_t>(i);
        const int type = lua_rawgeti(L, 1, position);
        if (type != LUA_TSTRING && type != LUA_TNUMBER)
            refuse(who,
                   fmt::format("element {} is a {}: only strings and numbers are joined",
                               position,
                               lua_typename(L, type)));
        joined += (i == 0 ? "" : separator) + text_of(L, -1);
        lua_pop(L, 1);
        if (joined.size() > longest_text)
            refuse(who, "the result would be longer than 64 kB");
    }
    lua_pushlstring(L, joined.data(), joined.size());
    return 1;
}

int unpack_elements(lua_State* L) {
    const char* const who = "table.unpack";
    want_list(L, 1, who);
    const std::int64_t first = position_or(L, 2, who, "the first position", 1);
    const std::int64_t last = position_or(L, 3, who, "the last position", size_of(L, 1));
    const std::uint64_t count = count_of(who, first, last);
    Vm::of(L).charge(L, count + 5);
    const int values = static_cast<int>(count);
    luaL_checkstack(L, values, "too many results to unpack");
    for (int i = 0; i < values; ++i)
        lua_rawgeti(L, 1, first + i);
    return values;
}

int move_elements(lua_State* L) {
    const char* const who = "table.move";
    want_list(L, 1, who);
    const std::int64_t first = integer_at(L, 2, who, "the first position");
    const std::int64_t last = integer_at(L, 3, who, "the last position");
    const std::int64_t target = integer_at(L, 4, who, "the target");
    const int table = lua_isnoneornil(L, 5) ? 1 : 5;
    want_list(L, table, who);
    const std::uint64_t count = count_of(who, first, last);
    Vm::of(L).charge(L, count + 5);
    const auto size = static_cast<std::int64_t>(count);
    if (size > 0 && target > INT64_MAX - size + 1)
        refuse(who, "the target lies too far");
    const bool from_the_end = target > first && target <= last && lua_rawequal(L, 1, table) != 0;
    for (std::int64_t i = 0; i < size; ++i) {
        const std::int64_t offset = from_the_end ? size - 1 - i : i;
        copy_element(L, first + offset, table, target + offset);
    }
    lua_pushvalue(L, table);
    return 1;
}

}  // namespace reprise::scripting
