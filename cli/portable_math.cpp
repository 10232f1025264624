#include "cli/portable_math.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <dlfcn.h>
#include <string>

#include "world/check.h"

namespace reprise::cli {

namespace {

using Function = double (*)(double);

struct Canary {
    const char* name;
    Function function;
    double argument;
    std::uint64_t expected;  ///< bits of musl's answer; glibc's with or without FMA differ
};

/// Through volatile, so that the compiler cannot work the answer out itself.
std::uint64_t bits_of(const Canary& canary) {
    volatile Function function = canary.function;
    volatile double argument = canary.argument;
    return std::bit_cast<std::uint64_t>(function(argument));
}

bool is_ours(const char* name) {
    Dl_info here{};
    Dl_info there{};
    void* symbol = dlsym(RTLD_DEFAULT, name);
    return symbol != nullptr && dladdr(symbol, &there) != 0 &&
           dladdr(reinterpret_cast<void*>(&check_portable_math), &here) != 0 &&
           here.dli_fbase == there.dli_fbase;
}

}  // namespace

void check_portable_math() {
    const std::array<Canary, 5> canaries{{
        {"sin", std::sin, 0x1.cdaf0d2577eb8p+19, 0xbfc05ff77ee0900c},
        {"cos", std::cos, -0x1.a1b877ad35faap+5, 0xbfd7aacb96809491},
        {"exp", std::exp, 0x1.1a1997fbf3fd1p+6, 0x464ad5d4b3ecd03c},
        {"log", std::log, 0x1.dc0914a3a7c2cp-1, 0xbfb2a522764dbf2a},
        {"atan", std::atan, -0x1.053bd8b407c66p-1, 0xbfde31d6a877d2d5},
    }};
    for (const Canary& canary : canaries)
        REPRISE_CHECK(
            bits_of(canary) == canary.expected,
            std::string(canary.name) + " gives other bits than the one we were built with");
    for (const char* name : {"sin",
                             "cos",
                             "tan",
                             "asin",
                             "acos",
                             "atan",
                             "atan2",
                             "exp",
                             "log",
                             "pow",
                             "sincos",
                             "fmod",
                             "cbrt",
                             "tanh",
                             "log10",
                             "expf",
                             "sinf",
                             "cosf"})
        REPRISE_CHECK(is_ours(name),
                      std::string(name) + " is bound to another library; is something preloaded?");
}

}  // namespace reprise::cli
