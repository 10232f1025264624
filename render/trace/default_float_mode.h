#pragma once

#include <xmmintrin.h>

namespace reprise::render {

/// Sets the floating-point mode of a task and restores the old one: TBB's threads keep whatever
/// mode they were started with, and Embree's flushes denormals.
template <unsigned mode>
class FloatMode {
  public:
    FloatMode() : saved_(_mm_getcsr()) { _mm_setcsr(mode); }

    ~FloatMode() { _mm_setcsr(saved_); }

    FloatMode(const FloatMode&) = delete;
    FloatMode& operator=(const FloatMode&) = delete;

  private:
    unsigned saved_;
};

/// No exceptions, round to nearest, denormals kept.
using DefaultFloatMode = FloatMode<0x1f80>;

/// Results that would be denormal are zero, on every CPU: for sums in which parts of nothing go in,
/// which cost a hundred times as much.
using FlushingFloatMode = FloatMode<0x9f80>;

}  // namespace reprise::render
