#pragma once

#include "render/shapes/fast_math.h"

namespace reprise::render {

/// What a porous surface of this albedo sends back when a film of water lies on it: light that the
/// film keeps in falls onto the surface again. Angstrom, 1925; Lekner and Dorf, "Why some things
/// are darker when wet", 1988, for an index of 1.33: p = 0.472 of the light from below is thrown
/// back, 0.066 of that from above never enters.
inline Color wet_albedo(const Color& dry) {
    constexpr float kept_in = 0.472F;
    constexpr float thrown_back = 0.066F;
    return dry * ((1 - thrown_back) * (1 - kept_in)) / (1 - kept_in * dry);
}

/// Where this share of the pores is filled.
inline Color soaked(const Color& dry, float share) {
    return mix(dry, wet_albedo(dry), share);
}

}  // namespace reprise::render
