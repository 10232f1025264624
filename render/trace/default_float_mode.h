#pragma once

#include <xmmintrin.h>

namespace reprise::render {

/// Sets the floating-point mode of a task and restores the old one: TBB's threads keep whatever
/// mode they were started with, and Embree's flushes denormals.
class DefaultFloatMode {
  public:
    DefaultFloatMode() : saved_(_mm_getcsr()) { _mm_setcsr(plain); }

    ~DefaultFloatMode() { _mm_setcsr(saved_); }

    DefaultFloatMode(const DefaultFloatMode&) = delete;
    DefaultFloatMode& operator=(const DefaultFloatMode&) = delete;

  private:
    static constexpr unsigned plain = 0x1f80;  // no exceptions, round to nearest, denormals kept
    unsigned saved_;
};

}  // namespace reprise::render
