#pragma once

#include <algorithm>
#include <cmath>

#include <emmintrin.h>

namespace reprise::render {

/// Linear light or an albedo: red, green, blue. Four lanes of SSE2, which every x86-64 CPU has and
/// rounds alike, so that the three are worked out at once; nobody reads the fourth.
class Color {
  public:
    Color() = default;

    Color(float red, float green, float blue) : lanes_(_mm_setr_ps(red, green, blue, 0)) {}

    explicit Color(__m128 lanes) : lanes_(lanes) {}

    // NOLINTBEGIN(readability-identifier-naming): as Eigen's vectors have them
    static Color Constant(float value) { return Color(_mm_set1_ps(value)); }

    static Color Zero() { return Color(_mm_setzero_ps()); }

    static Color Ones() { return Constant(1); }

    // NOLINTEND(readability-identifier-naming)

    float x() const { return _mm_cvtss_f32(lanes_); }

    float y() const { return _mm_cvtss_f32(_mm_shuffle_ps(lanes_, lanes_, 1)); }

    float z() const { return _mm_cvtss_f32(_mm_shuffle_ps(lanes_, lanes_, 2)); }

    float operator[](int channel) const { return channel == 0 ? x() : channel == 1 ? y() : z(); }

    __m128 lanes() const { return lanes_; }

    // A number that is not one stays.
    Color max(const Color& other) const { return Color(_mm_max_ps(other.lanes_, lanes_)); }

    Color max(float least) const { return max(Constant(least)); }

    Color min(const Color& other) const { return Color(_mm_min_ps(other.lanes_, lanes_)); }

    Color min(float most) const { return min(Constant(most)); }

    // NOLINTBEGIN(readability-identifier-naming): as Eigen's vectors have them
    float maxCoeff() const { return std::max(x(), std::max(y(), z())); }

    float minCoeff() const { return std::min(x(), std::min(y(), z())); }

    // NOLINTEND(readability-identifier-naming)

    float mean() const { return (x() + (y() + z())) / 3; }

    bool is_finite() const {
        return std::isfinite(x()) && std::isfinite(y()) && std::isfinite(z());
    }

    Color operator-() const { return Color(_mm_xor_ps(lanes_, _mm_set1_ps(-0.0F))); }

    Color& operator+=(const Color& other) { return *this = Color(lanes_ + other.lanes_); }

    Color& operator*=(const Color& other) { return *this = Color(lanes_ * other.lanes_); }

    Color& operator*=(float factor) { return *this *= Constant(factor); }

    Color& operator/=(float divisor) { return *this = Color(lanes_ / _mm_set1_ps(divisor)); }

    friend bool operator==(const Color& a, const Color& b) {
        return a.x() == b.x() && a.y() == b.y() && a.z() == b.z();
    }

    friend Color operator+(const Color& a, const Color& b) { return Color(a.lanes_ + b.lanes_); }

    friend Color operator-(const Color& a, const Color& b) { return Color(a.lanes_ - b.lanes_); }

    friend Color operator*(const Color& a, const Color& b) { return Color(a.lanes_ * b.lanes_); }

    friend Color operator/(const Color& a, const Color& b) { return Color(a.lanes_ / b.lanes_); }

    friend Color operator+(const Color& a, float b) { return a + Constant(b); }

    friend Color operator+(float a, const Color& b) { return Constant(a) + b; }

    friend Color operator-(const Color& a, float b) { return a - Constant(b); }

    friend Color operator-(float a, const Color& b) { return Constant(a) - b; }

    friend Color operator*(const Color& a, float b) { return a * Constant(b); }

    friend Color operator*(float a, const Color& b) { return Constant(a) * b; }

    friend Color operator/(const Color& a, float b) { return a / Constant(b); }

  private:
    __m128 lanes_;
};

inline Color mix(const Color& from, const Color& to, float share) {
    return from + (to - from) * share;
}

inline float luminance(const Color& color) {
    return 0.2126F * color.x() + 0.7152F * color.y() + 0.0722F * color.z();
}

}  // namespace reprise::render
