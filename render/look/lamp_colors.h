#pragma once

#include "render/shapes/fast_math.h"

/// Light of lamps, brightest channel about 1.
namespace reprise::render {

inline const Color street_lamp_color(1.0F, 0.80F, 0.52F);
inline const Color head_lamp_color(1.0F, 0.95F, 0.84F);

// Signals' and cars' lenses (ECE R65 and EN 12368: deep red, yellow, bluish green).
inline const Color lens_red(1.0F, 0.02F, 0.012F);
inline const Color lens_amber(1.0F, 0.42F, 0.02F);
inline const Color lens_green(0.02F, 0.95F, 0.24F);

}  // namespace reprise::render
