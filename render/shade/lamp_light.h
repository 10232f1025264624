#pragma once

#include "render/shade/source_grid.h"

namespace reprise::render {

/// What lamps and the moon would give a place if nothing stood between. Whether something does is
/// asked of one of them only, chosen by how much it gives, and seen from the mean of neighbours
/// (Heitz, Hill and McGuire, "Combining Analytic Direct Illumination and Stochastic Shadows",
/// 2018).
struct LampLight {
    Color arriving = Color::Zero();  ///< over pi: what a white surface sends back
    Color shine = Color::Zero();     ///< mirrored towards the eye, radiance
};

/// The light of one place, source by source.
class LampSum {
  public:
    /// `view`: unit vector from the eye to the place.
    LampSum(const ShadingInput& input,
            const SourceGrid& grid,
            const Look& look,
            const Eigen::Vector3f& position,
            const Eigen::Vector3f& view);

    const LampLight& light() const { return light_; }

    bool any() const { return sum_ > 0; }

    /// Where the light comes from that `place`, in [0, 1), falls to when all sources share that
    /// range by what they give; `spot` is on the unit disc, of the lamp's width. A vector to the
    /// source's place, or to beyond everything.
    Eigen::Vector3f towards(float place, const Eigen::Vector2f& spot) const;

  private:
    void add_four(const SourceGrid& grid,
                  const std::uint16_t* sources,
                  std::size_t count,
                  const Look& look,
                  const Eigen::Vector3f& position);
    void add_shine(const SourceGrid& grid,
                   const std::uint16_t* sources,
                   const Look& look,
                   const Eigen::Vector3f& view);
    void add_moon(const Look& look);

    Eigen::Vector3f to_source(std::size_t i) const {
        return {to_source_x_[i], to_source_y_[i], to_source_z_[i]};
    }

    using Numbers = std::array<float, SourceGrid::most + 1>;  // the moon is the last one

    LampLight light_;
    const Moon& moon_;
    std::size_t count_ = 0;  // of what gives nothing, too
    float sum_ = 0;          // of what they give
    alignas(16) Numbers to_source_x_, to_source_y_, to_source_z_, radius_;
    alignas(16) Numbers factor_;  // on the intensity
    alignas(16) Numbers gives_;   // luminance
};

inline Eigen::Vector3f LampSum::towards(float place, const Eigen::Vector2f& spot) const {
    float left = place * sum_;
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        if (gives_[i] <= 0)
            continue;
        chosen = i;
        if (left < gives_[i])
            break;
        left -= gives_[i];
    }
    const Eigen::Vector3f way = to_source(chosen);
    const Eigen::Vector3f across = way.unitOrthogonal();
    const Eigen::Vector3f up = across.cross(way).normalized();
    return way + radius_[chosen] * (spot.x() * across + spot.y() * up);
}

}  // namespace reprise::render
