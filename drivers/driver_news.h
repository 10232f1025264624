#pragma once

#include <cstdint>
#include <string>

#include "world/tick_generated.h"

namespace reprise::drivers {

/// What a driver does of its own will, as its event tells it.
struct DriverNews {
    world::EventKind kind;    ///< backed_off, overtakes
    std::uint32_t other = 0;  ///< overtakes: whom
    std::string text;         ///< why, how
};

}  // namespace reprise::drivers
