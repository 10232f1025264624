#include "world/external/external_drivers.h"

#include <algorithm>

namespace reprise::world {

void ExternalDrivers::hear(const Tick& tick) {
    hear_spawns(tick, spawns_);
    std::erase_if(spawns_,
                  [](const auto& one) { return one.second.command.driver != Driver::external; });
}

bool ExternalDrivers::explain(const Outcome& outcome) const {
    if (outcome == outcome_of_ended_by_client(outcome.ticks) ||
        outcome == outcome_of_ended_by_server(outcome.ticks))
        return true;
    return std::any_of(spawns_.begin(), spawns_.end(), [&](const auto& one) {
        const std::string& name = one.second.command.text;
        return outcome == outcome_of_lost_driver(name, outcome.ticks) ||
               outcome == outcome_of_left_driver(name, outcome.ticks);
    });
}

}  // namespace reprise::world
