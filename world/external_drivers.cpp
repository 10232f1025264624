#include "world/external_drivers.h"

#include <algorithm>

namespace reprise::world {

void ExternalDrivers::hear(const Tick& tick) {
    if (tick.commands() == nullptr)
        return;
    for (const Command* command : *tick.commands()) {
        if (command->kind() == CommandKind::despawn)
            names_.erase(command->actor());
        if (command->kind() == CommandKind::spawn && command->driver() == Driver::external)
            names_[command->actor()] = command->text() == nullptr ? "" : command->text()->str();
    }
}

bool ExternalDrivers::explain(const Outcome& outcome) const {
    return std::any_of(names_.begin(), names_.end(), [&](const auto& one) {
        return outcome == outcome_of_lost_driver(one.second, outcome.ticks);
    });
}

}  // namespace reprise::world
