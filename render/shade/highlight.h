#pragma once

#include <algorithm>

#include "render/shapes/fast_math.h"

namespace reprise::render {

/// How strongly a rough mirror shows a small light, for the cosine between its normal and the
/// middle between light and eye.
inline float highlight(float roughness, float normal_half) {
    // Trowbridge and Reitz (GGX), with masking folded into a constant.
    const float a = std::max(roughness * roughness, 0.004F);
    const float a2 = a * a;
    const float base = normal_half * normal_half * (a2 - 1) + 1;
    return a2 / (4 * pi * base * base);
}

}  // namespace reprise::render
