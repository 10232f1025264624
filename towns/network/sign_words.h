#pragma once

#include <array>
#include <utility>

#include "world/town_generated.h"

namespace reprise::towns {

/// The signs of a place file: its word for each.
inline constexpr std::array<std::pair<const char*, world::PropKind>, 3> sign_words{
    {{"speed_limit", world::PropKind::speed_limit_sign},
     {"stop", world::PropKind::stop_sign},
     {"yield", world::PropKind::yield_sign}}};

}  // namespace reprise::towns
