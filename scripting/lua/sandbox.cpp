#include "scripting/lua/sandbox.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/format.h"
#include "scripting/lua/limits.h"
#include "scripting/lua/lists.h"
#include "scripting/lua/metatables.h"
#include "scripting/lua/ordered.h"
#include "scripting/lua/searches.h"
#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"

namespace reprise::scripting {

namespace {

constexpr std::uint64_t text_cost = 20;    // [instructions] of a number's digits
constexpr std::uint64_t catch_cost = 300;  // [instructions] of a C++ exception

int to_text(lua_State* L) {
    if (lua_isnone(L, 1))
        throw world::Error("tostring: a value is needed");
    Vm::of(L).charge(L, text_cost);
    const std::string text = text_of(L, 1);
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

// --- Protected calls: what ends the run must not be caught.

/// Continues after the call: at once, or when a wait in it is over. The results lie above `first`.
int after_protected_call(lua_State* L, int status, lua_KContext first) {
    Vm& vm = Vm::of(L);
    if (vm.is_latched())
        vm.raise(L, "");
    if (status == LUA_OK || status == LUA_YIELD)
        return lua_gettop(L) - static_cast<int>(first);
    vm.charge(L, catch_cost);
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

template <int first>
void meter(lua_State* L, std::initializer_list<const char*> names) {
    for (const char* const name : names)
        wrap(L, name, guarded<metered<first>>);
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
    add_closure(L, "find", guarded<find_text>);
    add_closure(L, "match", guarded<match_text>);
    add_closure(L, "gmatch", guarded<match_all>);
    add_closure(L, "gsub", guarded<replace_text>);
    meter<1>(L, {"char", "lower", "upper", "reverse", "pack", "unpack", "packsize"});
    meter<2>(L, {"byte", "len", "sub"});
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

void add_table(lua_State* L) {
    open(L, luaopen_table);
    add_closure(L, "sort", guarded<stable_sort>);
    add_closure(L, "insert", guarded<insert_element>);
    add_closure(L, "remove", guarded<remove_element>);
    add_closure(L, "concat", guarded<join_elements>);
    add_closure(L, "unpack", guarded<unpack_elements>);
    add_closure(L, "move", guarded<move_elements>);
    meter<1>(L, {"pack"});
    refuse_unknown(L, "table");
    lua_setfield(L, -2, "table");
}

void add_math(lua_State* L) {
    open(L, luaopen_math);
    remove(L, "random");
    remove(L, "randomseed");
    meter<1>(
        L, {"abs", "ceil", "floor", "sqrt", "sin", "cos", "tan", "asin",      "acos", "atan", "exp",
            "log", "fmod", "modf",  "max",  "min", "deg", "rad", "tointeger", "type", "ult"});
    refuse_unknown(L, "math");
    lua_setfield(L, -2, "math");
}

void add_utf8(lua_State* L) {
    open(L, luaopen_utf8);
    meter<1>(L, {"char", "codepoint", "codes", "len", "offset"});
    refuse_unknown(L, "utf8");
    lua_setfield(L, -2, "utf8");
}

void add_basics(lua_State* L) {
    open(L, luaopen_base);
    meter<1>(L, {"ipairs", "select", "tonumber"});
    meter<2>(L, {"assert", "error", "rawequal", "rawget", "rawlen", "type"});
    for (const char* const name : {"assert",
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
    add_closure(L, "next", guarded<ordered_next>);
    add_closure(L, "pairs", guarded<ordered_pairs>);
    add_closure(L, "pcall", guarded<protected_call>);
    add_closure(L, "xpcall", guarded<protected_call_with_handler>);
    add_closure(L, "tostring", guarded<to_text>);
    add_closure(L, "setmetatable", guarded<set_metatable>);
    add_closure(L, "getmetatable", guarded<get_metatable>);
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
    add_string(L);
    add_table(L);
    add_math(L);
    add_utf8(L);
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
