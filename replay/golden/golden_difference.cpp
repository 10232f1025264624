#include "replay/golden/golden_difference.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "world/story/wording.h"

namespace reprise::replay {

namespace {

constexpr const char* nothing = "-";

Changed changed(std::string what, std::string expected, std::string found) {
    Changed out;
    out.what = std::move(what);
    out.expected = std::move(expected);
    out.found = std::move(found);
    return out;
}

std::string verdict_text(const Golden& golden) {
    return golden.reason.empty() ? golden.verdict : golden.verdict + ": " + golden.reason;
}

std::string check_text(const GoldenCheck& check, std::uint64_t step_ns) {
    std::string text = check.status;
    if (check.tick != 0)
        text += " at " + time_text(check.tick, step_ns);
    return check.detail.empty() ? text : text + ", " + check.detail;
}

/// By name: the order is that of the scenario's lines, which move.
void compare_checks(const Golden& expected, const Golden& found, GoldenDifference& difference) {
    using Key = std::pair<std::string, std::size_t>;  // the n-th check of that name
    std::map<Key, std::pair<const GoldenCheck*, const GoldenCheck*>> by_name;
    const auto keyed = [](const std::vector<GoldenCheck>& checks, const auto& put) {
        std::map<std::string, std::size_t> count;
        for (const GoldenCheck& check : checks)
            put(Key(check.name, count[check.name]++), &check);
    };
    keyed(expected.checks, [&](const Key& key, auto check) { by_name[key].first = check; });
    keyed(found.checks, [&](const Key& key, auto check) { by_name[key].second = check; });
    for (const auto& [key, pair] : by_name) {
        const auto& [before, now] = pair;
        const GoldenCheck* any = now != nullptr ? now : before;
        if (before != nullptr && now != nullptr && *before == *now)
            continue;
        Changed change =
            changed(fmt::format("check '{}'", key.first),
                    before == nullptr ? nothing : check_text(*before, expected.step_ns),
                    now == nullptr ? nothing : check_text(*now, found.step_ns));
        change.line = any->line;
        const bool same_end = before != nullptr && now != nullptr && before->status == now->status;
        (same_end ? difference.details : difference.verdicts).push_back(std::move(change));
    }
}

void compare_ends(const Golden& expected, const Golden& found, GoldenDifference& difference) {
    if (expected.verdict != found.verdict || expected.reason != found.reason)
        difference.verdicts.push_back(changed("run", verdict_text(expected), verdict_text(found)));
    compare_checks(expected, found, difference);
    if (expected.ticks != found.ticks) {
        Changed change = changed("ends after",
                                 time_text(expected.ticks, expected.step_ns),
                                 time_text(found.ticks, found.step_ns));
        difference.details.push_back(std::move(change));
    }
}

std::string event_line(const GoldenEvent& event, std::uint64_t step_ns) {
    std::string text = time_text(event.tick, step_ns) + " " + event.kind;
    const auto add = [&](const std::string& before, const std::string& value) {
        if (!value.empty())
            text += before + value;
    };
    add(" ", event.actor);
    add(" with ", event.other);
    add(" '", event.text.empty() ? "" : event.text + "'");
    add(", value ", event.value);
    add(", at ", event.place);
    return text;
}

/// Compares two lists by position; `describe` turns an entry that differs into words.
template <typename Entry, typename Describe>
Tally compare_lists(const std::vector<Entry>& expected,
                    const std::vector<Entry>& found,
                    const Describe& describe) {
    Tally tally;
    tally.all = std::max(expected.size(), found.size());
    for (std::size_t i = 0; i < tally.all; ++i) {
        const Entry* before = i < expected.size() ? &expected[i] : nullptr;
        const Entry* now = i < found.size() ? &found[i] : nullptr;
        if (before != nullptr && now != nullptr && *before == *now)
            continue;
        if (tally.different++ == 0)
            tally.first = describe(before, now);
    }
    return tally;
}

Tally compare_events(const Golden& expected, const Golden& found) {
    return compare_lists(
        expected.events, found.events, [&](const GoldenEvent* before, const GoldenEvent* now) {
            const GoldenEvent& any = now != nullptr ? *now : *before;
            Changed change =
                changed(any.kind,
                        before == nullptr ? nothing : event_line(*before, expected.step_ns),
                        now == nullptr ? nothing : event_line(*now, found.step_ns));
            change.tick =
                before != nullptr && now != nullptr ? std::min(before->tick, now->tick) : any.tick;
            change.line = any.line;
            return change;
        });
}

std::string differing_stages(const Checkpoint& expected, const Checkpoint& found) {
    std::string text;
    for (std::size_t i = 0; i < golden_stages().size(); ++i)
        if (expected.stages[i] != found.stages[i])
            text += (text.empty() ? "" : ", ") + golden_stages()[i];
    return text;
}

Tally compare_checkpoints(const Golden& expected, const Golden& found) {
    return compare_lists(expected.checkpoints,
                         found.checkpoints,
                         [&](const Checkpoint* before, const Checkpoint* now) {
                             Changed change;
                             if (before == nullptr || now == nullptr) {
                                 change = changed("one run is longer",
                                                  before == nullptr ? nothing : before->history,
                                                  now == nullptr ? nothing : now->history);
                                 change.tick = (before != nullptr ? before : now)->tick;
                                 return change;
                             }
                             change = changed(
                                 differing_stages(*before, *now), before->history, now->history);
                             change.tick = std::min(before->tick, now->tick);
                             return change;
                         });
}

/// The first value that differs between two states of one actor at one instant.
Changed first_value(const ActorState& expected, const ActorState& found) {
    const std::size_t count = std::min(expected.values.size(), found.values.size());
    for (std::size_t i = 0; i < count; ++i) {
        const auto& [name, before] = expected.values[i];
        const auto& [other_name, now] = found.values[i];
        if (name != other_name)
            return changed(expected.actor, name + " " + before, other_name + " " + now);
        if (before != now)
            return changed(expected.actor + " " + name, before, now);
    }
    return changed(expected.actor,
                   world::count_of(expected.values.size(), "value"),
                   world::count_of(found.values.size(), "value"));
}

/// The id in "ego#1"; states of one instant are sorted by it.
std::uint64_t id_of(const std::string& label) {
    return std::strtoull(label.c_str() + label.rfind('#') + 1, nullptr, 10);
}

Tally compare_states(const Golden& expected, const Golden& found) {
    return compare_lists(
        expected.states, found.states, [](const ActorState* before, const ActorState* now) {
            Changed change;
            if (before != nullptr && now != nullptr && before->tick == now->tick &&
                before->actor == now->actor) {
                change = first_value(*before, *now);
                change.tick = now->tick;
                return change;
            }
            // The earlier one is missing on the other side.
            const auto key = [](const ActorState& state) {
                return std::pair(state.tick, id_of(state.actor));
            };
            const bool missing = now == nullptr || (before != nullptr && key(*before) < key(*now));
            const ActorState& only = missing ? *before : *now;
            change = changed(only.actor, missing ? "there" : nothing, missing ? nothing : "there");
            change.tick = only.tick;
            return change;
        });
}

Tally compare_background(const Golden& expected, const Golden& found) {
    return compare_lists(expected.background,
                         found.background,
                         [](const BackgroundState* before, const BackgroundState* now) {
                             const auto text = [](const BackgroundState* state) {
                                 return state == nullptr
                                            ? std::string(nothing)
                                            : fmt::format("{}, {}, {}",
                                                          world::count_of(state->cars, "car"),
                                                          world::count_of(state->walkers, "walker"),
                                                          state->digest);
                             };
                             Changed change = changed("the demand", text(before), text(now));
                             change.tick = (before != nullptr ? before : now)->tick;
                             return change;
                         });
}

/// States of actors and of the demand as one list.
Tally joined(Tally actors, const Tally& demand) {
    actors.all += demand.all;
    actors.different += demand.different;
    if (demand.first && (!actors.first || demand.first->tick < actors.first->tick))
        actors.first = demand.first;
    return actors;
}

std::uint64_t last_equal_tick(const Golden& expected, const Golden& found) {
    std::uint64_t last = 0;
    const std::size_t count = std::min(expected.checkpoints.size(), found.checkpoints.size());
    for (std::size_t i = 0; i < count && expected.checkpoints[i] == found.checkpoints[i]; ++i)
        last = expected.checkpoints[i].tick;
    return last;
}

/// The failure of a check is an event too.
bool same_story(const Golden& expected, const Golden& found) {
    const auto failures = [](const Golden& golden) {
        std::map<std::string, std::uint64_t> ticks;
        for (const GoldenCheck& check : golden.checks)
            ticks[check.name] = check.tick;
        return ticks;
    };
    return expected.ticks == found.ticks && failures(expected) == failures(found) &&
           std::ranges::equal(expected.events,
                              found.events,
                              [](const GoldenEvent& before, const GoldenEvent& now) {
                                  return before.same_story(now);
                              });
}

}  // namespace

bool GoldenCheck::operator==(const GoldenCheck& other) const {
    return std::tie(status, tick, name, detail) ==
           std::tie(other.status, other.tick, other.name, other.detail);
}

bool GoldenEvent::operator==(const GoldenEvent& event) const {
    return std::tie(tick, kind, actor, other, text, value, place) == std::tie(event.tick,
                                                                              event.kind,
                                                                              event.actor,
                                                                              event.other,
                                                                              event.text,
                                                                              event.value,
                                                                              event.place);
}

const char* to_word(Severity severity) {
    switch (severity) {
        case Severity::verdicts:
            return "verdicts changed";
        case Severity::events:
            return "events changed";
        case Severity::numbers:
            break;
    }
    return "only numbers changed";
}

std::optional<GoldenDifference> compare(const Golden& expected, const Golden& found) {
    GoldenDifference difference;
    if (expected.step_ns != found.step_ns)
        difference.details.push_back(
            changed("step [ns]", std::to_string(expected.step_ns), std::to_string(found.step_ns)));
    compare_ends(expected, found, difference);
    difference.events = compare_events(expected, found);
    difference.checkpoints = compare_checkpoints(expected, found);
    difference.equal_until = last_equal_tick(expected, found);
    difference.states =
        joined(compare_states(expected, found), compare_background(expected, found));
    if (difference.verdicts.empty() && difference.details.empty() &&
        difference.events.different == 0 && difference.checkpoints.different == 0 &&
        difference.states.different == 0)
        return std::nullopt;
    difference.severity = !difference.verdicts.empty()   ? Severity::verdicts
                          : !same_story(expected, found) ? Severity::events
                                                         : Severity::numbers;
    return difference;
}

std::vector<Changed> start_differences(const Golden& expected, const Golden& found) {
    std::vector<Changed> changes;
    if (expected.scenario_digest != found.scenario_digest)
        changes.push_back(
            changed("the scenario's text", expected.scenario_digest, found.scenario_digest));
    std::vector<std::pair<std::string, std::string>> before = expected.starts;
    for (const auto& [key, value] : found.starts) {
        const auto same_key = [&, name = key](const auto& start) { return start.first == name; };
        const auto at = std::find_if(before.begin(), before.end(), same_key);
        if (at == before.end()) {
            changes.push_back(changed(key, nothing, value));
            continue;
        }
        if (at->second != value)
            changes.push_back(changed(key, at->second, value));
        before.erase(at);
    }
    for (const auto& [key, value] : before)
        changes.push_back(changed(key, value, nothing));
    return changes;
}

}  // namespace reprise::replay
