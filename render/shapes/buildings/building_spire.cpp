#include <algorithm>
#include <cmath>

#include "ground/mesh/roofs.h"
#include "render/shapes/buildings/building_site.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Between the windows of the nave.
void add_buttresses(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const Finish trim = site.finish(BuildingFinish::trim);
    const int columns = plan.columns(2 * plan.x);
    for (int i = 1; i < columns; ++i) {
        const float at = -plan.x + 2 * plan.x * static_cast<float>(i) / static_cast<float>(columns);
        for (const float side : {-1.0F, 1.0F})
            site.build.box(
                {at - .3F, std::min(side * plan.y, side * (plan.y + .55F)), -.4F},
                {at + .3F, std::max(side * plan.y, side * (plan.y + .55F)), plan.eaves * 0.8F},
                trim);
    }
}

}  // namespace

void add_dome(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    add_flat_roof(site, {plan.x, plan.y}, plan.eaves);
    const float radius = 0.36F * std::min(plan.x, plan.y);
    const Vector3f foot(0, 0, plan.eaves - .5F);
    site.build.lathe(foot,
                     {{0, 0},
                      {radius * 1.15F, 0},
                      {radius * 1.15F, .9F},
                      {radius * 1.02F, .9F},
                      {radius * 1.02F, 3.1F},
                      {radius * 1.12F, 3.15F},
                      {radius * 1.12F, 3.4F},
                      {0, 3.4F}},
                     24,
                     site.finish(BuildingFinish::trim));
    std::vector<Vector2f> cap;
    for (int i = 0; i <= 8; ++i) {
        const double angle = 1.5707963 * i / 8;
        cap.emplace_back(radius * static_cast<float>(std::cos(angle)),
                         3.4F + radius * 1.1F * static_cast<float>(std::sin(angle)));
    }
    site.build.lathe(foot, cap, 24, site.finish(BuildingFinish::copper));
    const float top = 3.4F + radius * 1.08F;
    site.build.lathe(foot,
                     {{.55F, top - .2F},
                      {.5F, top + 1.2F},
                      {.65F, top + 1.25F},
                      {.05F, top + 2.1F},
                      {.03F, top + 3.1F},
                      {0, top + 3.1F}},
                     10,
                     site.finish(BuildingFinish::copper));
}

void add_church(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const bool large = plan.has(world::part_clock);
    const float half = ground::tower_half(plan.y);
    const float tower = plan.eaves + plan.rise + (large ? 5.5F : 2.5F);
    add_gabled_roof(site, {0, 0, plan.eaves}, {plan.x, plan.y}, plan.rise);
    const float x = -plan.x + half - 0.02F;
    const Vector3f low(x - half, -half, plan.eaves - 1);
    site.walls_around(low, {x + half, half, tower - 3.4F}, WallUse::blank, WallUse::blank);
    site.walls_around({low.x(), low.y(), tower - 3.4F},
                      {x + half, half, tower},
                      WallUse::belfry,
                      WallUse::belfry);
    const Finish trim = site.finish(BuildingFinish::trim);
    site.build.box({x - half - .15F, -half - .15F, tower - .1F},
                   {x + half + .15F, half + .15F, tower + .2F},
                   trim);
    site.build.frustum({x, 0, tower + .2F},
                       half + .1F,
                       .04F,
                       half * (large ? 4.2F : 3.0F),
                       site.finish(large ? BuildingFinish::copper : BuildingFinish::tiles));
    site.build.tube({{x, 0, tower + half * 3},
                     {x, 0, tower + half * (large ? 4.2F : 3.0F) + 1.3F},
                     .05F,
                     .04F,
                     5},
                    site.finish(BuildingFinish::metal));
    if (large) {
        const float face = 0.75F * half;
        for (const float side : {-1.0F, 1.0F}) {
            const float y = side * (half + .03F);
            const float low_z = tower - 3.4F - 2 * face;
            site.wall({x + side * face, y, low_z},
                      {x - side * face, y, low_z},
                      tower - 3.4F,
                      WallUse::clock);
        }
    }
    if (large)
        add_buttresses(site);
}

}  // namespace reprise::render
