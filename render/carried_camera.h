#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "render/trace/camera.h"
#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::render {

/// Where a camera is at a tick, in the scene's frame, whose `origin` lies in the world. Nothing
/// where its carrier is not in the tick.
std::optional<Camera> find_camera(const world::TickView& tick,
                                  const world::SensorSpec& spec,
                                  const Eigen::Vector3d& origin);

/// Likewise. Throws world::Error where its carrier is not there, or its numbers say no camera.
Camera camera_of(const world::TickView& tick,
                 const world::SensorSpec& spec,
                 const Eigen::Vector3d& origin);

/// Who is out of sight for a camera: the actor that it is fixed to. 0: nobody.
std::uint32_t hidden_from(const world::TickView& tick, const world::SensorSpec& spec);

}  // namespace reprise::render
