#include "kernel/lamp_orders.h"

namespace reprise::kernel {

void LampOrders::apply_commands(const world::TickDraft& next) {
    for (const world::CommandT& command : next.tick.commands) {
        if (command.kind == world::CommandKind::despawn ||
            (command.kind == world::CommandKind::set_lamps && command.lamps_mask == 0))
            orders_.erase(command.actor);
        else if (command.kind == world::CommandKind::set_lamps) {
            Order& order = orders_[command.actor];
            order.mask |= command.lamps_mask;
            order.lamps = static_cast<std::uint16_t>((order.lamps & ~command.lamps_mask) |
                                                     (command.lamps & command.lamps_mask));
        }
    }
}

template <typename Actors>
void LampOrders::light(Actors& actors) const {
    for (auto& actor : actors) {
        const auto order = orders_.find(actor.id());
        if (order != orders_.end())
            actor.mutate_lamps(static_cast<std::uint16_t>((actor.lamps() & ~order->second.mask) |
                                                          order->second.lamps));
    }
}

void LampOrders::light_cars(world::TickDraft& next) const {
    if (!orders_.empty())
        light(next.traffic.cars);
}

void LampOrders::light_vehicles(world::TickDraft& next) const {
    if (!orders_.empty())
        light(next.tick.vehicles);
}

void LampOrders::add_to(world::Hasher& hasher) const {
    for (const auto& [actor, order] : orders_) {
        hasher.add(actor);
        hasher.add(order.lamps);
        hasher.add(order.mask);
    }
}

}  // namespace reprise::kernel
