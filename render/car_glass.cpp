#include "render/car_spot.h"

namespace reprise::render {

namespace {

using world::BodyStyle;

/// Windows of cars with one cabin. Front and rear doors meet at the middle pillar.
bool is_car_glass(const CarSpot& at) {
    const float top = at.shape.top(at.x);
    if (top - at.belt < 0.16F || at.z < at.belt + 0.045F)
        return false;
    const bool van = at.shape.style == BodyStyle::van;
    if (at.normal.x() > 0.22F && std::abs(at.normal.y()) < 0.52F)
        return at.z < 0.945F * at.height && at.shape.along(at.x) > 0.5F;
    if (at.normal.x() < -0.22F && std::abs(at.normal.y()) < 0.52F)
        return at.z < 0.93F * at.height && at.z > at.belt + 0.09F && at.side < at.half * 0.72F &&
               (!van || at.side > 0.03F);
    if (std::abs(at.normal.y()) < 0.62F || at.z > std::min(top - 0.10F, 0.915F * at.height))
        return false;
    const float pillar = 0.47F * at.shape.wheelbase();
    if (van)
        return at.x > pillar + 0.35F;
    const float last = at.shape.style == BodyStyle::sedan ? 0.02F : -0.42F;
    const bool quarter = std::abs(at.x - 0.10F) < 0.035F && at.shape.style != BodyStyle::sedan;
    return at.x > last && std::abs(at.x - pillar) > 0.045F && !quarter;
}

bool is_bus_glass(const CarSpot& at) {
    if (at.normal.x() > 0.5F)
        return at.z > 0.30F * at.height && at.z < 0.90F * at.height && at.side < at.half * 0.93F;
    if (at.normal.x() < -0.5F)
        return at.z > 0.52F * at.height && at.z < 0.82F * at.height && at.side < at.half * 0.8F;
    if (std::abs(at.normal.y()) < 0.6F)
        return false;
    const float front_door = at.from_front;
    const float middle_door = std::abs(at.x - 0.42F * at.shape.wheelbase());
    const bool door =
        at.y < 0 && ((front_door > 0.45F && front_door < 1.7F) || middle_door < 0.65F);
    if (door) {
        const float leaf = std::abs(front_door < 2 ? front_door - 1.07F : middle_door);
        return at.z > 0.16F * at.height && at.z < 0.80F * at.height && leaf > 0.035F;
    }
    return at.z > 0.38F * at.height && at.z < 0.80F * at.height && at.from_rear > 0.9F &&
           fraction(at.from_front / 1.46F) > 0.05F;
}

bool is_cab_glass(const CarSpot& at) {
    if (at.normal.x() > 0.4F)
        return at.z > 0.535F * at.height && at.z < 0.82F * at.height && at.side < at.half * 0.9F;
    return std::abs(at.normal.y()) > 0.6F && at.z > 0.535F * at.height &&
           at.z < 0.78F * at.height && at.from_front > 0.35F && at.from_front < 1.2F;
}

}  // namespace

bool is_glass(const CarSpot& at) {
    switch (at.shape.style) {
        case BodyStyle::bus:
            return is_bus_glass(at);
        case BodyStyle::lorry:
            return is_cab_glass(at);
        default:
            return is_car_glass(at);
    }
}

}  // namespace reprise::render
