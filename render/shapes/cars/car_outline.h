#pragma once

#include <span>

#include "world/models/catalogue.h"

namespace reprise::render {

/// A point of a side or plan view: share of the length from the rear, share of height or half
/// width.
struct Knot {
    float x;
    float value;
};

/// How a kind of body looks from the side and from above, see CarShape.
struct Outline {
    std::span<const Knot> top;
    std::span<const Knot> belt;
    std::span<const Knot> plan;
    float body_start;
    float sill;
    float tumble_home;
    float boxiness;
};

/// Two-wheelers have none of their own: a plain box.
const Outline& outline_of(world::BodyStyle style);

/// A cubic through the knots whose slopes never overshoot (harmonic mean: Fritsch and Butland, "A
/// method for constructing local monotone piecewise cubic interpolants", 1984).
float interpolate(std::span<const Knot> knots, float x);

}  // namespace reprise::render
