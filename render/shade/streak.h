#pragma once

#include <vector>

#include "render/shade/frame.h"

namespace reprise::render {

/// What falls, drawn along its way while the shutter is open.
struct Streak {
    Eigen::Vector3d from;  ///< on the picture [px], with the depth [m] as z
    Eigen::Vector3d to;
    float half_width;  ///< [px]
    float strength;    ///< share of the light behind that it replaces
    float lit = 0;     ///< is at least so many times as bright as what is behind it, up to white
};

inline constexpr double exposure_time = 1.0 / 60;  ///< [s]

/// Adds a line with soft edges wherever nothing is nearer: not below the ground that it falls onto.
/// Both ends lie ahead of the camera.
void draw_streak(const Streak& streak,
                 const Color& light,
                 const std::vector<Hit>& hits,
                 Frame& frame);

}  // namespace reprise::render
