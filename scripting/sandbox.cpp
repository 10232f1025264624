#include "scripting/sandbox.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <string>
#include <vector>

#include <lua.hpp>

#include "scripting/arguments.h"
#include "scripting/binding.h"
#include "scripting/limits.h"
#include "scripting/ordered.h"
#include "scripting/text.h"
#include "scripting/vm.h"

namespace reprise::scripting {

namespace {

/// Its address is the key under which a metatable's copy holds the original.
constexpr char original_metatable = 0;

int to_text(lua_State* L) {
    if (lua_isnone(L, 1))
        throw world::Error("tostring: a value is needed");
    const std::string text = text_of(L, 1);
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

// --- Protected calls: what ends the run must not be caught.

/// Continues after the call: at once, or when a wait in it is over. The results lie above `first`.
int after_protected_call(lua_State* L, int status, lua_KContext first) {
    Vm& vm = Vm::of(L);
    if (status == LUA_ERRMEM)
        vm.latch(vm.script() + ": the scenario needs more than 64 MB of memory");
    if (vm.is_latched())
        vm.raise(L, "");
    if (status == LUA_OK || status == LUA_YIELD)
        return lua_gettop(L) - static_cast<int>(first);
    lua_pushboolean(L, 0);
    lua_insert(L, -2);
    return 2;
}

int protected_call(lua_State* L) {
    if (lua_isnone(L, 1))
        throw world::Error("pcall: a function is needed");
    lua_pushboolean(L, 1);
    lua_insert(L, 1);
    const int status = lua_pcallk(L, lua_gettop(L) - 2, LUA_MULTRET, 0, 0, after_protected_call);
    return after_protected_call(L, status, 0);
}

/// As above, and hands an error to the handler, which lies at 2. The handler runs after the call,
/// not inside the error as Lua's own does: there no instruction is counted, and a loop would never
/// end.
int after_handled_call(lua_State* L, int status, lua_KContext first) {
    const int results = after_protected_call(L, status, first);
    if (status == LUA_OK || status == LUA_YIELD)
        return results;
    lua_pushvalue(L, 2);
    lua_insert(L, -2);
    lua_call(L, 1, 1);
    return 2;
}

int protected_call_with_handler(lua_State* L) {
    want_function(L, 2, "xpcall", "the handler");
    const int arguments = lua_gettop(L) - 2;
    lua_pushboolean(L, 1);
    lua_pushvalue(L, 1);
    lua_rotate(L, 3, 2);
    const int status = lua_pcallk(L, arguments, LUA_MULTRET, 0, 2, after_handled_call);
    return after_handled_call(L, status, 2);
}

// --- Metatables: no finalizers, no weak references; both act when memory is collected.

/// A metatable is read when it is set: what the script changes in it later has no effect, so that
/// '__mode' cannot slip in. Returns the table. The original stays reachable for getmetatable.
int set_metatable(lua_State* L) {
    if (lua_type(L, 1) != LUA_TTABLE || (!lua_isnil(L, 2) && lua_type(L, 2) != LUA_TTABLE))
        throw world::Error("setmetatable: needs a table and a metatable (or nil)");
    if (luaL_getmetafield(L, 1, "__metatable") != LUA_TNIL)
        throw world::Error("setmetatable: this metatable is protected");
    lua_settop(L, 2);
    if (!lua_isnil(L, 2)) {
        lua_newtable(L);
        lua_pushnil(L);
        while (lua_next(L, 2) != 0) {
            const std::string key = lua_type(L, -2) == LUA_TSTRING ? text_of(L, -2) : "";
            if (key == "__gc" || key == "__mode")
                refuse("setmetatable",
                       key + " acts when memory is collected, which differs from run to run");
            lua_pushvalue(L, -2);
            lua_insert(L, -2);
            lua_rawset(L, 3);
        }
        lua_pushvalue(L, 2);
        lua_rawsetp(L, 3, &original_metatable);
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
    lua_rawgetp(L, -2, &original_metatable);
    return 1;
}

// --- Words that are not there.

const std::map<std::string, std::string>& hints() {
    static const std::map<std::string, std::string> hints{
        {"os", "a scenario knows no clock but time() and tick()"},
        {"io", "a scenario reads and writes no files; print() goes into the trace"},
        {"debug", "there is no debug library"},
        {"coroutine", "use start(function), wait() and wait_until()"},
        {"require", "a scenario is one file"},
        {"package", "a scenario is one file"},
        {"dofile", "a scenario is one file"},
        {"loadfile", "a scenario is one file"},
        {"load", "there is no load"},
        {"collectgarbage", "memory is collected for you"},
        {"random", "use random() or random_int(): they follow the run's seed"},
        {"randomseed", "use --seed or seed = ...: random() follows the run's seed"},
        {"dump", "there is no compiled code"},
    };
    return hints;
}

std::vector<std::string> words_of(lua_State* L, int table) {
    std::vector<std::string> words;
    lua_pushnil(L);
    while (lua_next(L, table) != 0) {
        lua_pop(L, 1);
        if (lua_type(L, -1) == LUA_TSTRING)
            words.push_back(text_of(L, -1));
    }
    std::sort(words.begin(), words.end());
    return words;
}

/// __index. Upvalue 1: the words there are; upvalue 2: "math" or "" for the globals.
int missing_word(lua_State* L) {
    const std::string word = text_of(L, 2);
    const std::string library = text_of(L, lua_upvalueindex(2));
    std::string hint = world::did_you_mean(word, words_of(L, lua_upvalueindex(1)));
    if (const auto known = hints().find(word); known != hints().end())
        hint = " (" + known->second + ")";
    if (library.empty())
        throw world::Error(fmt::format("no variable or function '{}'{}", word, hint));
    throw world::Error(fmt::format("{} has no '{}'{}", library, word, hint));
}

/// __newindex of the environment.
int sealed(lua_State* L) {
    const std::string word = text_of(L, 2);
    throw world::Error(
        fmt::format("'{}' would be a global: write 'local {}' where it first appears", word, word));
}

// --- The libraries.

/// Wraps a function of the table at the top of the stack, with the stock one as upvalue.
void wrap(lua_State* L, const char* name, int (*function)(lua_State*)) {
    lua_getfield(L, -1, name);
    lua_pushcclosure(L, function, 1);
    lua_setfield(L, -2, name);
}

void remove(lua_State* L, const char* name) {
    lua_pushnil(L);
    lua_setfield(L, -2, name);
}

/// Opens a stock library without registering it anywhere and pushes its table.
void open(lua_State* L, int (*library)(lua_State*)) {
    lua_pushcfunction(L, library);
    lua_call(L, 0, 1);
}

void add_string(lua_State* L) {
    open(L, luaopen_string);
    remove(L, "dump");
    wrap(L, "format", guarded<format_text>);
    wrap(L, "rep", guarded<repeat_text>);
    for (const char* name : {"find", "match", "gmatch", "gsub"})
        wrap(L, name, guarded<search_text>);
    refuse_unknown(L, "string");
    // Methods of strings are these; '"10" + 1' is a mistake, not 11.
    lua_pushliteral(L, "");
    lua_newtable(L);
    lua_pushvalue(L, -3);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
    lua_pop(L, 1);
    lua_setfield(L, -2, "string");
}

void add_libraries(lua_State* L) {
    add_string(L);
    open(L, luaopen_table);
    add_function(L, "sort", guarded<stable_sort>);
    wrap(L, "move", guarded<move_elements>);
    refuse_unknown(L, "table");
    lua_setfield(L, -2, "table");
    open(L, luaopen_math);
    remove(L, "random");
    remove(L, "randomseed");
    refuse_unknown(L, "math");
    lua_setfield(L, -2, "math");
    open(L, luaopen_utf8);
    refuse_unknown(L, "utf8");
    lua_setfield(L, -2, "utf8");
}

void add_basics(lua_State* L) {
    open(L, luaopen_base);
    for (const char* name : {"assert",
                             "error",
                             "ipairs",
                             "rawequal",
                             "rawget",
                             "rawlen",
                             "select",
                             "tonumber",
                             "type",
                             "_VERSION"}) {
        lua_getfield(L, -1, name);
        lua_setfield(L, -3, name);
    }
    lua_pop(L, 1);
    add_function(L, "next", guarded<ordered_next>);
    add_function(L, "pairs", guarded<ordered_pairs>);
    add_function(L, "pcall", guarded<protected_call>);
    add_function(L, "xpcall", guarded<protected_call_with_handler>);
    add_function(L, "tostring", guarded<to_text>);
    add_function(L, "setmetatable", guarded<set_metatable>);
    add_function(L, "getmetatable", guarded<get_metatable>);
}

}  // namespace

void refuse_unknown(lua_State* L, const char* name) {
    lua_newtable(L);
    lua_pushvalue(L, -2);
    lua_pushstring(L, name);
    lua_pushcclosure(L, guarded<missing_word>, 2);
    lua_setfield(L, -2, "__index");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

void push_sandbox(lua_State* L) {
    lua_newtable(L);
    add_basics(L);
    add_libraries(L);
    refuse_unknown(L, "");
    lua_newtable(L);  // the environment
    lua_newtable(L);
    lua_pushvalue(L, -3);
    lua_setfield(L, -2, "__index");
    lua_pushcfunction(L, guarded<sealed>);
    lua_setfield(L, -2, "__newindex");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_setmetatable(L, -2);
}

}  // namespace reprise::scripting
