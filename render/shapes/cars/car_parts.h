#pragma once

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

}  // namespace reprise::render
