#include "scripting/lua/limits.h"

#include <cstdint>
#include <string>

#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/vm.h"

namespace reprise::scripting {

namespace {

constexpr int call_cost = 5;           // [instructions] of any stock function
constexpr std::size_t few_bytes = 32;  // texts that cost nothing
constexpr int few_arguments = 16;      // that cost nothing

/// Upvalue 1: the stock function. Called in this very frame, so that its messages know its name.
int call_stock(lua_State* L) {
    return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

bool is_light_function(lua_State* L, int index) {
    if (lua_iscfunction(L, index) == 0)
        return false;
    const bool has_upvalues = lua_getupvalue(L, index, 1) != nullptr;
    if (has_upvalues)
        lua_pop(L, 1);
    return !has_upvalues;
}

}  // namespace

template <int first>
int metered(lua_State* L) {
    std::uint64_t cost = call_cost;
    const int arguments = lua_gettop(L);
    for (int index = first; index <= arguments; ++index)
        if (lua_type(L, index) == LUA_TSTRING && lua_rawlen(L, index) > few_bytes)
            cost += lua_rawlen(L, index) / 4;
    if (arguments > few_arguments)
        cost += static_cast<std::uint64_t>(arguments) / 2;
    Vm::of(L).charge(L, cost);
    const int results = call_stock(L);
    for (int index = lua_gettop(L) - results + 1; index <= lua_gettop(L); ++index)
        if (is_light_function(L, index)) {
            lua_pushnil(L);
            lua_pushcclosure(L, lua_tocfunction(L, index), 1);
            lua_replace(L, index);
        }
    if (results > 1)
        Vm::of(L).charge(L, static_cast<std::uint64_t>(results));
    return results;
}

template int metered<1>(lua_State* L);
template int metered<2>(lua_State* L);

int repeat_text(lua_State* L) {
    const std::string text = text_at(L, 1, "string.rep", "the text");
    const std::int64_t count = integer_at(L, 2, "string.rep", "the count");
    const std::string separator =
        lua_isnoneornil(L, 3) ? "" : text_at(L, 3, "string.rep", "the separator");
    const double size =
        static_cast<double>(count) * static_cast<double>(text.size() + separator.size());
    if (size > static_cast<double>(longest_text))
        refuse("string.rep", "the result would be longer than 64 kB");
    // Of empty texts as many as one likes come to nothing, one by one.
    if (text.empty() && separator.empty()) {
        lua_pushliteral(L, "");
        return 1;
    }
    Vm::of(L).charge(L, call_cost);
    return call_stock(L);
}

void add_closure(lua_State* L, const char* name, int (*function)(lua_State*)) {
    lua_pushnil(L);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

}  // namespace reprise::scripting
