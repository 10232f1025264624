#pragma once

#include "render/look/car_spot.h"
#include "render/shapes/cars/car_shape.h"

namespace reprise::render {

/// Pieces that are modelled rather than painted on a body. Tag of Material::car_part.
enum class CarPart : std::uint32_t {
    chrome,
    rubber,
    leather,
    painted,  ///< with the vehicle's paint
    front_lamp,
    rear_lamp,
    left_indicator,
    right_indicator,
    blue_lamp,
    roof_sign,
    window
};

inline Finish part_finish(CarPart part) {
    return {Material::car_part, static_cast<std::uint32_t>(part)};
}

/// On the roof: a taxi's sign, a light bar.
void add_service_parts(Mesh& mesh, const CarShape& shape);

Look car_part_look(const Stage& stage, const Surface& at);

/// Stripes and checks on the sides and ends of a service's vehicle.
void paint_livery(Look& look, const CarSpot& at);

/// Lamps flash 1.5 times a second, all vehicles together: ticks are 50 ms.
inline bool flashes_now(std::uint64_t tick) {
    return tick * 3 % 40 < 22;
}

}  // namespace reprise::render
