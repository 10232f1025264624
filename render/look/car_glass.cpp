#include "render/look/car_surface_point.h"

namespace reprise::render {

namespace {

using world::BodyStyle;

/// Where the side windows end behind, and whether a small one is set apart.
struct SideWindows {
    float last;  ///< x
    bool quarter;
};

SideWindows side_windows(const CarSurfacePoint& at) {
    switch (at.shape.style) {
        case BodyStyle::sedan:
            return {0.02F, false};
        case BodyStyle::coupe:
            return {0.10F, false};
        case BodyStyle::pickup:
            return {at.shape.rear + 0.405F * at.shape.length(), false};
        case BodyStyle::van:
            return {middle_pillar(at) + 0.35F, false};
        case BodyStyle::minibus:
            return {at.shape.rear + 0.35F, false};
        case BodyStyle::wagon:
            return {-0.74F, true};
        default:
            return {-0.42F, true};
    }
}

/// `top`: of the body's outline here.
bool is_side_glass(const CarSurfacePoint& at, float top) {
    if (std::abs(at.normal.y()) < 0.62F || at.z > std::min(top - 0.10F, 0.915F * at.height))
        return false;
    const SideWindows windows = side_windows(at);
    const float pillar = middle_pillar(at);
    if (at.shape.style == BodyStyle::minibus && at.x < pillar - 0.05F)
        return at.x > windows.last && fraction((pillar - at.x) / 1.32F) > 0.07F;
    const bool quarter = windows.quarter && std::abs(at.x - 0.10F) < 0.035F;
    return at.x > windows.last && std::abs(at.x - pillar) > 0.045F && !quarter;
}

/// Windows of cars with one cabin. Front and rear doors meet at the middle pillar.
bool is_car_glass(const CarSurfacePoint& at) {
    const float top = at.shape.top(at.x);
    if (top - at.belt < 0.16F || at.z < at.belt + 0.045F)
        return false;
    const bool van = at.shape.style == BodyStyle::van || at.shape.style == BodyStyle::minibus;
    if (at.normal.x() > 0.22F && std::abs(at.normal.y()) < 0.52F)
        return at.z < 0.945F * at.height && at.shape.along(at.x) > 0.5F;
    if (at.normal.x() < -0.22F && std::abs(at.normal.y()) < 0.52F)
        return at.z < 0.93F * at.height && at.z > at.belt + 0.09F && at.side < at.half * 0.72F &&
               (!van || at.side > 0.03F);
    return is_side_glass(at, top);
}

bool is_bus_glass(const CarSurfacePoint& at) {
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

bool is_cab_glass(const CarSurfacePoint& at) {
    if (at.normal.x() > 0.4F)
        return at.z > 0.535F * at.height && at.z < 0.82F * at.height && at.side < at.half * 0.9F;
    return std::abs(at.normal.y()) > 0.6F && at.z > 0.535F * at.height &&
           at.z < 0.78F * at.height && at.from_front > 0.35F && at.from_front < 1.2F;
}

}  // namespace

bool is_glass(const CarSurfacePoint& at) {
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
