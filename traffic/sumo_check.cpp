#include "traffic/sumo_check.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <dlfcn.h>

#include "world/check.h"

namespace reprise::traffic {

namespace {

/// As SUMO 1.15's class of this name lies in memory; its header is not installed.
struct Position {
    double x;
    double y;
    double z;
};

using Angle = double (*)(const Position&, const Position&);

}  // namespace

bool sumo_uses_our_maths() {
    // GeomHelper::angle2D(a, b): atan2 of b less atan2 of a. Nothing in libsumo's own interface
    // calls libm without a loaded network.
    void* symbol = dlsym(RTLD_DEFAULT, "_ZN10GeomHelper7angle2DERK8PositionS2_");
    REPRISE_CHECK(symbol != nullptr, "libsumo has no GeomHelper::angle2D");
    const auto angle = reinterpret_cast<Angle>(symbol);
    const Position east{1, 0, 0};  // at angle 0
    // One arc tangent in some twenty differs between musl and glibc.
    for (int i = 1; i <= 256; ++i) {
        const Position place{3.7 - 0.013 * i, 0.29 * i, 0};
        const double theirs = -angle(place, east);
        const double ours = std::atan2(place.y, place.x);
        if (std::bit_cast<std::uint64_t>(theirs) != std::bit_cast<std::uint64_t>(ours))
            return false;
    }
    return true;
}

}  // namespace reprise::traffic
