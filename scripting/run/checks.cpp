#include "scripting/run/checks.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/text.h"
#include "scripting/run/caps.h"
#include "scripting/run/language.h"
#include "scripting/run/step_context.h"
#include "scripting/run/tasks.h"
#include "world/blockage.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::scripting {

namespace {

using Kind = Checks::Kind;
using Status = world::CheckResult::Status;

constexpr const char* blocked = "blocked";  // check.never knows by itself what that is

constexpr const char* names[] = {
    "check.never", "check.always", "check.max", "check.min", "check.eventually", "check.at_end"};

/// A failure of one of these may become worse.
bool may_get_worse(Kind kind) {
    return kind != Kind::eventually && kind != Kind::at_end;
}

bool has_limit(Kind kind) {
    return kind == Kind::max || kind == Kind::min;
}

world::EventT event(world::EventKind kind,
                    const std::string& name,
                    const std::string& detail,
                    double value,
                    unsigned line) {
    world::EventT event;
    event.kind = kind;
    event.text = name;
    event.detail = detail;
    event.value = value;
    event.line = line;
    return event;
}

constexpr Key check_key_rows[] = {
    {"stop", "boolean", "ends the run when it fails; not for what fails at the end only"},
    {"optional", "boolean", "passes when there was nothing to look at"},
};

constexpr Key deadline_key_rows[] = {
    {"stop", "boolean", "ends the run when it fails; needs 'within'"},
    {"optional", "boolean", "passes when there was nothing to look at"},
    {"within", "number", "[s] from now on; without it until the end"},
};

}  // namespace

constinit const KeyList check_keys{"CheckOptions", "check.*", check_key_rows};
constinit const KeyList deadline_keys{"DeadlineOptions", "check.eventually", deadline_key_rows};

void Checks::add(StepContext& context, lua_State* L, Kind kind) {
    const std::string who = names[static_cast<std::size_t>(kind)];
    Entry entry;
    entry.kind = kind;
    entry.name = name_at(L, 1, who, "the name");
    const bool built_in =
        kind == Kind::never && entry.name == blocked && lua_type(L, 2) != LUA_TFUNCTION;
    if (!built_in)
        want_function(L, 2, who, "the second argument");
    context.vm.charge(L, entries_.size() + 100);
    if (entries_.size() >= most_checks)
        refuse(who, fmt::format("more than {} checks", most_checks));
    for (const Entry& other : entries_)
        if (other.name == entry.name)
            refuse(who, fmt::format("the name '{}' is taken in line {}", entry.name, other.line));
    int options_index = built_in ? 2 : 3;
    if (has_limit(kind))
        entry.limit = number_at(L, options_index++, who, "the limit");
    const KeyList& keys = kind == Kind::eventually ? deadline_keys : check_keys;
    const Fields options(L, options_index, who, names_of(keys.keys), true);
    entry.stop = options.flag("stop").value_or(false);
    const bool at_the_end =
        kind == Kind::at_end || (kind == Kind::eventually && !options.has("within"));
    if (entry.stop && at_the_end)
        refuse(who,
               "'stop' has no effect: this check fails at the end, when the run stops anyway" +
                   std::string(kind == Kind::eventually ? "; give it 'within'" : ""));
    entry.optional = options.flag("optional").value_or(false);
    entry.since = context.now();
    if (kind == Kind::eventually && options.has("within")) {
        entry.within = *options.number("within");
        if (entry.within <= 0 || entry.within > 1e9)
            refuse(who, "'within' must be in (0, 1e9] s");
        entry.deadline = context.now() + ticks_of(entry.within, context.episode.step_ns);
    }
    entry.line = context.vm.line(L);
    if (!built_in) {
        lua_pushvalue(L, 2);
        entry.reference = luaL_ref(L, LUA_REGISTRYINDEX);
    }
    entries_.push_back(std::move(entry));
}

void Checks::evaluate(StepContext& context) {
    for (Entry& entry : entries_)
        if (is_open(entry) && entry.since < context.now() && entry.kind != Kind::at_end)
            look(context, entry);
}

/// Not decided, or failed and watched on.
bool Checks::is_open(const Entry& entry) {
    return !entry.decided ||
           (entry.status == Status::fail && entry.reference != 0 && may_get_worse(entry.kind));
}

/// Is a vehicle with mass blocked in context.last? A state, not the event: also of those who were
/// it before this check came, such as in a branch.
void Checks::look_for_blocked(StepContext& context, Entry& entry) {
    for (const world::Measurement& measured : context.last.measurements()) {
        entry.evaluated = true;
        if (!world::is_blocked(measured, context.episode.step_ns))
            continue;
        const double since =
            world::seconds(context.now() - measured.halted_ticks(), context.episode.step_ns);
        fail(
            context, entry, since, fmt::format("actor {} since {:.2f} s", measured.actor(), since));
        return;
    }
}

/// Asks the predicate about context.last.
void Checks::look(StepContext& context, Entry& entry) {
    if (entry.reference == 0)
        return look_for_blocked(context, entry);
    lua_State* L = context.vm.main();
    lua_rawgeti(L, LUA_REGISTRYINDEX, entry.reference);
    if (!context.vm.ask())
        return;
    const int type = lua_type(L, -1);
    const double value = lua_tonumber(L, -1);
    const bool holds = lua_toboolean(L, -1) != 0;
    lua_pop(L, 1);
    if (!has_limit(entry.kind)) {
        entry.evaluated = true;
        judge(context, entry, holds);
        return;
    }
    if (type == LUA_TNIL)
        return;  // nothing to measure in this tick
    if (type != LUA_TNUMBER || std::isnan(value))
        throw world::Error(
            fmt::format("{}:{}: check '{}': the function must return a number, got {}",
                        context.vm.script(),
                        entry.line,
                        entry.name,
                        type == LUA_TNUMBER ? number_text(value) : lua_typename(L, type)));
    entry.evaluated = true;
    judge(context, entry, value);
}

