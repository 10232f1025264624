#include "cli/pictures/recorded_rig.h"

namespace reprise::cli {

std::optional<world::Rig> recorded_rig(replay::TraceReader& trace,
                                       std::uint32_t actor,
                                       std::uint64_t last) {
    for (std::uint64_t index = trace.first(); index <= last; ++index)
        for (const world::Command* command : *trace.tick(index).view.tick->commands()) {
            if (command->kind() != world::CommandKind::spawn ||
                (actor != 0 && command->actor() != actor))
                continue;
            world::Rig rig = world::rig_of(*command, index);
            if (!rig.sensors.empty())
                return rig;
            if (actor != 0)
                return std::nullopt;
        }
    return std::nullopt;
}

}  // namespace reprise::cli
