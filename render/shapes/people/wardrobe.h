#pragma once

#include <cstdint>

#include "render/shapes/fast_math.h"
#include "render/shapes/material.h"
#include "world/models/carried.h"
#include "world/models/catalogue.h"

namespace reprise::render {

/// Colours of a walker's clothes, skin and hair, and what he carries: all from the bits of his
/// look.
struct Outfit {
    Color skin;
    Color hair;
    Color headgear;  ///< of a suit: the shirt below it
    Color shirt;
    Color trousers;
    Color shoe;
    Color trim;
    Color bag;
    Color umbrella;
    bool short_sleeves = false;
    bool stockings = false;
    world::Carried carried;

    const Color& color_of(Material material) const;
};

/// `look` of world::WalkerState or of a rider's vehicle.
Outfit outfit_of(const world::WalkerModel& model, std::uint32_t look);

}  // namespace reprise::render
