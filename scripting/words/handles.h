#pragma once

#include <cstddef>
#include <cstdint>

#include "scripting/lua/binding.h"
#include "scripting/run/run.h"

struct lua_State;

namespace reprise::scripting {

/// Pushes the one handle of an actor: equal actors are equal values.
void push_handle(lua_State* L, std::uint32_t actor);

/// The actor whose handle is the argument, or refuses.
Actor& actor_at(Run& run, lua_State* L, int index, const char* who);

/// Makes sure that every handle among the arguments stands in the last tick. True: go on. Otherwise
/// the task was put to sleep - the caller returns what `wait` holds - or, in a check, the predicate
/// is given up for this tick; an actor that is gone is an error.
bool all_present(Run& run, lua_State* L);
int wait_for_presence(Run& run, lua_State* L, int (*again)(lua_State*, int, std::ptrdiff_t));

/// A function that reads actors: called again tick by tick until they are there, so that a scenario
/// can use a handle in the line after `spawn`.
template <int (*function)(Run&, lua_State*)>
int with_presence(Run& run, lua_State* L);

template <int (*function)(Run&, lua_State*)>
int once_more(lua_State* L, int, std::ptrdiff_t) {
    return bound<with_presence<function>>(L);
}

template <int (*function)(Run&, lua_State*)>
int with_presence(Run& run, lua_State* L) {
    if (!all_present(run, L))
        return wait_for_presence(run, L, once_more<function>);
    return function(run, L);
}

template <int (*function)(Run&, lua_State*)>
constexpr int (*reading)(lua_State*) = bound<with_presence<function>>;

/// As `reading`, for methods that command an actor: refused in checks.
template <int (*function)(Run&, lua_State*)>
constexpr int (*commanding)(lua_State*) = bound<by_a_task<with_presence<function>>>;

}  // namespace reprise::scripting
