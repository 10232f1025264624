#include "scripting/lua/metatables.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"
#include "world/check.h"

namespace reprise::scripting {

namespace {

/// The key under which a metatable's copy holds the original. No metatable of a script's is asked
/// for it.
constexpr lua_Integer original_metatable = 1;

constexpr lua_Integer longest_chain = 16;  // tables

/// Pushes the table that is asked where the one at the top has no answer. False: nothing pushed.
bool push_next_of_chain(lua_State* L, const char* field) {
    if (luaL_getmetafield(L, -1, field) == LUA_TNIL)
        return false;
    if (lua_type(L, -1) == LUA_TTABLE)
        return true;
    lua_pop(L, 1);
    return false;
}

lua_Integer depth_below(lua_State* L, const char* field) {
    const int top = lua_gettop(L);
    luaL_checkstack(L, longest_chain + 4, "a chain of metatables");
    lua_Integer depth = 0;
    lua_pushvalue(L, -1);
    while (depth <= longest_chain && push_next_of_chain(L, field))
        ++depth;
    lua_settop(L, top);
    return depth;
}

/// How many tables are asked before this one, by table; forgets tables that nobody holds.
void push_heights(lua_State* L, const char* field) {
    if (luaL_getsubtable(L, LUA_REGISTRYINDEX, field) != 0)
        return;
    lua_createtable(L, 0, 1);
    lua_pushliteral(L, "k");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, -2);
}

/// The table at 1 will ask the one at the top of the stack.
void limit_chain(lua_State* L, const char* field) {
    const int target = lua_gettop(L);
    push_heights(L, field);
    const int heights = target + 1;
    lua_pushvalue(L, 1);
    lua_rawget(L, heights);
    lua_Integer height = lua_tointeger(L, -1) + 1;
    lua_settop(L, heights);
    lua_pushvalue(L, target);
    const lua_Integer depth = height + depth_below(L, field);
    if (depth > longest_chain)
        refuse("setmetatable",
               fmt::format("a chain of more than {} tables by {}", longest_chain, field));
    Vm::of(L).note_chain(static_cast<std::size_t>(depth));
    luaL_checkstack(L, longest_chain + 4, "a chain of metatables");
    do {
        lua_pushvalue(L, -1);
        lua_rawget(L, heights);
        const lua_Integer known = lua_tointeger(L, -1);
        lua_pop(L, 1);
        lua_pushvalue(L, -1);
        lua_pushinteger(L, std::max(known, height));
        lua_rawset(L, heights);
        ++height;
    } while (push_next_of_chain(L, field));
    lua_settop(L, target);
}

/// The entry at the top of the stack: its key below its value.
void inspect(lua_State* L) {
    if (lua_type(L, -2) != LUA_TSTRING)
        return;
    const std::string key = text_of(L, -2);
    if (key == "__gc" || key == "__mode")
        refuse("setmetatable",
               key + " acts when memory is collected, which a scenario must not notice");
    if (key == "__call" && lua_type(L, -1) != LUA_TFUNCTION)
        refuse("setmetatable", "__call must be a function");
    for (const char* const field : {"__index", "__newindex"})
        if (key == field && lua_type(L, -1) == LUA_TTABLE)
            limit_chain(L, field);
}

/// Of the table at 2, into the new one at 3.
void copy_metatable(lua_State* L) {
    std::size_t entries = 0;
    lua_pushnil(L);
    while (lua_next(L, 2) != 0) {
        ++entries;
        inspect(L);
        lua_pushvalue(L, -2);
        lua_insert(L, -2);
        lua_rawset(L, 3);
    }
    lua_pushvalue(L, 2);
    lua_rawseti(L, 3, original_metatable);
    Vm::of(L).charge_walk(L, entries);
}

}  // namespace

int set_metatable(lua_State* L) {
    if (lua_type(L, 1) != LUA_TTABLE || (!lua_isnil(L, 2) && lua_type(L, 2) != LUA_TTABLE))
        throw world::Error("setmetatable: needs a table and a metatable (or nil)");
    if (luaL_getmetafield(L, 1, "__metatable") != LUA_TNIL)
        throw world::Error("setmetatable: this metatable is protected");
    lua_settop(L, 2);
    if (!lua_isnil(L, 2)) {
        lua_newtable(L);
        copy_metatable(L);
    }
    lua_setmetatable(L, 1);
    lua_settop(L, 1);
    return 1;
}

int get_metatable(lua_State* L) {
    if (lua_type(L, 1) != LUA_TTABLE || lua_getmetatable(L, 1) == 0)
        return 0;
    if (lua_getfield(L, -1, "__metatable") != LUA_TNIL)
        return 1;
    lua_rawgeti(L, -2, original_metatable);
    return 1;
}

}  // namespace reprise::scripting
