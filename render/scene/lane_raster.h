#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "world/town_generated.h"

namespace reprise::render {

/// How far the ground is from the nearest lane's centre line, for wheel tracks and gutters: a grid
/// seen from above. A quarter of a metre fine, coarser for towns above 2 km.
class LaneRaster {
  public:
    LaneRaster(const world::TownT& town, const Eigen::Vector3d& origin);

    /// [m] in the scene's frame; 4 where no lane is near.
    float distance(float x, float y) const;

  private:
    void stamp(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float half_width);

    Eigen::Vector2f low_;
    float cell_ = 0.25F;
    int columns_ = 0;
    int rows_ = 0;
    std::vector<std::uint8_t> distances_;  // in units of 1/60 m
};

}  // namespace reprise::render
