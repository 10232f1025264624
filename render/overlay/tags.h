#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "render/trace/camera.h"
#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::render {

/// The scenario's actors.
using ActorNames = std::map<std::uint32_t, std::string>;

/// What stands above an actor in a picture.
struct Tag {
    std::uint32_t actor = 0;
    std::string text;  ///< "ego 43 km/h"; of the demand's cars the speed alone
    double x = 0;      ///< [px] of the point over the actor that it stands on
    double y = 0;      ///< [px]
    double depth = 0;  ///< [m] of that point
    bool named = false;
    bool hidden = false;  ///< something stands before the actor: shown faintly
};

/// The tags of a tick, the farthest first. `camera` in the world's frame, `depth` what it sees.
/// Actors of the scenario have one wherever they are in the picture, others where they are seen and
/// near. `carrier`: who carries the camera, and has none.
std::vector<Tag> tags_of(const world::TickView& tick,
                         const ActorNames& names,
                         const Camera& camera,
                         const world::SensorFrame& depth,
                         std::uint32_t carrier);

}  // namespace reprise::render
