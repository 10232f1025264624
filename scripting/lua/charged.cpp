#include "scripting/lua/charged.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <dlfcn.h>

#include <locale.h>
#include <stdlib.h>

namespace reprise::scripting {

namespace {

std::atomic<void (*)(std::uint64_t)> payer{nullptr};

void charge_running(std::uint64_t instructions) {
    if (auto* const pay = payer.load(std::memory_order_relaxed))
        pay(instructions);
}

/// A positive number as mantissa * 2^exponent, the mantissa below 2^53.
struct Parts {
    std::uint64_t mantissa;
    int exponent;
};

Parts parts_of(double number) {
    int exponent = 0;
    const double fraction = std::frexp(number, &exponent);  // in [0.5, 1)
    return {static_cast<std::uint64_t>(std::ldexp(fraction, 53)), exponent - 53};
}

/// (value << bits) % divisor, for value < divisor < 2^53.
std::uint64_t shifted_remainder(std::uint64_t value, int bits, std::uint64_t divisor) {
    __extension__ using Wide = unsigned __int128;
    constexpr int at_once = 64;
    for (; bits > 0 && value != 0; bits -= at_once)
        value = static_cast<std::uint64_t>((Wide{value} << std::min(bits, at_once)) % divisor);
    return value;
}

}  // namespace

void charge_library_calls(void (*pay)(std::uint64_t instructions)) {
    payer.store(pay, std::memory_order_relaxed);
}

}  // namespace reprise::scripting

/// Lua's a < b of two texts asks the C library for the order of the user's language, once for every
/// zero byte in them. In programs that run scenarios this answers instead: by bytes, whatever the
/// environment says, and charged, because one instruction can call it thousands of times.
extern "C" int strcoll(const char* left, const char* right) noexcept {
    reprise::scripting::charge_running(1 + std::strlen(left) / 64);
    return std::strcmp(left, right);
}

/// Lua reads a text as a number where `for` needs one, hundreds of digits in one instruction. By
/// plain C's rules, as `check_locale` wants them.
extern "C" double strtod(const char* text, char** end) noexcept {
    static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
    constexpr std::size_t few_digits = 24;
    if (const std::size_t size = std::strlen(text); size > few_digits)
        reprise::scripting::charge_running(6 + size / 8);
    return strtod_l(text, end, plain);
}

/// Lua's a % b. The C library's take a step for each bit between the exponents, up to 2098; this
/// takes 64 bits in a step. The result is exact, so it is the same as any other's.
extern "C" double fmod(double x, double y) noexcept {
    if (std::isnan(x) || std::isnan(y) || std::isinf(x) || y == 0)
        return (x * y) / (x * y);
    const double size_x = std::fabs(x);
    const double size_y = std::fabs(y);
    if (size_x < size_y)
        return x;
    const auto [top, top_exponent] = reprise::scripting::parts_of(size_x);
    const auto [divisor, exponent] = reprise::scripting::parts_of(size_y);
    const int bits = top_exponent - exponent;
    reprise::scripting::charge_running(static_cast<std::uint64_t>(bits) / 64);
    const std::uint64_t rest = reprise::scripting::shifted_remainder(top % divisor, bits, divisor);
    return std::copysign(std::ldexp(static_cast<double>(rest), exponent), x);
}

/// Musl's, under the name that cmake/PortableMath.cmake gives it; null in a program without it.
extern "C" double portable_pow(double base, double exponent) noexcept __attribute__((weak));

/// Lua's x ^ y. Where a number is too small to be normal the processor takes a hundred times as
/// long as for an instruction of Lua's.
extern "C" double pow(double base, double exponent) noexcept {
    constexpr std::uint64_t subnormal_cost = 15;  // [instructions]
    using Function = double (*)(double, double) noexcept;
    static const Function power = portable_pow != nullptr
                                      ? portable_pow
                                      : reinterpret_cast<Function>(dlsym(RTLD_NEXT, "pow"));
    const double result = power(base, exponent);
    if (std::fpclassify(result) == FP_SUBNORMAL || std::fpclassify(base) == FP_SUBNORMAL)
        reprise::scripting::charge_running(subnormal_cost);
    return result;
}

/// Lua's `..` writes a float with it, which takes as long as 100 instructions. The name is the one
/// that a hardened build calls for snprintf.
// NOLINTNEXTLINE(bugprone-reserved-identifier, cert-dcl37-c, cert-dcl50-cpp, cert-dcl51-cpp)
extern "C" int __snprintf_chk(
    char* text, std::size_t most, int, std::size_t, const char* format, ...) noexcept {
    constexpr std::uint64_t float_cost = 20;  // [instructions]
    if (std::strcmp(format, "%.14g") == 0)
        reprise::scripting::charge_running(float_cost);
    std::va_list values;
    va_start(values, format);
    const int size = std::vsnprintf(text, most, format, values);
    va_end(values);
    return size;
}
