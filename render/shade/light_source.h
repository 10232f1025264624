#pragma once

#include <cstdint>
#include <vector>

#include "render/look/look.h"

namespace reprise::render {

/// A lamp that throws light on what is around it.
struct LightSource {
    enum class Lobe : std::uint8_t {
        street,    ///< down and to all sides, least straight down, none above the horizon
        lantern,   ///< all around, but not up
        lens,      ///< of a car: mostly ahead
        signal,    ///< of a signal: a narrow bundle, for who comes towards it
        window,    ///< as a flat surface that shines evenly
        low_beam,  ///< a head lamp's: wide, bright below a line that rises at the kerb's side
    };

    Eigen::Vector3f position;  ///< scene
    Eigen::Vector3f axis;      ///< unit vector, where a lens or a low beam points
    Eigen::Vector3f left;      ///< unit vector, of a low beam
    Color intensity;           ///< where it is brightest: radiance times area, over pi [m2]
    float reach;               ///< [m] nothing arrives beyond
    float radius;              ///< [m] of its disc: how soft shadows are
    Lobe lobe;
};

/// All that shine near the eye, in the order of a town's lists and a tick's ids; none by day.
std::vector<LightSource> find_sources(const ShadingInput& input, const Eigen::Vector3f& eye);

}  // namespace reprise::render
