#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "render/trace/instance.h"

namespace reprise::render {

/// What of a town lies under a roof or a bridge, and stays dry: the height of the uppermost roof,
/// deck or ground over each half metre, where any is above another. Leaves keep nothing dry.
class Shelter {
  public:
    /// 0.1 s and 10 MB for a town of a square kilometre.
    explicit Shelter(std::span<const Instance> still);

    /// 1 where rain and snow fall onto, 0 below something; between these at its edge. `place` in
    /// the scene's frame.
    float openness(const Eigen::Vector3f& place) const;

  private:
    using Corners = std::array<Eigen::Vector3f, 3>;

    float top(int column, int row) const;
    void raise(const Corners& corners);

    Eigen::Vector2f low_ = Eigen::Vector2f::Zero();
    int columns_ = 0;  // of tiles
    int rows_ = 0;
    std::vector<std::int32_t> tiles_;  // where each tile's heights begin; -1: nothing is above
    std::vector<float> tops_;
};

}  // namespace reprise::render
