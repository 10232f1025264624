#include "replay/golden/pins.h"

#include <algorithm>
#include <set>

#include "world/check.h"

namespace reprise::replay {

namespace {

/// "ego" of "ego#1".
std::string name_of(const ActorState& state) {
    return state.actor.substr(0, state.actor.rfind('#'));
}

}  // namespace

void check_pins(const Golden& golden) {
    std::set<std::string> names;
    for (const ActorState& state : golden.states)
        names.insert(name_of(state));
    for (const std::string& pin : golden.pins) {
        if (pin == "verdict" || pin == "events" || names.contains(pin))
            continue;
        std::vector<std::string> words{"verdict", "events", "numbers"};
        words.insert(words.end(), names.begin(), names.end());
        std::string list;
        for (const std::string& word : words)
            list += (list.empty() ? "" : ", ") + word;
        throw world::Error("a golden cannot pin '" + pin + "'" + world::did_you_mean(pin, words) +
                           "; there are " + list);
    }
}

void keep_pinned(Golden& golden) {
    const auto pinned = [&](const std::string& what) {
        return std::find(golden.pins.begin(), golden.pins.end(), what) != golden.pins.end();
    };
    if (golden.pins.empty())
        return;
    golden.checkpoints.clear();
    golden.background.clear();
    std::erase_if(golden.states, [&](const ActorState& state) { return !pinned(name_of(state)); });
    for (GoldenCheck& check : golden.checks) {
        check.detail.clear();
        check.tick = pinned("events") ? check.tick : 0;
    }
    for (GoldenEvent& event : golden.events) {
        event.value.clear();
        event.place.clear();
    }
    if (!pinned("events")) {
        golden.events.clear();
        golden.ticks = 0;
    }
}

}  // namespace reprise::replay
