#pragma once

#include "render/shapes/fast_math.h"
#include "world/common_generated.h"

namespace reprise::render {

/// How fog, rain, snow and dust hide what is behind them.
class Veil {
  public:
    explicit Veil(const world::Weather& weather);

    /// The town's lowest ground in the scene's frame: from there heights of fog count.
    void stand_on(float ground) { ground_ = ground; }

    /// Share of the light that passes from a place at height `from` (scene) over a distance along a
    /// unit vector that rises by `rise` a metre.
    float passes(float from, float rise, float distance) const;

    /// Likewise from the ground to the open sky: at 1 straight up, at 0 level.
    float passes_upwards(float rise) const {
        return fast_exp(-upwards_ / (std::max(rise, 0.0F) + 0.06F));
    }

    /// Mean extinction at the ground. [1/m]
    float extinction() const { return even_ + fog_; }

    /// What the veil looks like in white light: dust is brown.
    const Color& tint() const { return tint_; }

  private:
    float fog_;      // [1/m]
    float base_;     // [m]
    float falloff_;  // [1/m]
    float even_;     // [1/m] of what is at every height
    float upwards_;  // optical depth straight up, of what hides the sky
    float ground_ = 0;
    Color tint_;
};

}  // namespace reprise::render
