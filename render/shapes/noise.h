#pragma once

#include <cstdint>

#include "render/shapes/fast_math.h"
#include "world/hash.h"

namespace reprise::render {

using world::hash;
using world::unit;

// Textures anchored in the world are functions of place alone.

/// The hash of a lattice cell, in [0, 1).
inline float cell_noise(int x, int y, std::uint32_t salt = 0) {
    return unit(hash((static_cast<std::uint32_t>(x) * 0x8da6b343u) ^
                     (static_cast<std::uint32_t>(y) * 0xd8163841u) ^ (salt * 0xcb1ab31fu)));
}

/// Smooth noise in [0, 1] with features of size 1.
inline float value_noise(float x, float y, std::uint32_t salt = 0) {
    const int column = floor_int(x);
    const int row = floor_int(y);
    float fx = x - static_cast<float>(column);
    float fy = y - static_cast<float>(row);
    fx = fx * fx * (3 - 2 * fx);
    fy = fy * fy * (3 - 2 * fy);
    const float near = mix(cell_noise(column, row, salt), cell_noise(column + 1, row, salt), fx);
    const float far =
        mix(cell_noise(column, row + 1, salt), cell_noise(column + 1, row + 1, salt), fx);
    return mix(near, far, fy);
}

/// Octaves of value noise, each half as large and half as strong. In [0, 1], mean 0.5.
inline float fractal_noise(float x, float y, int octaves, std::uint32_t salt = 0) {
    float sum = 0;
    float weight = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * value_noise(x, y, salt + static_cast<std::uint32_t>(octave));
        // Turned by about 37 degrees, so that the lattices of the octaves do not line up.
        const float turned = 1.6F * x - 1.2F * y + 7.1F;
        y = 1.2F * x + 1.6F * y + 3.7F;
        x = turned;
        weight *= 0.5F;
    }
    return sum + weight;
}

}  // namespace reprise::render
