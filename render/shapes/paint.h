#pragma once

#include "render/shapes/fast_math.h"
#include "world/models/catalogue.h"

namespace reprise::render {

/// What a vehicle is painted with, from the bits of its look (world::Look).
struct Paint {
    Color body;
    Color cargo;  ///< a lorry's box: what it advertises
};

/// Colours come as often as they are sold for the kind of vehicle; services have their own.
Paint paint_of(const world::VehicleModel& model, std::uint32_t look);

}  // namespace reprise::render
