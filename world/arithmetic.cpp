#include "world/arithmetic.h"

#include <clocale>
#include <cstdint>
#include <locale>

#include <xmmintrin.h>

namespace reprise::world {

namespace {

// MXCSR without the flags that computing itself sets (its lowest six bits).
constexpr unsigned control_bits = 0xffc0U;
constexpr unsigned plain = 0x1f80U;  // exceptions masked, to nearest, denormals kept
constexpr unsigned flush_to_zero = 0x8000U;
constexpr unsigned denormals_are_zero = 0x0040U;
constexpr unsigned rounding = 0x6000U;

// x87, which long double uses: exceptions masked, 64-bit mantissa, to nearest.
constexpr std::uint16_t plain_x87 = 0x037fU;

std::uint16_t x87_control() {
    std::uint16_t word = 0;
    asm("fnstcw %0" : "=m"(word));
    return word;
}

}  // namespace

bool is_plain_arithmetic() {
    return (_mm_getcsr() & control_bits) == plain &&
           (x87_control() & 0x0f3fU) == (plain_x87 & 0x0f3fU);
}

std::string unusual_arithmetic() {
    const unsigned mode = _mm_getcsr() & control_bits;
    if ((mode & flush_to_zero) != 0)
        return "denormal results are flushed to zero (FTZ)";
    if ((mode & denormals_are_zero) != 0)
        return "denormal numbers are taken for zero (DAZ)";
    if ((mode & rounding) != 0)
        return "numbers are not rounded to nearest";
    if (!is_plain_arithmetic())
        return "floating-point exceptions or the x87 unit are not in their usual mode";
    return "";
}

std::string unusual_locale() {
    if (std::string(std::localeconv()->decimal_point) != ".")
        return std::string("the locale writes numbers with '") + std::localeconv()->decimal_point +
               "' instead of a point";
    if (const std::string name = std::locale().name(); name != "C")
        return "the C++ locale is " + name + ", not C";
    return "";
}

}  // namespace reprise::world
