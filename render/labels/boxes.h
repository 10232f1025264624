#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/trace/camera.h"
#include "world/tick.h"

namespace reprise::render {

/// In pixels from the upper left corner; right and bottom are behind the last pixel.
struct PixelBox {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// The box around an actor, with what its limbs reach.
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
    PixelBox whole;                 ///< around its box in space, cut off at the picture's border
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
