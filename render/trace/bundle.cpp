#include "render/trace/bundle.h"

#include <cmath>

#include <emmintrin.h>

namespace reprise::render {

namespace {

struct Pairs {
    __m128d x, y, z;  ///< of two lanes
};

Pairs load(const std::array<std::array<double, Bundle::lanes>, 3>& from, std::size_t lane) {
    return {_mm_load_pd(&from[0][lane]), _mm_load_pd(&from[1][lane]), _mm_load_pd(&from[2][lane])};
}

Pairs spread(const std::array<float, 3>& from) {
    return {_mm_set1_pd(static_cast<double>(from[0])),
            _mm_set1_pd(static_cast<double>(from[1])),
            _mm_set1_pd(static_cast<double>(from[2]))};
}

Pairs operator-(const Pairs& left, const Pairs& right) {
    return {left.x - right.x, left.y - right.y, left.z - right.z};
}

__m128d dot(const Pairs& left, const Pairs& right) {
    return left.x * right.x + left.y * right.y + left.z * right.z;
}

Pairs cross(const Pairs& left, const Pairs& right) {
    return {left.y * right.z - left.z * right.y,
            left.z * right.x - left.x * right.z,
            left.x * right.y - left.y * right.x};
}

}  // namespace

unsigned Bundle::lanes_matching(std::uint32_t mask) const {
    unsigned set = 0;
    for (std::size_t lane = 0; lane < Bundle::lanes; ++lane)
        set |= static_cast<unsigned>((masks[lane] & mask) != 0) << lane;
    return set;
}

void Bundle::prepare() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t lane = 0; lane < Bundle::lanes; ++lane) {
            const auto along = static_cast<float>(direction[axis][lane]);
            constexpr float least = 1e-18F;  // so that the inverse is finite
            packet.origin[axis][lane] = static_cast<float>(origin[axis][lane]);
            packet.inverse[axis][lane] =
                1 / (std::abs(along) < least ? std::copysign(least, along) : along);
        }
    }
}

// Moeller and Trumbore, 1997, two rays at once.
unsigned intersect_triangle(const MeshTree::Triangle& triangle,
                            const Bundle& bundle,
                            unsigned wanted,
                            TriangleHits& hits) {
    const Pairs a = spread(triangle.corners[0]);
    const Pairs to_b = spread(triangle.corners[1]) - a;
    const Pairs to_c = spread(triangle.corners[2]) - a;
    const __m128d zero = _mm_setzero_pd();
    const __m128d sign_bit = _mm_set1_pd(-0.0);
    unsigned found = 0;
    for (std::size_t lane = 0; lane < Bundle::lanes; lane += 2) {
        if ((wanted >> lane & 3U) == 0)
            continue;
        const Pairs direction = load(bundle.direction, lane);
        const Pairs from_a = load(bundle.origin, lane) - a;
        const Pairs p = cross(direction, to_c);
        const Pairs q = cross(from_a, to_b);
        const __m128d signed_volume = dot(to_b, p);
        // Seen from behind everything changes its sign.
        const __m128d sign = _mm_and_pd(signed_volume, sign_bit);
        const __m128d volume = _mm_xor_pd(signed_volume, sign);
        const __m128d u = _mm_xor_pd(dot(from_a, p), sign);
        const __m128d v = _mm_xor_pd(dot(direction, q), sign);
        const __m128d distance = _mm_xor_pd(dot(to_c, q), sign);
        const __m128d inside =
            _mm_and_pd(_mm_and_pd(_mm_cmpge_pd(u, zero), _mm_cmpge_pd(v, zero)),
                       _mm_and_pd(_mm_cmple_pd(u + v, volume), _mm_cmpgt_pd(volume, zero)));
        const __m128d met = _mm_and_pd(inside, _mm_cmpgt_pd(distance, zero));
        const auto pair = static_cast<unsigned>(_mm_movemask_pd(met));
        if (pair == 0)
            continue;
        found |= pair << lane;
        _mm_store_pd(&hits.distance[lane], distance / volume);
        _mm_store_pd(&hits.u[lane], u / volume);
        _mm_store_pd(&hits.v[lane], v / volume);
    }
    return found & wanted;
}

}  // namespace reprise::render