void Checks::judge(StepContext& context, Entry& entry, bool holds) {
    const bool never = entry.kind == Kind::never;
    switch (entry.kind) {
        case Kind::never:
        case Kind::always:
            if (holds != never)
                break;
            ++entry.bad_ticks;
            entry.last_bad_tick = context.now();
            fail(context, entry, never ? 1 : 0, never ? "it happened" : "it did not hold");
            break;
        case Kind::at_end:
            if (!holds)
                fail(context, entry, 0, "it did not hold at the end");
            break;
        default:
            if (holds) {
                entry.decided = true;
                entry.status = Status::pass;
            } else if (entry.deadline && context.now() >= *entry.deadline) {
                fail(context, entry, 0, fmt::format("not within {} s", entry.within));
            }
    }
}

void Checks::judge(StepContext& context, Entry& entry, double value) {
    const bool max = entry.kind == Kind::max;
    if (!entry.extreme || (max ? value > *entry.extreme : value < *entry.extreme))
        std::tie(entry.extreme, entry.extreme_tick) = std::pair(value, context.now());
    if (max ? value > entry.limit : value < entry.limit)
        fail(context,
             entry,
             value,
             fmt::format("{:.6g} is {} than {}", value, max ? "more" : "less", entry.limit));
}

/// The first time; from then on it is only counted.
void Checks::fail(StepContext& context, Entry& entry, double value, const std::string& detail) {
    if (entry.decided)
        return;
    entry.decided = true;
    entry.status = Status::fail;
    entry.tick = context.now();
    entry.recorded_in = context.next->tick.index;
    entry.detail = detail;
    context.next->tick.events.push_back(
        event(world::EventKind::check_failed, entry.name, detail, value, entry.line));
    if (entry.stop && !context.finished)
        context.finish("check failed: " + entry.name, entry.line);
}

void Checks::conclude(StepContext& context) {
    if (concluded_)
        return;
    concluded_ = true;
    for (Entry& entry : entries_) {
        if (is_open(entry))
            look(context, entry);
        settle(context, entry);
    }
}

/// Turns what is left open into a verdict and says it as an event.
void Checks::settle(StepContext& context, Entry& entry) {
    if (entry.status == Status::fail) {
        tell_worst(context, entry);
        return;
    }
    if (!entry.decided && entry.evaluated && entry.kind == Kind::eventually) {
        fail(context, entry, 0, "not until the end");
        return;
    }
    entry.decided = true;
    if (entry.evaluated || entry.optional)
        entry.status = Status::pass;
    if (!entry.evaluated)
        entry.detail = "nothing to look at";
    else if (entry.extreme)
        entry.detail = fmt::format("{} {:.6g} at {:.2f} s, allowed {}",
                                   entry.kind == Kind::max ? "at most" : "at least",
                                   *entry.extreme,
                                   world::seconds(entry.extreme_tick, context.episode.step_ns),
                                   entry.limit);
    const auto kind = entry.status == Status::pass ? world::EventKind::check_passed
                                                   : world::EventKind::not_evaluated;
    context.next->tick.events.push_back(
        event(kind, entry.name, entry.detail, entry.extreme.value_or(0), entry.line));
}

/// An event, where it became worse than it was when it failed.
void Checks::tell_worst(StepContext& context, Entry& entry) {
    const auto time = [&](std::uint64_t tick) {
        return world::seconds(tick, context.episode.step_ns);
    };
    double value = 0;
    if (has_limit(entry.kind) && entry.extreme_tick > entry.tick) {
        value = *entry.extreme;
        entry.worst = fmt::format(
            "{}{:.6g} at {:.2f} s", world::worst_prefix, value, time(entry.extreme_tick));
    } else if (entry.bad_ticks > 1) {
        value = time(entry.bad_ticks);
        entry.worst = fmt::format("{}{:.2f} s in all, until {:.2f} s",
                                  world::worst_prefix,
                                  value,
                                  time(entry.last_bad_tick));
    } else {
        return;
    }
    context.next->tick.events.push_back(
        event(world::EventKind::check_failed, entry.name, entry.worst, value, entry.line));
}

std::vector<world::CheckResult> Checks::results() const {
    std::vector<world::CheckResult> results;
    for (const Entry& entry : entries_)
        results.push_back(
            {entry.name, entry.status, entry.recorded_in, entry.detail, entry.worst, entry.line});
    return results;
}

void Checks::digest(world::Hasher& hasher) const {
    const auto add_flag = [&](bool flag) { hasher.add(static_cast<std::uint8_t>(flag)); };
    hasher.add(static_cast<std::uint64_t>(entries_.size()));
    add_flag(concluded_);
    for (const Entry& entry : entries_) {
        hasher.add(entry.kind);
        hasher.add_text(entry.name);
        hasher.add(entry.limit);
        hasher.add(entry.since);
        add_flag(entry.deadline.has_value());
        hasher.add(entry.deadline.value_or(0));
        add_flag(entry.stop);
        add_flag(entry.optional);
        add_flag(entry.evaluated);
        add_flag(entry.extreme.has_value());
        hasher.add(entry.extreme.value_or(0));
        hasher.add(entry.extreme_tick);
        hasher.add(entry.bad_ticks);
        hasher.add(entry.last_bad_tick);
        add_flag(entry.decided);
        hasher.add(entry.status);
        hasher.add(entry.tick);
        hasher.add_text(entry.detail);
    }
}

}  // namespace reprise::scripting
