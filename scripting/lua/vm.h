#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scripting/lua/memory.h"

struct lua_State;
struct lua_Debug;

namespace reprise::scripting {

struct Run;
struct Header;

/// The part of the vocabulary that is written in Lua: scripting/lua/prelude.lua.
extern const std::string_view prelude_source;

/// VM instructions that a scenario may use in one tick, all of its tasks and checks together. Work
/// that is not seen in instructions is charged as such: Memory, `charge`.
inline constexpr std::uint64_t budget_per_tick = 10'000'000;

/// The same until the first tick: to compile the file and to run what stands outside of functions.
/// A run does it twice, once to know its town and once to play.
inline constexpr std::uint64_t budget_per_load = 2'500'000;

/// One Lua machine: its memory, its budget, and how its mistakes become world::Error.
///
/// What must it do?   Run a stranger's code so that it answers the same in every run, always comes
///                    back, and cannot swallow the news that its budget is spent.
/// What does it assume? Lua's errors are C++ exceptions (the package lua5.4-c++): destructors run.
///                    Lua catches every exception that reaches it, so ours stop at the binding.
/// How?               A hook every 1000 instructions takes from one account that all coroutines
///                    share, as do the allocator and every function of ours (the dearer an
///                    instruction may be, the more often it comes); once it is empty,
///                    `latch` holds the reason and every pcall throws on. Addresses and the seed of
///                    Lua's hash are the same in every process, so that memory is collected, and
///                    runs out, at the same instruction.
/// What does it keep? The account, the latch, and our own exceptions on their way out.
class Vm {
  public:
    /// `script` is the file's name as messages show it.
    explicit Vm(std::string script);
    ~Vm();
    Vm(const Vm&) = delete;
    Vm& operator=(const Vm&) = delete;

    static Vm& of(lua_State* L);

    lua_State* main() const { return main_; }

    const std::string& script() const { return script_; }

    /// Compiles the text and calls it with the sandbox as its environment; leaves one result on the
    /// main stack. `chunk` is Lua's chunk name: "@cut_in.lua" or "=prelude".
    void execute(std::string_view source, const std::string& chunk, int environment);

    /// As lua_pcall on the main stack, but failures are thrown as world::Error with file and line.
    void call(int arguments, int results);

    /// Calls a check's predicate, which lies at the top of the main stack, and leaves its answer
    /// there. False, and nothing left, when it asks about an actor that is not there.
    bool ask();

    /// Resumes a coroutine; none while it lives on, else how many results lie on its stack.
    /// Failures are thrown as by `call`.
    std::optional<int> resume(lua_State* coroutine, int arguments);

    enum class Asked : std::uint8_t { answered, waits, failed };

    /// Calls or resumes what lies on a coroutine's stack, for a task that waits for its answer: the
    /// results, or what went wrong, lie on the stack then. Where no line of the script is at work,
    /// messages name that of the task.
    Asked ask(lua_State* coroutine, lua_State* task);

    /// Fills the account for the next tick.
    void refill() {
        account_.in_tick = 0;
        budget_ = budget_per_tick;
        collections_ = 0;
    }

    /// Takes from the account for work that Lua's instructions do not show; throws a Lua error when
    /// it is empty.
    void charge(lua_State* L, std::uint64_t instructions);

    /// As above, without an error: for callers that must not throw. The next hook sees it.
    void charge_later(std::uint64_t instructions) { account_.take(instructions); }

    /// Charges a walk over a table with so many entries. How many empty ones it passed Lua does not
    /// say: as many as the largest table has.
    void charge_walk(lua_State* L, std::size_t entries);

    /// A script made a chain of so many tables that ask each other: one instruction may pass all.
    void note_chain(std::size_t tables) { chain_ = std::max(chain_, tables); }

    /// Since the start: a witness of what the script did, equal in equal runs.
    std::uint64_t instructions() const { return account_.all; }

    const Memory& memory() const { return memory_; }

    /// Lua writes numbers and tells letters as the C library's locale does: throws unless that is
    /// plain C, or agrees with it in all that Lua asks.
    static void check_locale();

    /// The machine whose script runs at this moment; null when none does.
    static Vm* running();

    /// The run is over whatever the script tries: raised again at every pcall.
    void latch(std::string reason);
    void latch(std::exception_ptr ours);

    bool is_latched() const { return latched_.has_value(); }

    /// Raises the latched reason, or `message`, as a Lua error. Does not return.
    [[noreturn]] void raise(lua_State* L, const std::string& message);

    /// "cut_in.lua:12: " of the innermost function of the script on this stack; "cut_in.lua: " when
    /// there is none.
    std::string position(lua_State* L) const;

    /// The line of it, or the one that is being compiled; 0 when there is neither.
    std::uint32_t line(lua_State* L) const;

    Run* run = nullptr;        ///< none while only the header is read
    Header* header = nullptr;  ///< where `scenario` puts what it is given

    std::vector<const void*> actor_handles;  ///< the userdata of each actor, by its id; null: none

    bool in_branch = false;  ///< the script takes over from another: set before it is read

    /// Set while a check's predicate runs: it may look and must not act.
    bool in_check = false;
    /// Set when a predicate asked about an actor that is not there yet.
    bool not_ready = false;

  private:
    /// Notes which stack runs; Lua's allocator and strcoll are not told.
    class Running;

    std::uint64_t rate() const;
    int interval() const;
    void pay_ahead(lua_State* L);
    static void* allocate(void* self, void* block, std::size_t old_size, std::size_t new_size);
    void latch_refusal(Memory::Refusal refusal);
    void make_room(lua_State* L);
    static void hook(lua_State* L, lua_Debug* where);
    static int add_position(lua_State* L);
    int call_protected(int arguments, int results);
    [[noreturn]] void fail(lua_State* L, int status);
    std::string message_at_top(lua_State* L) const;
    std::string with_position(lua_State* L, const std::string& message) const;

    std::string script_;
    lua_State* main_ = nullptr;
    lua_State* current_ = nullptr;     ///< the stack that runs now
    lua_State* asker_ = nullptr;       ///< of the task whose condition runs now
    std::uint32_t compiled_line_ = 0;  ///< that Lua's compiler reads; 0: it does not run
    Account account_;
    std::uint64_t budget_ = budget_per_load;  ///< [VM instructions] until the next refill
    Memory memory_{account_};
    int collections_ = 0;          ///< of memory, in this tick
    std::size_t chain_ = 0;        ///< the longest that the script made, in tables
    void* first_block_ = nullptr;  ///< of lua_newstate, until the seed is set
    const TextTable* texts_ = nullptr;
    std::optional<std::string> latched_;
    std::exception_ptr ours_;
};

}  // namespace reprise::scripting
