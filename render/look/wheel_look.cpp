#include <cmath>

#include "render/look/car_surface_point.h"

namespace reprise::render {

namespace {

/// Is there metal at this share of the rim's radius and this turn of the wheel, in [0, 1)?
bool is_metal(std::uint32_t design, float share, float turn) {
    switch (design) {
        case 0: {  // five broad spokes
            const float spoke = std::abs(fraction(turn * 5) - 0.5F);
            return share > 0.88F || share < 0.24F || spoke < 0.16F + 0.05F * share;
        }
        case 1: {  // ten thin ones
            const float spoke = std::abs(fraction(turn * 10) - 0.5F);
            return share > 0.90F || share < 0.20F || spoke < 0.17F + 0.05F * share;
        }
        case 2: {  // seven double ones
            const float spoke = std::abs(fraction(turn * 7) - 0.5F);
            return share > 0.90F || share < 0.26F || (spoke > 0.08F && spoke < 0.26F);
        }
        default:  // a plate with holes
            return share < 0.62F || share > 0.82F || std::abs(fraction(turn * 8) - 0.5F) > 0.22F;
    }
}

}  // namespace

Look wheel_look(const ShadingInput& input, const Surface& at) {
    Look look;
    look.normal = at.normal;
    const CarShape& shape = input.scene.car_shape(at.instance->model);
    const Eigen::Vector3f& p = at.local;
    const float radius = std::sqrt(p.x() * p.x() + p.z() * p.z());
    const float rim = shape.wheel_radius() * 0.70F;
    if (p.y() < 0 || radius > rim || at.local_normal.y() < 0.2F) {
        as_trim(look, Color::Constant(0.022F));
        look.roughness = 0.8F;
        return look;
    }
    // So few pixels show rims that atan2 may be slow.
    const auto turn = static_cast<float>(
        std::atan2(static_cast<double>(p.z()), static_cast<double>(p.x())) / 6.283185307);
    const bool works = shape.wheel_radius() > 0.4F || shape.style == world::BodyStyle::van ||
                       shape.style == world::BodyStyle::minibus;
    const std::uint32_t design = works ? 3 : hash(at.instance->look, 21) % 3;
    const bool metal = is_metal(design, radius / rim, turn);
    as_trim(look, metal ? Color(.40F, .41F, .42F) : Color::Constant(0.02F));
    if (metal) {
        look.f0 = 0.4F;
        look.roughness = 0.25F;
    }
    return look;
}

}  // namespace reprise::render
