#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

struct lua_State;

namespace reprise::world {
class Hasher;
}

namespace reprise::scripting {

struct StepContext;

/// The coroutines of a scenario: its `run`, and what `start` began.
///
/// What must it do?   Resume every task once a tick, in the order of their start; a task started in
///                    a tick first runs in that tick, last. Who waits for the end of another one
///                    goes on in that very tick, right behind it. A cancelled task runs no more.
/// How?               A condition that a task waits for is asked from here, on a coroutine of its
///                    own that is used again: to leave a coroutine in the middle costs a C++
///                    exception, which is ten times as much as most conditions.
/// What does it keep? Tasks by id, who waits for whom. Whoever is at work is named by an index,
///                    as starting another one may move them all.
class Tasks {
  public:
    /// Takes a function and its arguments from the top of L's stack. The first task is `run`: when
    /// it returns, the scenario has ended. Its id.
    std::uint64_t start(lua_State* L, int arguments);

    /// Resumes every task whose time has come.
    void advance(StepContext& context, std::uint64_t now);

    /// When the running task goes on after its next yield. Without a word: in the next tick.
    void sleep_until(std::uint64_t tick) { tasks_[current_].wake = tick; }

    /// The running task yields and goes on when the function at the top of L's stack, asked from
    /// the next tick on, returns true, or in the tick `give_up` at last. Its answers are true and
    /// what the function said; or false and the function's mistake.
    void poll(lua_State* L, std::uint64_t give_up);

    enum class Until : std::uint8_t { all_ended, first_ended };

    /// The running task yields and goes on when these have ended: with the answer true, or false in
    /// the tick `give_up`.
    void await(std::uint64_t task, std::uint64_t give_up);

    /// Likewise with tasks of its own, which end with it. all_ended: there is no answer.
    /// first_ended: the answers are its number among them and the first value that it returned; the
    /// others are cancelled.
    void await_own(std::vector<std::uint64_t> tasks, Until until);

    bool has_ended(std::uint64_t task) const { return find(task) == tasks_.size(); }

    std::uint64_t running() const { return tasks_[current_].id; }

    /// Is it the stack of the running task, and not that of a condition which it waits for?
    bool is_own_stack(const lua_State* L) const { return tasks_[current_].thread == L; }

    /// It runs no more, nor do tasks of its own. True when the running one is among them.
    bool cancel(std::uint64_t task);

    /// Would cancelling it end the running one?
    bool holds_running(std::uint64_t task) const;

    /// Tasks that have not ended.
    std::size_t living() const { return tasks_.size() - ended_; }

    void digest(world::Hasher& hasher) const;

  private:
    struct Task {
        lua_State* thread = nullptr;
        int reference = 0;     ///< keeps the thread alive in Lua's registry
        std::uint64_t id = 0;  ///< 0 is `run`
        std::uint64_t wake = 0;
        int arguments = 0;  ///< waiting on its stack for the next resume
        bool done = false;

        // Asks a condition.
        bool polls = false;
        std::uint64_t give_up = 0;
        lua_State* asking = nullptr;  ///< its stack holds the condition at 1
        int asking_reference = 0;

        // Waits for others.
        std::vector<std::uint64_t> awaited;
        std::size_t pending = 0;  ///< of them, until it goes on
        bool owns = false;        ///< they are its own
        Until until = Until::all_ended;
    };

    static constexpr std::uint64_t never = ~std::uint64_t{0};

    /// Its place; tasks_.size() when it has ended.
    std::size_t find(std::uint64_t task) const;
    void take_turn(StepContext& context, std::size_t index, std::uint64_t now);
    bool answer_poll(StepContext& context, std::size_t index, std::uint64_t now);
    void drop_asking(StepContext& context, Task& task);
    void end(std::size_t index, int results);
    void tell_waiters(const Task& ended, int results);
    void stop_waiting(Task& task);
    void wake_up(Task& task, int answers);
    void forget_ended(StepContext& context);

    std::vector<Task> tasks_;                                      ///< by id
    std::map<std::uint64_t, std::vector<std::uint64_t>> waiters_;  ///< task -> who waits for it
    std::vector<std::uint64_t> awake_;  ///< go on in this tick, in this order
    std::uint64_t next_id_ = 0;
    std::size_t current_ = 0;
    std::size_t ended_ = 0;  ///< in this tick
};

/// Seconds as ticks, rounded up; a millionth of a tick is forgiven, so that 0.15 s are 3 ticks.
std::uint64_t ticks_of(double seconds, std::uint64_t step_ns);

}  // namespace reprise::scripting
