#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

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
    alignas(16) std::array<float, 4> corners{};
    std::uint64_t place = 0;  ///< see lattice_place
    std::uint32_t salt = ~0U;
};

inline std::uint64_t lattice_place(int column, int row) {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32U |
           static_cast<std::uint32_t>(column);
}

[[gnu::noinline]] inline void hash_corners(NoiseSquare& square,
                                           std::uint64_t place,
                                           std::uint32_t salt) {
    const auto column = static_cast<int>(place & 0xffffffffU);
    const auto row = static_cast<int>(place >> 32U);
    square = {{cell_noise(column, row, salt),
               cell_noise(column + 1, row, salt),
               cell_noise(column, row + 1, salt),
               cell_noise(column + 1, row + 1, salt)},
              place,
              salt};
}

/// Neighbouring places mostly ask for the same square of each texture: one is remembered for each,
/// only so that hashing is saved.
inline __m128 noise_corners(std::uint64_t place, std::uint32_t salt) {
    constexpr std::uint32_t places = 256;
    thread_local constinit std::array<NoiseSquare, places> squares{};
    NoiseSquare& square = squares[salt % places];
    if (square.place != place || square.salt != salt)
        hash_corners(square, place, salt);
    return _mm_load_ps(square.corners.data());
}

/// Smooth noise in [0, 1] with features of size 1, at `count` places; the others may be anywhere.
/// Each has a texture of its own: salt, salt + 1, ...
template <int count>
std::array<float, 4> value_noises(__m128 x, __m128 y, std::uint32_t salt) {
    const __m128i column = floor_int(x);
    const __m128i row = floor_int(y);
    alignas(16) std::array<std::uint64_t, 4> squares;
    _mm_store_si128(reinterpret_cast<__m128i*>(&squares[0]), _mm_unpacklo_epi32(column, row));
    _mm_store_si128(reinterpret_cast<__m128i*>(&squares[2]), _mm_unpackhi_epi32(column, row));
    const auto corners = [&](int i) {
        return i < count ? noise_corners(squares[static_cast<std::size_t>(i)],
                                         salt + static_cast<std::uint32_t>(i))
                         : _mm_setzero_ps();
    };
    __m128 low_left = corners(0), low_right = corners(1), left = corners(2), right = corners(3);
    _MM_TRANSPOSE4_PS(low_left, low_right, left, right);
    const auto smoothed = [](__m128 share) {
        return share * share * (_mm_set1_ps(3) - _mm_set1_ps(2) * share);
    };
    const __m128 fx = smoothed(x - _mm_cvtepi32_ps(column));
    const __m128 fy = smoothed(y - _mm_cvtepi32_ps(row));
    const __m128 low = low_left + (low_right - low_left) * fx;
    const __m128 high = left + (right - left) * fx;
    alignas(16) std::array<float, 4> noises;
    _mm_store_ps(noises.data(), low + (high - low) * fy);
    return noises;
}

/// At one.
inline float value_noise(float x, float y, std::uint32_t salt = 0) {
    const int column = floor_int(x);
    const int row = floor_int(y);
    float fx = x - static_cast<float>(column);
    float fy = y - static_cast<float>(row);
    fx = fx * fx * (3 - 2 * fx);
    fy = fy * fy * (3 - 2 * fy);
    alignas(16) std::array<float, 4> corners;
    _mm_store_ps(corners.data(), noise_corners(lattice_place(column, row), salt));
    return mix(mix(corners[0], corners[1], fx), mix(corners[2], corners[3], fx), fy);
}

/// Where the next octave looks: turned by about 37 degrees, so that the lattices of the octaves do
/// not line up.
inline Eigen::Vector2f next_octave(float x, float y) {
    return {1.6F * x - 1.2F * y + 7.1F, 1.2F * x + 1.6F * y + 3.7F};
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
        const Eigen::Vector2f next = next_octave(x, y);
        x = next.x();
        y = next.y();
        weight *= 0.5F;
    }
    return sum + weight;
}

template <int octaves>
float octaves_at_once(float x, float y, std::uint32_t salt) {
    const Eigen::Vector2f second = next_octave(x, y);
    const Eigen::Vector2f third = next_octave(second.x(), second.y());
    const Eigen::Vector2f fourth = next_octave(third.x(), third.y());
    const std::array<float, 4> noises =
        value_noises<octaves>(_mm_setr_ps(x, second.x(), third.x(), fourth.x()),
                              _mm_setr_ps(y, second.y(), third.y(), fourth.y()),
                              salt);
    float sum = 0;
    float weight = 0.5F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += weight * noises[static_cast<std::size_t>(octave)];
        weight *= 0.5F;
    }
    return sum + weight;
}

/// fractal_noise_over without a level, of at most four octaves all at once: the same number.
[[gnu::always_inline]] inline float fractal_noise(float x,
                                                  float y,
                                                  int octaves,
                                                  std::uint32_t salt = 0) {
    switch (octaves) {
        case 1:
            return octaves_at_once<1>(x, y, salt);
        case 2:
            return octaves_at_once<2>(x, y, salt);
        case 3:
            return octaves_at_once<3>(x, y, salt);
        default:
            return octaves_at_once<4>(x, y, salt);
    }
}

/// fractal_noise of two octaves at a place times `coarse` with `salt`, and at it times `fine` with
/// the second salt after that.
inline std::array<float, 2> two_fractal_noises(
    float x, float y, float coarse, float fine, std::uint32_t salt) {
    const Eigen::Vector2f second = next_octave(x * coarse, y * coarse);
    const Eigen::Vector2f fourth = next_octave(x * fine, y * fine);
    const std::array<float, 4> noises =
        value_noises<4>(_mm_setr_ps(x * coarse, second.x(), x * fine, fourth.x()),
                        _mm_setr_ps(y * coarse, second.y(), y * fine, fourth.y()),
                        salt);
    return {0.5F * noises[0] + 0.25F * noises[1] + 0.125F,
            0.5F * noises[2] + 0.25F * noises[3] + 0.125F};
}

}  // namespace reprise::render
