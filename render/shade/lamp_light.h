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

    bool any() const { return count_ > 0; }

    /// Where the light comes from that `place`, in [0, 1), falls to when all sources share that
    /// range by what they give; `spot` is on the unit disc, of the lamp's width. A vector to the
    /// source's place, or to beyond everything.
    Eigen::Vector3f towards(float place, const Eigen::Vector2f& spot) const;

  private:
    void add_source(const LightSource& source,
                    const Look& look,
                    const Eigen::Vector3f& position,
                    const Eigen::Vector3f& view);
    void add_moon(const Look& look);

    struct Part {
        Eigen::Vector3f to_source;
        float gives;
        float radius;
    };

    LampLight light_;
    const Moon& moon_;
    std::array<Part, SourceGrid::most + 1> parts_;
    std::size_t count_ = 0;
    float sum_ = 0;
};

}  // namespace reprise::render
