#include "kernel/doors.h"

#include <algorithm>

namespace reprise::kernel {

void Doors::apply_commands(const world::TickDraft& next) {
    for (const world::CommandT& command : next.tick.commands) {
        if (command.kind == world::CommandKind::despawn)
            orders_.erase(command.actor);
        else if (command.kind == world::CommandKind::set_doors)
            orders_[command.actor].open = command.doors;
    }
}

void Doors::swing(double step, world::TickDraft& next) {
    for (auto at = orders_.begin(); at != orders_.end();) {
        auto& [actor, order] = *at;
        bool any = order.open != 0;
        for (std::uint8_t door = 0; door < world::door_count; ++door) {
            double& angle = order.angles[door];
            const double wanted = (order.open >> door & 1U) != 0 ? world::widest_door : 0;
            const double most = world::door_rate * step;
            angle += std::clamp(wanted - angle, -most, most);
            if (angle > 0)
                next.tick.doors.emplace_back(angle, actor, door, std::uint8_t{0}, std::uint16_t{0});
            any = any || angle > 0;
        }
        at = any ? std::next(at) : orders_.erase(at);
    }
}

void Doors::add_to(world::Hasher& hasher) const {
    for (const auto& [actor, order] : orders_) {
        hasher.add(actor);
        hasher.add(order.open);
        for (const double angle : order.angles)
            hasher.add(angle);
    }
}

}  // namespace reprise::kernel
