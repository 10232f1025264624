#include "kernel/infractions.h"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "world/story/wording.h"

namespace reprise::kernel {

namespace {

using replay::Infraction;
using replay::InfractionKind;
using world::EventKind;

std::optional<EventKind> event_of(InfractionKind kind) {
    switch (kind) {
        case InfractionKind::opposite_lane:
            return EventKind::on_opposite_lane;
        case InfractionKind::sidewalk:
            return EventKind::on_sidewalk;
        case InfractionKind::red_light:
            return EventKind::ran_red_light;
        case InfractionKind::stop_sign:
            return EventKind::ran_stop_sign;
        case InfractionKind::speeding:
            return EventKind::speeding;
        case InfractionKind::wrong_way:
            return EventKind::wrong_way;
        case InfractionKind::off_road:
            return EventKind::left_road;
        default:
            return std::nullopt;  // those have events of their own
    }
}

/// "ran a red light on main_1 at 12.3 m/s"
std::string text_of(const Infraction& infraction, const world::TownT& town) {
    const std::string where = infraction.lane < town.lanes.size()
                                  ? " on " + town.lanes[infraction.lane].name
                                  : std::string();
    const std::string speed = world::with_decimals(infraction.worst, 1);
    switch (infraction.kind) {
        case InfractionKind::opposite_lane:
            return fmt::format("is over an opposite lane{}: {:.0f} % of its footprint",
                               where,
                               100 * infraction.worst);
        case InfractionKind::sidewalk:
            return fmt::format(
                "is over a sidewalk{}: {:.0f} % of its footprint", where, 100 * infraction.worst);
        case InfractionKind::red_light:
            return fmt::format("ran a red light{} at {} m/s", where, speed);
        case InfractionKind::stop_sign:
            return fmt::format("ran a stop sign{} at {} m/s", where, speed);
        case InfractionKind::speeding:
            return fmt::format("is {} m/s above the limit{}", speed, where);
        case InfractionKind::wrong_way:
            return fmt::format("drives the wrong way{}", where);
        default:
            return "left the road";
    }
}

}  // namespace

void Infractions::note(const world::TickView& last, world::TickDraft& next) {
    hear_spawns(*last.tick, spawns_);
    for (const world::VehicleState& vehicle : last.vehicles()) {
        const world::Measurement* measured = world::find(last.measurements(), vehicle.id());
        if (measured == nullptr || !replay::is_driven(spawns_, vehicle.id()))
            continue;
        const auto [found, is_new] = watched_.try_emplace(vehicle.id());
        Watched& watched = found->second;
        if (is_new)
            watched.watches = replay::all_watches(town_);
        const replay::Sight sight = replay::see(last, vehicle, *measured, step_, watched.seen);
        for (const auto& watch : watched.watches) {
            watch->look(sight);
            watch->take();
            for (const Infraction& infraction : watch->take_begun()) {
                const auto kind = event_of(infraction.kind);
                if (!kind)
                    continue;
                world::EventT event;
                event.kind = *kind;
                event.actor = vehicle.id();
                event.value = infraction.worst;
                event.text = text_of(infraction, town_.town);
                next.tick.events.push_back(std::move(event));
            }
        }
    }
}

}  // namespace reprise::kernel
