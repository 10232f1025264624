#pragma once

#include <Eigen/Core>
#include <emmintrin.h>

#include "render/shade/light_source.h"

namespace reprise::render {

/// Four vectors, lane by lane.
struct Lanes3 {
    Lanes3() = default;

    Lanes3(__m128 x_lanes, __m128 y_lanes, __m128 z_lanes) : x(x_lanes), y(y_lanes), z(z_lanes) {}

    /// The same one four times.
    explicit Lanes3(const Eigen::Vector3f& v)
        : Lanes3(_mm_set1_ps(v.x()), _mm_set1_ps(v.y()), _mm_set1_ps(v.z())) {}

    __m128 dot(const Lanes3& other) const { return x * other.x + (y * other.y + z * other.z); }

    Lanes3 operator-() const { return {-x, -y, -z}; }

    friend Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }

    friend Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }

    friend Lanes3 operator*(const Lanes3& a, __m128 b) { return {a.x * b, a.y * b, a.z * b}; }

    __m128 x, y, z;
};

/// What says how much a source gives where: rows of four numbers, that four sources are turned into
/// lanes.
struct SourceRow {
    SourceRow() = default;
    explicit SourceRow(const LightSource& source);

    alignas(16) Eigen::Vector3f position;
    float narrows;  ///< 1 / reach^2
    Eigen::Vector3f axis;
    float lobe;
    Eigen::Vector3f left;
    float luminance;  ///< of the intensity
    Eigen::Vector3f up;
    float radius;
    Eigen::Vector3f intensity;
    float unused = 0;
};

/// Four sources, lane by lane.
struct FourSources {
    FourSources() = default;

    FourSources(const SourceRow& a, const SourceRow& b, const SourceRow& c, const SourceRow& d) {
        static_assert(sizeof(SourceRow) == 20 * sizeof(float));
        const auto turn = [&](int row, Lanes3& vectors, __m128& numbers) {
            const auto of = [&](const SourceRow& source) {
                return _mm_load_ps(source.position.data() + std::ptrdiff_t{4} * row);
            };
            vectors = {of(a), of(b), of(c)};
            numbers = of(d);
            _MM_TRANSPOSE4_PS(vectors.x, vectors.y, vectors.z, numbers);
        };
        __m128 nothing;
        turn(0, position, narrows);
        turn(1, axis, lobe);
        turn(2, left, luminance);
        turn(3, up, radius);
        turn(4, intensity, nothing);
        for (const SourceRow* source : {&a, &b, &c, &d})
            lobes |= 1U << static_cast<unsigned>(source->lobe);
    }

    /// Is one of them such a lamp?
    bool any(LightSource::Lobe kind) const {
        return (lobes >> static_cast<unsigned>(kind) & 1) != 0;
    }

    Lanes3 position, axis, left, up, intensity;
    __m128 narrows, lobe, luminance, radius;
    unsigned lobes = 0;  ///< bit by bit, which there are among them
};

/// lobe_share() of each along its own way.
__m128 lobe_shares(const FourSources& sources, const Lanes3& way);

}  // namespace reprise::render
