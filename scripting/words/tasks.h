#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

struct lua_State;

namespace reprise::world {
class Hasher;
}

namespace reprise::scripting {

struct StepContext;

/// The coroutines of a scenario: its `run`, and what `start` began. Resumed once a tick, in the
/// order in which they were started; a task started in a tick first runs in that tick, last.
class Tasks {
  public:
    /// Takes a function and its arguments from the top of L's stack. The first task is `run`: when
    /// it returns, the scenario has ended.
    void start(lua_State* L, int arguments);

    /// Resumes every task whose time has come.
    void advance(StepContext& context, std::uint64_t now);

    /// When the running task goes on after its next yield. Without a word: in the next tick.
    void sleep_until(std::uint64_t tick) { tasks_[current_].wake = tick; }

    /// Tasks that have not ended.
    std::size_t living() const { return tasks_.size() - ended_; }

    void digest(world::Hasher& hasher) const;

  private:
    struct Task {
        lua_State* thread = nullptr;
        int reference = 0;     ///< keeps the thread alive in Lua's registry
        std::uint64_t id = 0;  ///< 0 is `run`
        std::uint64_t wake = 0;
        int arguments = 0;  ///< waiting on its stack for the first resume
        bool done = false;
    };

    std::vector<Task> tasks_;  ///< by id
    std::uint64_t next_id_ = 0;
    std::size_t current_ = 0;
    std::size_t ended_ = 0;  ///< in this tick
};

/// Seconds as ticks, rounded up; a millionth of a tick is forgiven, so that 0.15 s are 3 ticks.
std::uint64_t ticks_of(double seconds, std::uint64_t step_ns);

}  // namespace reprise::scripting
