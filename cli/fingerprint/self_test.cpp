#include "cli/fingerprint/self_test.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <dlfcn.h>
#include <sstream>
#include <string>

#include "kernel/physics/bullet/bullet_check.h"
#include "traffic/sumo_check.h"
#include "walkers/steering.h"
#include "world/arithmetic.h"
#include "world/check.h"

namespace reprise::cli {

namespace {

struct Canary {
    const char* name;
    double (*function)(double);
    double argument;
    std::uint64_t expected;  ///< bits of musl's answer; glibc's with or without FMA differ
};

constexpr std::array<Canary, 5> canaries{{
    {"sin", std::sin, 0x1.cdaf0d2577eb8p+19, 0xbfc05ff77ee0900c},
    {"cos", std::cos, -0x1.a1b877ad35faap+5, 0xbfd7aacb96809491},
    {"exp", std::exp, 0x1.1a1997fbf3fd1p+6, 0x464ad5d4b3ecd03c},
    {"log", std::log, 0x1.dc0914a3a7c2cp-1, 0xbfb2a522764dbf2a},
    {"atan", std::atan, -0x1.053bd8b407c66p-1, 0xbfde31d6a877d2d5},
}};

[[noreturn]] void refuse(const std::string& what) {
    throw world::Error("self-test: " + what +
                       "; this run would not be repeatable elsewhere, so nothing is recorded. Is "
                       "something preloaded (LD_PRELOAD)?");
}

/// Through volatile, so that the compiler cannot work the answer out itself.
void check_values() {
    for (const Canary& canary : canaries) {
        auto* volatile function = canary.function;
        volatile double argument = canary.argument;
        if (std::bit_cast<std::uint64_t>(function(argument)) != canary.expected)
            refuse(std::string(canary.name) + " gives other bits than the one we were built with");
    }
}

/// Every maths function that a library asks for must be found in this program first.
void check_ownership() {
    Dl_info here{};
    dladdr(reinterpret_cast<void*>(&self_test), &here);
    std::istringstream names(REPRISE_PORTABLE_FUNCTIONS);
    for (std::string name; names >> name;) {
        Dl_info there{};
        void* symbol = dlsym(RTLD_DEFAULT, name.c_str());
        if (symbol == nullptr || dladdr(symbol, &there) == 0)
            refuse(name + " is nowhere to be found");
        if (here.dli_fbase != there.dli_fbase)
            refuse(name + " is taken from " + there.dli_fname + ", not from this program");
    }
}

}  // namespace

void self_test() {
    for (const std::string& unusual : {world::unusual_arithmetic(), world::unusual_locale()})
        if (!unusual.empty())
            refuse(unusual);
    check_values();
    check_ownership();
    if (!kernel::bullet_uses_our_maths())
        refuse("Bullet computes with another libm than this program");
    if (!traffic::sumo_uses_our_maths())
        refuse("SUMO computes with another libm than this program");
    if (!walkers::detour_uses_our_maths())
        refuse("Detour computes with another libm than this program");
}

}  // namespace reprise::cli
