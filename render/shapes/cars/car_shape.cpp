#include "render/shapes/cars/car_shape.h"

#include <algorithm>

#include "render/shapes/cars/car_outline.h"

namespace reprise::render {

CarShape::CarShape(const world::VehicleModel& of)
    : model(&of),
      style(of.body),
      rear(static_cast<float>(-of.rear_overhang)),
      front(static_cast<float>(of.length - of.rear_overhang)) {
    const Outline& lines = outline_of(style);
    body_rear = rear + lines.body_start * length();
    sill = lines.sill * height();
    tumble_home = lines.tumble_home;
    boxiness = lines.boxiness;
}

float CarShape::top(float x) const {
    return interpolate(outline_of(style).top, along(x)) * height();
}

float CarShape::belt(float x) const {
    return std::min(interpolate(outline_of(style).belt, along(x)) * height(), top(x) - 0.012F);
}

float CarShape::half_width(float x) const {
    return interpolate(outline_of(style).plan, along(x)) * static_cast<float>(model->width) * 0.5F;
}

}  // namespace reprise::render
