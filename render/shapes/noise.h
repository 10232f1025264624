#pragma once

#include <array>
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

/// The noise at the corners of a lattice square: (0, 0), (1, 0), (0, 1), (1, 1) from its lower
/// left.
struct NoiseSquare {
    int column = 0;
    int row = 0;
    std::uint32_t salt = ~0U;
    std::array<float, 4> corners{};
};

[[gnu::noinline]] inline void hash_corners(NoiseSquare& square,
                                           int column,
                                           int row,
                                           std::uint32_t salt) {
    square = {column,
              row,
              salt,
              {cell_noise(column, row, salt),
               cell_noise(column + 1, row, salt),
               cell_noise(column, row + 1, salt),
               cell_noise(column + 1, row + 1, salt)}};
}

/// Neighbouring places mostly ask for the same square of each texture: one is remembered for each,
/// only so that hashing is saved.
inline const std::array<float, 4>& noise_corners(int column, int row, std::uint32_t salt) {
    constexpr std::uint32_t places = 256;
    thread_local constinit std::array<NoiseSquare, places> squares{};
    NoiseSquare& square = squares[salt % places];
    if (square.column != column || square.row != row || square.salt != salt)
        hash_corners(square, column, row, salt);
    return square.corners;
}

/// Smooth noise in [0, 1] with features of size 1.
inline float value_noise(float x, float y, std::uint32_t salt = 0) {
    const int column = floor_int(x);
    const int row = floor_int(y);
    float fx = x - static_cast<float>(column);
    float fy = y - static_cast<float>(row);
    fx = fx * fx * (3 - 2 * fx);
    fy = fy * fy * (3 - 2 * fy);
    const std::array<float, 4>& corners = noise_corners(column, row, salt);
    return mix(mix(corners[0], corners[1], fx), mix(corners[2], corners[3], fx), fy);
}

/// Octaves of value noise, each half as large and half as strong. In [0, 1], mean 0.5. Where it is
/// below `level` it may be any number below that: coarse octaves say so before the fine ones are
/// worked out.
inline float fractal_noise_over(
    float level, float x, float y, int octaves, std::uint32_t salt = 0) {
    float sum = 0;
    float weight = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        // What is left adds up to twice the next weight.
        if (sum + 2.001F * weight < level)
            return sum;
        sum += weight * value_noise(x, y, salt + static_cast<std::uint32_t>(octave));
        // Turned by about 37 degrees, so that the lattices of the octaves do not line up.
        const float turned = 1.6F * x - 1.2F * y + 7.1F;
        y = 1.2F * x + 1.6F * y + 3.7F;
        x = turned;
        weight *= 0.5F;
    }
    return sum + weight;
}

inline float fractal_noise(float x, float y, int octaves, std::uint32_t salt = 0) {
    return fractal_noise_over(-1, x, y, octaves, salt);
}

}  // namespace reprise::render
