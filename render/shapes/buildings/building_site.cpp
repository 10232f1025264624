#include "render/shapes/buildings/building_site.h"

#include "render/shapes/noise.h"
#include "world/models/building_models.h"

namespace reprise::render {

using Eigen::Vector3f;

namespace {

constexpr auto foundation = static_cast<float>(world::foundation_depth);

}  // namespace

void BuildingSite::wall(const Vector3f& left, const Vector3f& right, float top, WallUse use) {
    const float skirt = left.z() < 0.01F ? foundation : 0.0F;
    const Vector3f down(0, 0, -skirt);
    const Vector3f up(0, 0, top - left.z());
    build.quad({left + down, right + down, right + up, left + up},
               {Material::wall, static_cast<std::uint32_t>(walls.size())});
    Wall& wall = walls.emplace_back();
    wall.foot = build.pose() * left;
    wall.along = build.pose().linear() * (right - left).normalized();
    wall.length = (right - left).norm();
    wall.height = top - left.z();
    wall.ground_floor = skirt > 0 ? plan.ground_floor : 0;
    wall.floor_height = plan.floor_height;
    wall.floors = plan.floors;
    wall.columns = plan.columns(wall.length);
    if (use == WallUse::window) {
        wall.columns = 1;
        wall.floor_height = std::min(wall.floor_height, wall.height);
        wall.floors = std::max(
            0, static_cast<int>((wall.height - wall.ground_floor) / wall.floor_height + 0.3F));
    }
    wall.use = use;
    wall.building = paint;
    wall.seed = hash(plan.seed, static_cast<std::uint32_t>(walls.size()), 40);
}

void BuildingSite::walls_around(const Vector3f& low,
                                const Vector3f& high,
                                WallUse front,
                                WallUse others) {
    const Vector3f a(low.x(), low.y(), low.z());
    const Vector3f b(high.x(), low.y(), low.z());
    const Vector3f c(high.x(), high.y(), low.z());
    const Vector3f d(low.x(), high.y(), low.z());
    wall(a, b, high.z(), front);
    wall(b, c, high.z(), others);
    wall(c, d, high.z(), others);
    wall(d, a, high.z(), others);
}

}  // namespace reprise::render
