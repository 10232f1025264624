#pragma once

#include <exception>
#include <string>

#include "scripting/lua/vm.h"
#include "world/check.h"

struct lua_State;

namespace reprise::scripting {

/// What every function that Lua calls is wrapped in: a world::Error becomes a Lua error at the
/// script's line, any other exception of ours ends the run and comes out of Scenario::advance.
/// Lua's own exceptions (errors and yields) pass.
int report(lua_State* L, const std::string& message);
int report_ours(lua_State* L, std::exception_ptr ours);

template <int (*function)(lua_State*)>
int guarded(lua_State* L) {
    std::string message;
    try {
        return function(L);
    } catch (const world::Error& error) {
        message = error.what();
    } catch (const std::exception&) {
        return report_ours(L, std::current_exception());
    }
    return report(L, message);
}

/// [instructions] of any word of the vocabulary; those that take longer charge more themselves.
inline constexpr std::uint64_t word_cost = 30;

/// A function that needs a run: refused while only the header is read.
template <int (*function)(Run&, lua_State*)>
int in_run(lua_State* L) {
    Vm& vm = Vm::of(L);
    if (vm.run == nullptr)
        throw world::Error("only the scenario's run function can do this");
    vm.charge(L, word_cost);
    return function(*vm.run, L);
}

template <int (*function)(Run&, lua_State*)>
constexpr int (*bound)(lua_State*) = guarded<in_run<function>>;

/// As `bound`, for what changes the run: refused in a check's predicate, which may only look.
template <int (*function)(Run&, lua_State*)>
int by_a_task(Run& run, lua_State* L) {
    if (Vm::of(L).in_check)
        throw world::Error("a check may look, but not act or wait");
    return function(run, L);
}

template <int (*function)(Run&, lua_State*)>
constexpr int (*acting)(lua_State*) = bound<by_a_task<function>>;

/// Puts a function into the table at the top of the stack.
void add_function(lua_State* L, const char* name, int (*function)(lua_State*));

}  // namespace reprise::scripting
