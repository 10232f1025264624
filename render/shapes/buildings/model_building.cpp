#include "ground/mesh/polygons.h"
#include "render/shapes/buildings/building_mesh.h"
#include "render/shapes/buildings/building_site.h"
#include "render/shapes/noise.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::BuildingUse;
using world::FacadeKind;

constexpr float arcade_depth = 2.1F;  // [m]

/// Columns before a ground floor that lies back; what is above rests on them.
void add_arcade(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const Finish trim = site.finish(BuildingFinish::trim);
    const float back = -plan.y + arcade_depth;
    site.wall({-plan.x, back, 0}, {plan.x, back, 0}, plan.ground_floor, WallUse::front);
    const float top = plan.ground_floor;
    site.build.box({-plan.x, -plan.y + .02F, top - .45F}, {plan.x, back, top + .02F}, trim);
    site.build.box({-plan.x, -plan.y, -.4F}, {plan.x, back, .06F}, trim);
    const int columns = plan.columns(2 * plan.x);
    for (int i = 0; i <= columns; ++i) {
        const float half = i == 0 || i == columns ? .34F : .24F;
        const float at = std::min(
            plan.x - half,
            std::max(-plan.x + half,
                     -plan.x + 2 * plan.x * static_cast<float>(i) / static_cast<float>(columns)));
        site.build.box(
            {at - half, -plan.y + .04F, 0}, {at + half, -plan.y + .04F + 2 * half, top}, trim);
        site.build.box({at - half - .08F, -plan.y - .02F, top - .75F},
                       {at + half + .08F, -plan.y + .1F + 2 * half, top - .43F},
                       trim);
    }
    // Ends of what lies above, and of the walls beside the arcade.
    if (plan.eaves > top + .01F)
        site.wall({-plan.x, -plan.y, top}, {plan.x, -plan.y, top}, plan.eaves, WallUse::front);
}

/// Ledges of another stone all around.
void add_ledges(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const Finish trim = site.finish(BuildingFinish::trim);
    const auto ledge = [&](float out, float low, float high, bool front) {
        const float x = plan.x + out;
        const float y = plan.y + out;
        if (front)
            site.build.box({-x, -y, low}, {x, -plan.y + .02F, high}, trim, box_side::high_y);
        site.build.box({-x, plan.y - .02F, low}, {x, y, high}, trim, box_side::low_y);
        site.build.box({-x, -plan.y, low}, {-plan.x + .02F, plan.y, high}, trim, box_side::high_x);
        site.build.box({plan.x - .02F, -plan.y, low}, {x, plan.y, high}, trim, box_side::low_x);
    };
    const FacadeKind facade = plan.model.facade;
    const bool open = plan.has(world::part_arcade) || plan.has(world::part_shop_front) ||
                      plan.has(world::part_gate);
    if (facade != FacadeKind::glass && !plan.has(world::part_bays))
        ledge(.05F, -.4F, .42F, !open);
    const bool noble =
        facade == FacadeKind::stone ||
        (facade == FacadeKind::brick && plan.floors >= 2 && hash(plan.seed, 51) % 2 == 0);
    if (noble && plan.floors > 0 && !plan.has(world::part_bays))
        ledge(.10F, plan.ground_floor - .16F, plan.ground_floor + .02F, true);
    if (noble && plan.rise <= 0) {
        ledge(.22F, plan.eaves - .62F, plan.eaves - .42F, true);
        ledge(.12F, plan.eaves - .78F, plan.eaves - .62F, true);
    }
}

void add_walls(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const float x = plan.x;
    const float y = plan.y;
    // Up into the roof's beams, so that nothing is seen between them.
    const float top = plan.eaves;
    if (plan.has(world::part_arcade))
        add_arcade(site);
    else
        site.wall({-x, -y, 0}, {x, -y, 0}, top, WallUse::front);
    const bool row = plan.model.use == BuildingUse::terrace;
    const WallUse side = row && hash(plan.seed, 52) % 3 != 0 ? WallUse::blank : WallUse::side;
    site.wall({x, -y, 0}, {x, y, 0}, top, side);
    site.wall({x, y, 0}, {-x, y, 0}, top, WallUse::back);
    site.wall({-x, y, 0}, {-x, -y, 0}, top, side);
}

void build(BuildingSite& site) {
    add_walls(site);
    add_ledges(site);
    add_roof(site);
    add_roof_parts(site);
    add_front_parts(site);
    add_details(site);
}

}  // namespace

void add_model_building(Mesh& mesh,
                        Facades& facades,
                        const world::Building& building,
                        const Eigen::Vector3d& origin) {
    const world::BuildingModel& model =
        BuildingPlan::model_of(building.model(), building.height(), building.style());
    const BuildingPlan plan(
        model, building.length(), building.width(), building.height(), building.style());
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.linear() =
        Eigen::AngleAxisf(static_cast<float>(building.yaw()), Vector3f::UnitZ()).toRotationMatrix();
    pose.translation() = (world::to_eigen(building.centre()) - origin).cast<float>();
    const auto paint = static_cast<std::uint32_t>(facades.buildings.size());
    facades.buildings.emplace_back(model, plan.seed);
    BuildingSite site{Builder(mesh, pose),
                      plan,
                      facades.walls,
                      paint,
                      facades.buildings.back(),
                      facades.walls.size()};
    build(site);
}

}  // namespace reprise::render
