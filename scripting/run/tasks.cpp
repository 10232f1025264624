#include "scripting/run/tasks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <lua.hpp>

#include "scripting/run/step_context.h"
#include "world/digest.h"

namespace reprise::scripting {

std::uint64_t ticks_of(double seconds, std::uint64_t step_ns) {
    const double ticks = seconds * 1e9 / static_cast<double>(step_ns);
    return static_cast<std::uint64_t>(std::max(0.0, std::ceil(ticks - 1e-6)));
}

std::uint64_t Tasks::start(lua_State* L, int arguments) {
    const int function = lua_gettop(L) - arguments;
    Task task;
    task.thread = lua_newthread(L);
    lua_insert(L, function);
    lua_xmove(L, task.thread, arguments + 1);
    task.reference = luaL_ref(L, LUA_REGISTRYINDEX);
    task.id = next_id_++;
    task.arguments = arguments;
    tasks_.push_back(std::move(task));
    return tasks_.back().id;
}

std::size_t Tasks::find(std::uint64_t task) const {
    const auto found = std::lower_bound(
        tasks_.begin(), tasks_.end(), task, [](const Task& each, std::uint64_t id) {
            return each.id < id;
        });
    const bool lives = found != tasks_.end() && found->id == task && !found->done;
    return lives ? static_cast<std::size_t>(found - tasks_.begin()) : tasks_.size();
}

void Tasks::advance(StepContext& context, std::uint64_t now) {
    // By index: a task may start others, which then join the end of this very round.
    for (std::size_t index = 0; index < tasks_.size() && !context.finished; ++index) {
        take_turn(context, index, now);
        // Who waited for its end goes on behind it; as does who waited for the end of that one.
        for (std::size_t next = 0; next < awake_.size() && !context.finished; ++next)
            if (const std::size_t waiter = find(awake_[next]); waiter < tasks_.size())
                take_turn(context, waiter, now);
        awake_.clear();
    }
    forget_ended(context);
}

void Tasks::take_turn(StepContext& context, std::size_t index, std::uint64_t now) {
    current_ = index;
    if (tasks_[index].done || tasks_[index].wake > now)
        return;
    tasks_[index].wake = now + 1;
    if (tasks_[index].polls && !answer_poll(context, index, now))
        return;
    Task& task = tasks_[index];
    if (!task.awaited.empty() && task.pending > 0) {  // its patience is at an end
        stop_waiting(task);
        lua_pushboolean(task.thread, 0);
        task.arguments = 1;
    }
    const auto results = context.vm.resume(task.thread, std::exchange(task.arguments, 0));
    if (!results || tasks_[index].done)  // `task` may have moved
        return;
    if (tasks_[index].id == 0)
        context.finish("scenario ended", 0);
    end(index, *results);
}

// --- Conditions.

void Tasks::poll(lua_State* L, std::uint64_t give_up) {
    if (tasks_[current_].asking == nullptr) {
        lua_State* const asking = lua_newthread(L);
        const int reference = luaL_ref(L, LUA_REGISTRYINDEX);
        tasks_[current_].asking = asking;
        tasks_[current_].asking_reference = reference;
    }
    Task& task = tasks_[current_];
    lua_settop(task.asking, 0);
    lua_xmove(L, task.asking, 1);
    task.polls = true;
    task.give_up = give_up;
}

/// True: the answer lies on the task's stack. Otherwise it goes on asking.
bool Tasks::answer_poll(StepContext& context, std::size_t index, std::uint64_t now) {
    lua_State* const asking = tasks_[index].asking;
    if (lua_status(asking) != LUA_YIELD)  // else it waits, for an actor to appear or by itself
        lua_pushvalue(asking, 1);
    const auto asked = context.vm.ask(asking, tasks_[index].thread);
    Task& task = tasks_[index];
    if (task.done || asked == Vm::Asked::waits)
        return false;
    const bool holds = asked == Vm::Asked::answered && lua_toboolean(asking, 2) != 0;
    if (asked == Vm::Asked::answered) {
        lua_settop(asking, 1);
        if (!holds && now < task.give_up)
            return false;
        lua_settop(asking, 0);
    }
    task.polls = false;
    task.arguments = 2;
    lua_pushboolean(task.thread, asked == Vm::Asked::answered ? 1 : 0);
    if (asked == Vm::Asked::answered) {
        lua_pushboolean(task.thread, holds ? 1 : 0);
    } else {
        lua_xmove(asking, task.thread, 1);
        drop_asking(context, task);  // where an error stopped it, it cannot go on
    }
    return true;
}

void Tasks::drop_asking(StepContext& context, Task& task) {
    luaL_unref(context.vm.main(), LUA_REGISTRYINDEX, task.asking_reference);
    task.asking = nullptr;
    task.asking_reference = 0;
}

// --- Waiting for others.

void Tasks::await(std::uint64_t awaited, std::uint64_t give_up) {
    Task& task = tasks_[current_];
    task.awaited = {awaited};
    task.pending = 1;
    task.owns = false;
    task.until = Until::all_ended;
    task.wake = give_up;
    waiters_[awaited].push_back(task.id);
}

void Tasks::await_own(std::vector<std::uint64_t> own, Until until) {
    Task& task = tasks_[current_];
    task.awaited = std::move(own);
    task.pending = task.awaited.size();
    task.owns = true;
    task.until = until;
    task.wake = never;
    for (const std::uint64_t each : task.awaited)
        waiters_[each].push_back(task.id);
}

/// It has returned; what it returned lies on its stack.
void Tasks::end(std::size_t index, int results) {
    tasks_[index].done = true;
    ++ended_;
    tell_waiters(tasks_[index], results);
}

/// `results`: -1 when it was cancelled.
void Tasks::tell_waiters(const Task& ended, int results) {
    const auto found = waiters_.find(ended.id);
    if (found == waiters_.end())
        return;
    const std::vector<std::uint64_t> waiters = std::move(found->second);
    waiters_.erase(found);
    for (const std::uint64_t id : waiters) {
        const std::size_t index = find(id);
        if (index == tasks_.size())
            continue;
        Task& waiter = tasks_[index];
        const auto place = std::find(waiter.awaited.begin(), waiter.awaited.end(), ended.id);
        if (place == waiter.awaited.end())  // it has its winner
            continue;
        --waiter.pending;
        if (waiter.until == Until::first_ended && results >= 0) {
            lua_pushinteger(waiter.thread, place - waiter.awaited.begin() + 1);
            if (results > 0) {
                lua_pushvalue(ended.thread, -results);
                lua_xmove(ended.thread, waiter.thread, 1);
            }
            waiter.pending = 0;
            const std::vector<std::uint64_t> others = std::exchange(waiter.awaited, {});
            for (const std::uint64_t other : others)
                cancel(other);
            wake_up(tasks_[index], results > 0 ? 2 : 1);
        } else if (waiter.pending == 0) {
            const bool says = !waiter.owns;
            if (says)
                lua_pushboolean(waiter.thread, 1);
            wake_up(waiter, says ? 1 : 0);
        }
    }
}

void Tasks::wake_up(Task& task, int answers) {
    task.awaited.clear();
    task.arguments = answers;
    task.wake = 0;
    awake_.push_back(task.id);
}

/// Nobody is to tell it any more.
void Tasks::stop_waiting(Task& task) {
    for (const std::uint64_t awaited : task.awaited)
        if (const auto found = waiters_.find(awaited); found != waiters_.end())
            std::erase(found->second, task.id);
    task.awaited.clear();
    task.pending = 0;
}

bool Tasks::holds_running(std::uint64_t task) const {
    const std::size_t index = find(task);
    if (index == tasks_.size())
        return false;
    const Task& holder = tasks_[index];
    return index == current_ ||
           (holder.owns && std::any_of(holder.awaited.begin(),
                                       holder.awaited.end(),
                                       [&](std::uint64_t own) { return holds_running(own); }));
}

bool Tasks::cancel(std::uint64_t cancelled) {
    const std::size_t index = find(cancelled);
    if (index == tasks_.size())
        return false;
    tasks_[index].done = true;
    ++ended_;
    bool ends_running = index == current_;
    const std::vector<std::uint64_t> awaited = tasks_[index].awaited;
    const bool owns = tasks_[index].owns;
    stop_waiting(tasks_[index]);
    if (owns)
        for (const std::uint64_t own : awaited)
            ends_running = cancel(own) || ends_running;
    tell_waiters(tasks_[index], -1);
    return ends_running;
}

void Tasks::forget_ended(StepContext& context) {
    for (Task& task : tasks_) {
        if (!task.done)
            continue;
        luaL_unref(context.vm.main(), LUA_REGISTRYINDEX, task.reference);
        if (task.asking != nullptr)
            drop_asking(context, task);
    }
    std::erase_if(tasks_, [](const Task& task) { return task.done; });
    ended_ = 0;
}

void Tasks::digest(world::Hasher& hasher) const {
    hasher.add(next_id_);
    hasher.add(static_cast<std::uint64_t>(tasks_.size()));
    for (const Task& task : tasks_) {
        hasher.add(task.id);
        hasher.add(task.wake);
        hasher.add(static_cast<std::int32_t>(task.arguments));  // has it begun?
        // What it will do next is its stack's; how deep in calls it sleeps shows without names.
        hasher.add(static_cast<std::int32_t>(lua_status(task.thread)));
        hasher.add(static_cast<std::int32_t>(lua_gettop(task.thread)));
        hasher.add(task.polls ? task.give_up : 0);
        hasher.add(static_cast<std::uint64_t>(task.pending));
        for (const std::uint64_t awaited : task.awaited)
            hasher.add(awaited);
    }
}

}  // namespace reprise::scripting
