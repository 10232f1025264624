#include "world/spawns.h"

namespace reprise::world {

void hear_spawns(const Tick& tick, Spawns& spawns) {
    if (tick.commands() == nullptr)
        return;
    for (const Command* command : *tick.commands()) {
        if (command->kind() == CommandKind::despawn)
            spawns.erase(command->actor());
        if (command->kind() == CommandKind::spawn) {
            Spawn& spawn = spawns[command->actor()];
            command->UnPackTo(&spawn.command);
            spawn.tick = tick.index();
        }
    }
}

}  // namespace reprise::world
