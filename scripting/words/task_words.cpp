#include <cstdint>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/text.h"
#include "scripting/words/caps.h"
#include "scripting/words/run.h"
#include "scripting/words/vocabulary.h"

namespace reprise::scripting {

namespace {

/// A new coroutine's first instructions are not yet seen by the hook: they are paid in advance.
constexpr std::uint64_t start_cost = 1000;

int sleep(Run& run, lua_State* L, std::uint64_t ticks) {
    if (ticks == 0)
        return 0;
    if (lua_isyieldable(L) == 0)
        throw world::Error("cannot wait here, inside another function's call back");
    run.tasks.sleep_until(run.now() + ticks);
    return lua_yield(L, 0);
}

int wait(Run& run, lua_State* L) {
    const double seconds = number_at(L, 1, "wait", "the time in seconds");
    if (seconds < 0 || seconds > 1e9)
        refuse("wait", "the time must be in [0, 1e9] s");
    return sleep(run, L, ticks_of(seconds, run.episode.step_ns));
}

int wait_ticks(Run& run, lua_State* L) {
    const std::int64_t ticks = integer_at(L, 1, "wait_ticks", "the number of ticks");
    if (ticks < 0)
        refuse("wait_ticks", "the number of ticks must not be below 0");
    return sleep(run, L, static_cast<std::uint64_t>(ticks));
}

/// For the prelude's wait_until(condition, options): the tick in which it gives up.
int give_up_at(Run& run, lua_State* L) {
    want_function(L, 1, "wait_until", "the condition");
    const Fields options(L, 2, "wait_until", {"timeout"}, true);
    const auto timeout = options.number("timeout");
    if (timeout && (*timeout < 0 || *timeout > 1e9))
        refuse("wait_until", "'timeout' must be in [0, 1e9] s");
    const std::uint64_t ticks =
        timeout ? ticks_of(*timeout, run.episode.step_ns) : std::uint64_t{1} << 62U;
    lua_pushinteger(L, static_cast<lua_Integer>(run.now() + ticks));
    return 1;
}

int start(Run& run, lua_State* L) {
    want_function(L, 1, "start", "the argument");
    lua_settop(L, 1);
    Vm::of(L).charge(L, start_cost);
    if (run.tasks.living() >= most_tasks)
        refuse("start", fmt::format("more than {} tasks at a time", most_tasks));
    run.tasks.start(L, 0);
    return 0;
}

int finish(Run& run, lua_State* L) {
    const std::string reason =
        lua_isnoneornil(L, 1) ? "finished" : printable(text_at(L, 1, "finish", "the reason"));
    run.finish(reason, run.vm.line(L));
    // Nothing after it is carried out: a task that never goes on.
    return lua_isyieldable(L) != 0 ? lua_yield(L, 0) : 0;
}

int tick(Run& run, lua_State* L) {
    lua_pushinteger(L, static_cast<lua_Integer>(run.now()));
    return 1;
}

int time(Run& run, lua_State* L) {
    lua_pushnumber(L, world::seconds(run.now(), run.episode.step_ns));
    return 1;
}

}  // namespace

void add_task_words(lua_State* L) {
    add_function(L, "wait", acting<wait>);
    add_function(L, "wait_ticks", acting<wait_ticks>);
    add_function(L, "_give_up_at", acting<give_up_at>);
    add_function(L, "start", acting<start>);
    add_function(L, "finish", acting<finish>);
    add_function(L, "tick", bound<tick>);
    add_function(L, "time", bound<time>);
}

}  // namespace reprise::scripting
