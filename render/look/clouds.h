#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "world/common_generated.h"

namespace reprise::render {

/// A layer of clouds over the town: it drifts with the wind, and its shadows with it. Where they
/// are is a function of weather, tick and place alone: when the wind changes, all of their way
/// changes with it.
class Clouds {
  public:
    explicit Clouds(const world::Weather& weather);

    /// Before anything is asked: from where one looks, and when.
    void look_from(const Eigen::Vector3f& eye, const Eigen::Vector3f& to_sun, std::uint64_t tick);

    /// How much of the sky is hidden in a direction (unit vector), in [0, 1].
    float cover(const Eigen::Vector3f& direction) const;

    /// Factor on the mean sunlight that reaches a place; its mean over wide places is about 1.
    float sunlight(const Eigen::Vector3f& place) const;

  private:
    float density(float x, float y) const;
    void fill_table(int left, int low);

    float share_;             // of the sky
    float contrast_;          // between sun and shadow
    float level_;             // of the noise, above which a cloud begins
    Eigen::Vector2f speed_;   // [layer units/s]
    Eigen::Vector2f offset_;  // of the eye over the pattern [layer units]
    Eigen::Vector2f eye_;
    Eigen::Vector2f corner_;  // of the table
    int left_ = 0;            // cell of the pattern that the table begins with
    int low_ = 0;
    std::vector<float> table_;  // factors on a grid that drifts with the pattern
};

}  // namespace reprise::render
