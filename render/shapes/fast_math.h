#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "render/shapes/color.h"

namespace reprise::render {

inline constexpr float pi = 3.14159265F;

// The shading loop calls none of libm's transcendental functions: they are slow, and glibc chooses
// their variant by the processor, so that pictures would differ in the last bit between machines.

inline float clamp01(float x) {
    return std::min(std::max(x, 0.0F), 1.0F);
}

inline float mix(float from, float to, float share) {
    return from + (to - from) * share;
}

/// 0 below `low`, 1 above `high`, smooth between.
inline float smooth_step(float low, float high, float x) {
    const float share = clamp01((x - low) / (high - low));
    return share * share * (3 - 2 * share);
}

/// Of four, within rounding.
inline __m128 smooth_step(float low, float high, __m128 x) {
    const __m128 share = (x - _mm_set1_ps(low)) * _mm_set1_ps(1 / (high - low));
    const __m128 clamped = _mm_min_ps(_mm_max_ps(share, _mm_setzero_ps()), _mm_set1_ps(1));
    return clamped * clamped * (_mm_set1_ps(3) - _mm_set1_ps(2) * clamped);
}

/// As std::floor for |x| < 2^31, without a call.
inline int floor_int(float x) {
    const int truncated = static_cast<int>(x);
    return truncated - static_cast<int>(static_cast<float>(truncated) > x);
}

/// Of four.
inline __m128i floor_int(__m128 x) {
    const __m128i truncated = _mm_cvttps_epi32(x);
    // Of what was rounded up, all bits are set, which is -1.
    const __m128 above = _mm_cmpgt_ps(_mm_cvtepi32_ps(truncated), x);
    return _mm_add_epi32(truncated, _mm_castps_si128(above));
}

/// x modulo 1, in [0, 1).
inline float fraction(float x) {
    return x - static_cast<float>(floor_int(x));
}

/// e^x for x in [-80, 80], relative error below 2e-6.
inline float fast_exp(float x) {
    const float scaled = std::min(std::max(x, -80.0F), 80.0F) * 1.44269504F;
    const int whole = floor_int(scaled);
    const float f = (scaled - static_cast<float>(whole)) * 0.69314718F;
    const float power =
        1 + f * (1 + f * (0.5F + f * (0.16666667F +
                                      f * (0.041666667F + f * (0.0083333333F + f * 0.0014F)))));
    return power * std::bit_cast<float>(static_cast<std::uint32_t>(whole + 127) << 23);
}

/// The same numbers, three at once.
inline Color fast_exp(const Color& x) {
    const Color scaled = x.max(-80.0F).min(80.0F) * 1.44269504F;
    const __m128i whole = floor_int(scaled.lanes());
    const Color f = (scaled - Color(_mm_cvtepi32_ps(whole))) * 0.69314718F;
    const Color power =
        1 + f * (1 + f * (0.5F + f * (0.16666667F +
                                      f * (0.041666667F + f * (0.0083333333F + f * 0.0014F)))));
    const __m128i exponent = _mm_slli_epi32(_mm_add_epi32(whole, _mm_set1_epi32(127)), 23);
    return power * Color(_mm_castsi128_ps(exponent));
}

/// Schlick's approximation of how much a smooth surface mirrors, f0 looking straight at it.
inline float fresnel(float f0, float cosine) {
    const float grazing = 1 - clamp01(cosine);
    const float squared = grazing * grazing;
    return f0 + (1 - f0) * squared * squared * grazing;
}

}  // namespace reprise::render
