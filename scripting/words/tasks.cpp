#include "scripting/words/tasks.h"

#include <algorithm>
#include <cmath>

#include <lua.hpp>

#include "scripting/words/step_context.h"
#include "world/digest.h"

namespace reprise::scripting {

std::uint64_t ticks_of(double seconds, std::uint64_t step_ns) {
    const double ticks = seconds * 1e9 / static_cast<double>(step_ns);
    return static_cast<std::uint64_t>(std::max(0.0, std::ceil(ticks - 1e-6)));
}

void Tasks::start(lua_State* L, int arguments) {
    const int function = lua_gettop(L) - arguments;
    lua_State* thread = lua_newthread(L);
    lua_insert(L, function);
    lua_xmove(L, thread, arguments + 1);
    const int reference = luaL_ref(L, LUA_REGISTRYINDEX);
    tasks_.push_back({thread, reference, next_id_++, 0, arguments, false});
}

void Tasks::advance(StepContext& context, std::uint64_t now) {
    // By index: a task may start others, which then join the end of this very round.
    for (current_ = 0; current_ < tasks_.size() && !context.finished; ++current_) {
        Task& task = tasks_[current_];
        if (task.wake > now)
            continue;
        task.wake = now + 1;
        const int arguments = task.arguments;
        task.arguments = 0;
        const bool lives = context.vm.resume(task.thread, arguments);  // `task` may have moved
        tasks_[current_].done = !lives;
        ended_ += lives ? 0 : 1;
        if (!lives && tasks_[current_].id == 0)
            context.finish("scenario ended", 0);
    }
    for (const Task& task : tasks_)
        if (task.done)
            luaL_unref(context.vm.main(), LUA_REGISTRYINDEX, task.reference);
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
    }
}

}  // namespace reprise::scripting
