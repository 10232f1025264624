#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/labels/box_outline.h"
#include "render/trace/camera.h"
#include "world/tick.h"

namespace reprise::render {

/// The box around an actor; of somebody on foot as he is at this tick, with limbs and luggage.
struct ActorBox {
    Eigen::Isometry3d pose_world;  ///< of its middle; x ahead
    Eigen::Vector3d size;          ///< [m] along it, across, upwards
};

/// Nothing when it is not in the tick.
std::optional<ActorBox> actor_box(const world::TickView& tick, std::uint32_t actor);

/// An actor in a picture.
struct LabelBox {
    std::uint32_t actor = 0;
    std::uint16_t instance = 0;
    world::SemanticClass what = world::SemanticClass::unlabeled;
    std::size_t pixels = 0;         ///< that show it
    PixelBox seen;                  ///< around these
    PixelBox whole;                 ///< around what the picture would show of its box in space
    Eigen::Vector3d size;           ///< [m] along it, across, upwards
    Eigen::Isometry3d pose_camera;  ///< of the middle of its box: to the camera's frame
};

/// Of all actors that at least one pixel shows, by their id. `camera` in the world's frame;
/// `instances` and `classes` are what it sees.
std::vector<LabelBox> boxes_of(const world::TickView& tick,
                               const Camera& camera,
                               const world::SensorFrame& instances,
                               const world::SensorFrame& classes);

}  // namespace reprise::render
