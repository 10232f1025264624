#pragma once

#include <optional>

#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::render {

/// The tick before or behind that which is looked at.
struct Neighbour {
    world::TickView tick;
    world::SensorRig rig;  ///< the sensors in their places there; empty: in those of the tick
};

/// For sensors that say how things move; who has none says that it is not known.
struct Neighbours {
    std::optional<Neighbour> last;
    std::optional<Neighbour> next;
};

}  // namespace reprise::render
