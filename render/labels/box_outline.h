#pragma once

#include <optional>

#include <Eigen/Geometry>

#include "render/trace/camera.h"

namespace reprise::render {

/// In pixels from the upper left corner; right and bottom are behind the last pixel.
struct PixelBox {
    double left = 0, top = 0, right = 0, bottom = 0;
};

/// Around what of a box lies in the picture, though it reach behind the camera. Nothing when it is
/// nowhere there. `pose_world_box` is that of its middle, `size` along its axes [m].
std::optional<PixelBox> box_in_picture(const Camera& camera,
                                       const Eigen::Isometry3d& pose_world_box,
                                       const Eigen::Vector3d& size);

}  // namespace reprise::render
