#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/sandbox.h"
#include "scripting/lua/text.h"
#include "scripting/run/caps.h"
#include "scripting/run/run.h"
#include "scripting/words/vocabulary.h"

namespace reprise::scripting {

namespace {

/// A new coroutine's first instructions are not yet seen by the hook: they are paid in advance.
constexpr std::uint64_t start_cost = 1000;

constexpr const char* task_type = "task";  // name of the metatable in Lua's registry
constexpr const char* no_waiting_here = "cannot wait here, inside another function's call back";

int sleep(Run& run, lua_State* L, std::uint64_t ticks) {
    if (ticks == 0)
        return 0;
    if (lua_isyieldable(L) == 0)
        throw world::Error(no_waiting_here);
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

constexpr Key wait_key_rows[] = {
    {"timeout", "number", "[s] to give up after; default never"},
};

/// The tick in which a wait with these options gives up.
std::uint64_t last_tick(const Run& run, lua_State* L, int options_index, const char* who) {
    const Fields options(L, options_index, who, names_of(wait_key_rows), true);
    const auto timeout = options.number("timeout");
    if (timeout && (*timeout < 0 || *timeout > 1e9))
        refuse(who, "'timeout' must be in [0, 1e9] s");
    return run.now() +
           (timeout ? ticks_of(*timeout, run.episode.step_ns) : std::uint64_t{1} << 62U);
}

/// For the prelude's wait_until(condition, options): the tick in which it gives up.
int give_up_at(Run& run, lua_State* L) {
    want_function(L, 1, "wait_until", "the condition");
    lua_pushinteger(L, static_cast<lua_Integer>(last_tick(run, L, 2, "wait_until")));
    return 1;
}

/// For the prelude's wait_until: asks the condition from the next tick on. A condition that waits
/// for a condition itself is told, by no answer, to ask it in a loop.
int poll(Run& run, lua_State* L) {
    if (lua_isyieldable(L) == 0)
        throw world::Error(no_waiting_here);
    if (!run.tasks.is_own_stack(L))
        return 0;
    const auto give_up = static_cast<std::uint64_t>(lua_tointeger(L, 2));
    run.vm.charge(L, start_cost);
    lua_settop(L, 1);
    run.tasks.poll(L, give_up);
    return lua_yield(L, 0);
}

// --- Tasks that a scenario starts.

std::uint64_t begin(Run& run, lua_State* L, const char* who) {
    run.vm.charge(L, start_cost);
    if (run.tasks.living() >= most_tasks)
        refuse(who, fmt::format("more than {} tasks at a time", most_tasks));
    return run.tasks.start(L, 0);
}

int start(Run& run, lua_State* L) {
    want_function(L, 1, "start", "the argument");
    lua_settop(L, 1);
    const std::uint64_t task = begin(run, L, "start");
    *static_cast<std::uint64_t*>(lua_newuserdatauv(L, sizeof task, 0)) = task;
    luaL_setmetatable(L, task_type);
    return 1;
}

std::uint64_t task_at(lua_State* L, const char* who) {
    const void* held = luaL_testudata(L, 1, task_type);
    if (held == nullptr)
        refuse(who,
               fmt::format("a task is needed, got {}: local task = start(function() ... end)",
                           luaL_typename(L, 1)));
    return *static_cast<const std::uint64_t*>(held);
}

int done(Run& run, lua_State* L) {
    lua_pushboolean(L, run.tasks.has_ended(task_at(L, "done")) ? 1 : 0);
    return 1;
}

int cancel(Run& run, lua_State* L) {
    const std::uint64_t task = task_at(L, "cancel");
    run.vm.charge(L, run.tasks.living());
    if (run.tasks.holds_running(task) && lua_isyieldable(L) == 0)
        refuse("cancel", "a task cannot end itself here, inside another function's call back");
    return run.tasks.cancel(task) ? lua_yield(L, 0) : 0;
}

/// The running task is about to wait for others.
void want_to_wait(const Run& run, lua_State* L, const char* who) {
    if (lua_isyieldable(L) == 0)
        throw world::Error(no_waiting_here);
    if (!run.tasks.is_own_stack(L))
        refuse(who, "a condition cannot wait for tasks: ask task:done()");
}

int wait_for(Run& run, lua_State* L) {
    const std::uint64_t task = task_at(L, "wait_for");
    const std::uint64_t give_up = last_tick(run, L, 2, "wait_for");
    if (!run.tasks.has_ended(task) && task == run.tasks.running())
        refuse("wait_for", "a task cannot wait for its own end");
    if (run.tasks.has_ended(task) || give_up <= run.now()) {
        lua_pushboolean(L, run.tasks.has_ended(task) ? 1 : 0);
        return 1;
    }
    want_to_wait(run, L, "wait_for");
    run.tasks.await(task, give_up);
    return lua_yield(L, 0);
}

/// parallel{ f, g, ... } and race{ f, g, ... }: they begin as if by `start`, in this order.
template <Tasks::Until until>
int run_together(Run& run, lua_State* L) {
    const char* const who = until == Tasks::Until::all_ended ? "parallel" : "race";
    lua_settop(L, 1);
    const lua_Unsigned count = lua_istable(L, 1) ? lua_rawlen(L, 1) : 0;
    if (count == 0)
        refuse(who, fmt::format("needs a list of functions: {}{{ drive, walk }}", who));
    if (count > most_tasks)
        refuse(who, fmt::format("more than {} tasks at a time", most_tasks));
    run.vm.charge(L, count * 10);
    for (lua_Unsigned i = 1; i <= count; ++i) {
        lua_rawgeti(L, 1, static_cast<lua_Integer>(i));
        want_function(L, 2, who, fmt::format("entry {}", i));
        lua_settop(L, 1);
    }
    want_to_wait(run, L, who);
    std::vector<std::uint64_t> tasks;
    for (lua_Unsigned i = 1; i <= count; ++i) {
        lua_rawgeti(L, 1, static_cast<lua_Integer>(i));
        tasks.push_back(begin(run, L, who));
    }
    run.tasks.await_own(std::move(tasks), until);
    return lua_yield(L, 0);
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

constexpr Word task_rows[] = {
    {"wait", acting<wait>, "(seconds: number)", "goes on after that time, rounded up to ticks"},
    {"wait_ticks", acting<wait_ticks>, "(n: integer)", "goes on n ticks later"},
    {"wait_until",
     nullptr,
     "(condition: (fun(): any), options?: WaitOptions): boolean",
     "tests at once and then in every tick; true, or false after the timeout"},
    {"start", acting<start>, "(task: fun()): Task", "runs beside; begins in this tick"},
    {"wait_for",
     acting<wait_for>,
     "(task: Task, options?: WaitOptions): boolean",
     "until the task has ended; false after the timeout. Also task:wait(), task:done(), "
     "task:cancel()"},
    {"parallel",
     acting<run_together<Tasks::Until::all_ended>>,
     "(tasks: (fun())[])",
     "runs them beside each other until all have ended"},
    {"race",
     acting<run_together<Tasks::Until::first_ended>>,
     "(tasks: (fun(): any)[]): integer, any",
     "until the first has ended: its number, what it returned; the others are cancelled"},
    {"finish",
     acting<finish>,
     "(reason?: string)",
     "ends the run; nothing after it is carried out"},
    {"tick", bound<tick>, "(): integer", "of the last tick: what the scenario sees"},
    {"time", bound<time>, "(): number", "[s] of the last tick"},
};

constexpr Word method_rows[] = {
    {"done", bound<done>, "(): boolean", "has it ended?"},
    {"cancel", acting<cancel>, "()", "it runs no more code, from now on"},
    {"wait",
     acting<wait_for>,
     "(options?: WaitOptions): boolean",
     "until it has ended: true; false after the timeout"},
};

}  // namespace

constinit const WordList task_methods{Owner::task, "Tasks", method_rows};
constinit const WordList task_words{Owner::global, "Time", task_rows};
constinit const KeyList wait_keys{"WaitOptions", "wait_until", wait_key_rows};

void add_task_words(lua_State* L) {
    luaL_newmetatable(L, task_type);
    lua_newtable(L);  // the methods
    add_words(L, task_methods);
    refuse_unknown(L, "a task");
    lua_setfield(L, -2, "__index");
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
    lua_pop(L, 1);
    add_words(L, task_words);
    add_function(L, "_give_up_at", acting<give_up_at>);  // for the prelude, which hides them
    add_function(L, "_poll", acting<poll>);
}

}  // namespace reprise::scripting
