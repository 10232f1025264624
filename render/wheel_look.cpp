#include <cmath>

#include "render/car_spot.h"

namespace reprise::render {

Look wheel_look(const Surface& at) {
    Look look;
    look.normal = at.normal;
    const Eigen::Vector3f& p = at.local;
    const float radius = std::sqrt(p.x() * p.x() + p.z() * p.z());
    const bool large = p.y() > 0.115F || at.instance->prototype->mesh.vertices.back().y() < -0.12F;
    const float rim = (large ? 0.48F : 0.325F) * 0.70F;
    if (p.y() < 0 || radius > rim || at.local_normal.y() < 0.2F) {
        as_trim(look, Color::Constant(0.022F));
        look.roughness = 0.8F;
        return look;
    }
    // Five spokes. So few pixels show rims that atan2 may be slow.
    const auto turn = static_cast<float>(
        std::atan2(static_cast<double>(p.z()), static_cast<double>(p.x())) / 6.283185307);
    const float spoke = std::abs(fraction(turn * 5) - 0.5F);
    const float share = radius / rim;
    const bool metal = share > 0.88F || share < 0.24F || spoke < 0.16F + 0.05F * share;
    as_trim(look, metal ? Color(.40F, .41F, .42F) : Color::Constant(0.02F));
    if (metal) {
        look.f0 = 0.4F;
        look.roughness = 0.25F;
    }
    return look;
}

}  // namespace reprise::render
