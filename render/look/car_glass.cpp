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

/// Share of the length behind which there is a boot or a bed, and no rear window.
float boot_end(BodyStyle style) {
    switch (style) {
        case BodyStyle::sedan:
            return 0.13F;
        case BodyStyle::coupe:
            return 0.12F;
        case BodyStyle::pickup:
            return 0.37F;
        default:
            return 0;
    }
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
        return at.shape.along(at.x) > boot_end(at.shape.style) && at.z < 0.93F * at.height &&
               at.z > at.belt + 0.09F && at.side < at.half * 0.72F && (!van || at.side > 0.03F);
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

void show_cabin(Look& look, const CarSurfacePoint& at, const Eigen::Vector3f& view, float near) {
    if (is_long(at) || near <= 0)
        return;
    // Where the view leaves the cabin, a box.
    const Eigen::Vector3f from(at.x, at.y, at.z);
    const float belt = at.shape.belt(middle_pillar(at));
    const Eigen::Vector3f low(
        at.shape.rear + 0.16F * at.shape.length(), -0.86F * at.half, belt - 0.5F);
    const Eigen::Vector3f high(
        at.shape.rear + 0.70F * at.shape.length(), 0.86F * at.half, 0.94F * at.height);
    float leaves = 1e9F;
    int wall = 2;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(view[axis]) < 1e-4F)
            continue;
        const float way = ((view[axis] > 0 ? high : low)[axis] - from[axis]) / view[axis];
        if (way < leaves) {
            leaves = way;
            wall = axis;
        }
    }
    const Eigen::Vector3f end = from + std::max(0.0F, leaves) * view;
    const bool through = wall != 2 && end.z() > belt + 0.06F && end.z() < 0.90F * at.height &&
                         (wall == 0 || std::abs(end.x() - middle_pillar(at)) > 0.06F);
    // Two panes take a good half of the light; below the horizon the street is darker than the sky.
    Color seen = !through       ? Color(.013F, .0135F, .014F)
                 : view.z() > 0 ? Color(.115F, .130F, .140F)
                                : Color(.070F, .074F, .075F);
    // Backs of seats with their head rests, those that are nearer first.
    const float front_row = middle_pillar(at) - 0.12F;
    float nearest = leaves;
    for (const float row : {front_row, front_row - 0.85F}) {
        const float way = std::abs(view.x()) < 1e-3F ? -1 : (row - from.x()) / view.x();
        if (way <= 0 || way >= nearest)
            continue;
        const Eigen::Vector3f p = from + way * view;
        const float y = std::abs(std::abs(p.y()) - 0.44F * at.half);
        const bool back = p.z() < belt + 0.07F && y < 0.30F * at.half;
        const float up = p.z() - (belt + 0.145F);
        const bool rest = y * y / (0.13F * 0.13F) + up * up / (0.085F * 0.085F) < 1;
        if (back || rest) {
            seen = rest ? Color(.034F, .033F, .032F) : Color(.026F, .025F, .025F);
            nearest = way;
        }
    }
    look.albedo = mix(look.albedo, seen, near);
}

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
