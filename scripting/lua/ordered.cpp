#include "scripting/lua/ordered.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/vm.h"

namespace reprise::scripting {

namespace {

/// A table's key, comparable. Lua turns whole floats into integers when they become keys, so a
/// float key is never whole.
struct Key {
    enum class Rank : std::uint8_t { number, text, boolean } rank = Rank::number;
    bool is_integer = false;
    std::int64_t integer = 0;
    double number = 0;
    std::string_view text;  ///< Lua's own, while the table holds the key
};

bool less(std::int64_t integer, double number) {
    if (number >= 0x1p63)
        return true;
    return number > -0x1p63 && integer <= static_cast<std::int64_t>(std::floor(number));
}

bool operator<(const Key& a, const Key& b) {
    if (a.rank != b.rank)
        return a.rank < b.rank;
    if (a.rank == Key::Rank::text)
        return a.text < b.text;
    if (a.rank == Key::Rank::boolean || (a.is_integer && b.is_integer))
        return a.integer < b.integer;
    if (!a.is_integer && !b.is_integer)
        return a.number < b.number;
    return a.is_integer ? less(a.integer, b.number) : !less(b.integer, a.number);
}

Key key_at(lua_State* L, int index, const char* who) {
    Key key;
    switch (lua_type(L, index)) {
        case LUA_TNUMBER:
            key.is_integer = lua_isinteger(L, index) != 0;
            key.integer = key.is_integer ? lua_tointeger(L, index) : 0;
            key.number = lua_tonumber(L, index);
            break;
        case LUA_TSTRING:
            key.rank = Key::Rank::text;
            key.text = {lua_tostring(L, index), lua_rawlen(L, index)};
            break;
        case LUA_TBOOLEAN:
            key.rank = Key::Rank::boolean;
            key.integer = lua_toboolean(L, index);
            break;
        default:
            refuse(who, std::string("a ") + luaL_typename(L, index) + " as key has no order");
    }
    return key;
}

void push(lua_State* L, const Key& key) {
    if (key.rank == Key::Rank::text)
        lua_pushlstring(L, key.text.data(), key.text.size());
    else if (key.rank == Key::Rank::boolean)
        lua_pushboolean(L, static_cast<int>(key.integer));
    else if (key.is_integer)
        lua_pushinteger(L, key.integer);
    else
        lua_pushnumber(L, key.number);
}

void want_table(lua_State* L, int index, const char* who) {
    if (lua_type(L, index) != LUA_TTABLE)
        refuse(who, std::string("a table is needed, got ") + luaL_typename(L, index));
}

std::vector<Key> sorted_keys(lua_State* L, int table, const char* who) {
    std::vector<Key> keys;
    std::size_t bytes = 0;
    lua_pushnil(L);
    while (lua_next(L, table) != 0) {
        lua_pop(L, 1);
        keys.push_back(key_at(L, -1, who));
        bytes += keys.back().text.size();
    }
    Vm::of(L).charge_walk(L, keys.size() + bytes / 64);
    std::sort(keys.begin(), keys.end());
    return keys;
}

/// Upvalues: the table, its keys in order, how many were visited. Deleted entries are skipped.
int next_pair(lua_State* L) {
    lua_Integer visited = lua_tointeger(L, lua_upvalueindex(3));
    for (;;) {
        lua_rawgeti(L, lua_upvalueindex(2), ++visited);
        if (lua_isnil(L, -1))
            return 1;
        lua_pushvalue(L, -1);
        lua_rawget(L, lua_upvalueindex(1));
        if (!lua_isnil(L, -1))
            break;
        lua_pop(L, 2);
    }
    lua_pushinteger(L, visited);
    lua_replace(L, lua_upvalueindex(3));
    return 2;
}

/// Is the value at `right` to come before the one at `left`? Both are positions in the table at 1.
bool comes_before(lua_State* L, int right, int left) {
    const bool by_function = !lua_isnoneornil(L, 2);
    if (by_function)
        lua_pushvalue(L, 2);
    lua_rawgeti(L, 1, right);
    lua_rawgeti(L, 1, left);
    bool before = false;
    if (by_function) {
        lua_call(L, 2, 1);
        before = lua_toboolean(L, -1) != 0;
        lua_pop(L, 1);
    } else {
        before = lua_compare(L, -2, -1, LUA_OPLT) != 0;
        lua_pop(L, 2);
    }
    return before;
}

/// Merges neighbouring runs of `width` from source to target. Written out because the standard
/// library's sorts may run off the end when an order contradicts itself.
void merge_runs(lua_State* L,
                std::size_t width,
                const std::vector<int>& source,
                std::vector<int>& target) {
    const std::size_t size = source.size();
    for (std::size_t start = 0; start < size; start += 2 * width) {
        const std::size_t middle = std::min(start + width, size);
        const std::size_t end = std::min(start + 2 * width, size);
        std::size_t left = start;
        std::size_t right = middle;
        for (std::size_t i = start; i < end; ++i) {
            const bool take_right =
                left == middle || (right < end && comes_before(L, source[right], source[left]));
            target[i] = take_right ? source[right++] : source[left++];
        }
    }
}

}  // namespace

int ordered_pairs(lua_State* L) {
    want_table(L, 1, "pairs");
    const std::vector<Key> keys = sorted_keys(L, 1, "pairs");
    lua_pushvalue(L, 1);
    lua_createtable(L, static_cast<int>(keys.size()), 0);
    lua_Integer position = 0;
    for (const Key& key : keys) {
        push(L, key);
        lua_rawseti(L, -2, ++position);
    }
    lua_pushinteger(L, 0);
    lua_pushcclosure(L, next_pair, 3);
    return 1;
}

int ordered_next(lua_State* L) {
    want_table(L, 1, "next");
    const bool first = lua_isnoneornil(L, 2);
    const Key last = first ? Key{} : key_at(L, 2, "next");
    std::optional<Key> nearest;
    std::size_t entries = 0;
    lua_pushnil(L);
    while (lua_next(L, 1) != 0) {
        lua_pop(L, 1);
        const Key key = key_at(L, -1, "next");
        entries += 1 + key.text.size() / 64;
        if ((first || last < key) && (!nearest || key < *nearest))
            nearest = key;
    }
    Vm::of(L).charge_walk(L, entries);
    if (!nearest) {
        lua_pushnil(L);
        return 1;
    }
    push(L, *nearest);
    push(L, *nearest);
    lua_rawget(L, 1);
    return 2;
}

int stable_sort(lua_State* L) {
    want_table(L, 1, "table.sort");
    if (!lua_isnoneornil(L, 2))
        want_function(L, 2, "table.sort", "the order");
    const auto size = static_cast<std::size_t>(lua_rawlen(L, 1));
    std::vector<int> order(size);
    for (std::size_t i = 0; i < size; ++i)
        order[i] = static_cast<int>(i) + 1;
    std::vector<int> merged = order;
    for (std::size_t width = 1; width < size; width *= 2) {
        Vm::of(L).charge(L, size * 8);
        merge_runs(L, width, order, merged);
        order.swap(merged);
    }
    // Into a copy first: the sorted positions refer to the table as it was.
    lua_settop(L, 1);
    lua_createtable(L, static_cast<int>(size), 0);
    for (std::size_t i = 0; i < size; ++i) {
        lua_rawgeti(L, 1, order[i]);
        lua_rawseti(L, 2, static_cast<lua_Integer>(i) + 1);
    }
    for (std::size_t i = 0; i < size; ++i) {
        lua_rawgeti(L, 2, static_cast<lua_Integer>(i) + 1);
        lua_rawseti(L, 1, static_cast<lua_Integer>(i) + 1);
    }
    return 0;
}

}  // namespace reprise::scripting
