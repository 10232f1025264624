#include "render/readings/readings.h"

namespace reprise::render {

std::vector<world::Reading> collision_readings(const world::TickView& tick,
                                               const world::SensorSpec& spec) {
    std::vector<world::Reading> found;
    if (tick.tick->events() == nullptr || spec.actor == 0)
        return found;
    for (const world::Event* event : *tick.tick->events()) {
        const bool ends = event->kind() == world::EventKind::collision_ended;
        if (!ends && event->kind() != world::EventKind::collision)
            continue;
        if (event->actor() != spec.actor && event->other() != spec.actor)
            continue;
        const std::uint32_t other = event->actor() == spec.actor ? event->other() : event->actor();
        const world::Vec3* place = event->position();
        found.push_back({static_cast<double>(other),
                         event->value(),
                         place != nullptr ? place->x() : 0,
                         place != nullptr ? place->y() : 0,
                         place != nullptr ? place->z() : 0,
                         ends ? 1.0 : 0.0});
    }
    return found;
}

}  // namespace reprise::render
