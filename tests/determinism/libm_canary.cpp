// Which of glibc's variants of sin, exp and their kin does this process get? Not linked with our
// own maths: it proves that a mask or an emulated CPU really has the effect that a row of the
// matrix is about. Prints fma, sse2 or neither.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>

namespace {

/// Arguments for which the two differ in the last bit; answers of glibc 2.36.
struct Canary {
    double (*function)(double);
    double argument;
    std::uint64_t fma;
    std::uint64_t sse2;
};

constexpr std::array<Canary, 5> canaries{{
    {std::sin, 0x1.cdaf0d2577eb8p+19, 0xbfc05ff77ee0900b, 0xbfc05ff77ee0900c},
    {std::cos, -0x1.a1b877ad35faap+5, 0xbfd7aacb96809491, 0xbfd7aacb96809492},
    {std::exp, 0x1.1a1997fbf3fd1p+6, 0x464ad5d4b3ecd03d, 0x464ad5d4b3ecd03c},
    {std::log, 0x1.dc0914a3a7c2cp-1, 0xbfb2a522764dbf2b, 0xbfb2a522764dbf2a},
    {std::atan, -0x1.053bd8b407c66p-1, 0xbfde31d6a877d2d5, 0xbfde31d6a877d2d6},
}};

}  // namespace

int main() {
    bool fma = true;
    bool sse2 = true;
    for (const Canary& canary : canaries) {
        // Through volatile, so that the compiler cannot work the answer out itself.
        double (*volatile function)(double) = canary.function;
        const volatile double argument = canary.argument;
        const auto bits = std::bit_cast<std::uint64_t>(function(argument));
        fma = fma && bits == canary.fma;
        sse2 = sse2 && bits == canary.sse2;
    }
    std::puts(fma ? "fma" : sse2 ? "sse2" : "neither");
    return 0;
}
