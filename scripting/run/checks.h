#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "world/check_result.h"

struct lua_State;

namespace reprise::world {
class Hasher;
}

namespace reprise::scripting {

struct StepContext;

/// What a scenario promises. Three-valued: a check that never had anything to look at did not pass.
/// Evaluated once a tick, starting with the tick after it was registered; a tick in which an actor
/// that the predicate asks about is not on the road does not count. One that has failed is watched
/// on, to say at the end how bad it became.
class Checks {
  public:
    enum class Kind : std::uint8_t { never, always, max, min, eventually, at_end };

    /// Registers the check that Lua's check.<kind>(name, function, ...) describes; of never
    /// 'blocked' needs no function.
    void add(StepContext& context, lua_State* L, Kind kind);

    /// Evaluates what is still open on context.last.
    void evaluate(StepContext& context);

    /// The last word: on context.last as the final tick.
    void conclude(StepContext& context);

    std::vector<world::CheckResult> results() const;

    void digest(world::Hasher& hasher) const;

  private:
    struct Entry {
        Kind kind = Kind::never;
        std::string name;
        int reference = 0;                      ///< of the predicate, in Lua's registry; 0: none
        double limit = 0;                       ///< max, min
        std::uint64_t since = 0;                ///< tick of its registration
        std::optional<std::uint64_t> deadline;  ///< eventually: last tick that counts
        double within = 0;                      ///< [s] as the scenario said it
        bool stop = false;                      ///< a failure ends the run
        bool optional = false;                  ///< never evaluated is no fault
        std::uint32_t line = 0;
        bool evaluated = false;
        std::optional<double> extreme;  ///< max, min: the worst value so far
        std::uint64_t extreme_tick = 0;
        std::uint64_t bad_ticks = 0;      ///< never, always: in which it failed
        std::uint64_t last_bad_tick = 0;  ///< of them
        bool decided = false;
        world::CheckResult::Status status = world::CheckResult::Status::not_evaluated;
        std::uint64_t tick = 0;         ///< that it failed in
        std::uint64_t recorded_in = 0;  ///< the tick that holds the event of that
        std::string detail;
        std::string worst;  ///< said at the end
    };

    static bool is_open(const Entry& entry);

    void look(StepContext& context, Entry& entry);
    void look_for_blocked(StepContext& context, Entry& entry);
    void judge(StepContext& context, Entry& entry, bool holds);
    void judge(StepContext& context, Entry& entry, double value);
    void fail(StepContext& context, Entry& entry, double value, const std::string& detail);
    void settle(StepContext& context, Entry& entry);
    void tell_worst(StepContext& context, Entry& entry);

    std::vector<Entry> entries_;
    bool concluded_ = false;
};

}  // namespace reprise::scripting
