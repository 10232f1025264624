#include <algorithm>

#include "render/shapes/buildings/building_site.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::RoofKind;

/// Height of the roof's upper side over the eaves at this distance from the ridge.
float roof_height(const BuildingPlan& plan, float from_ridge) {
    if (plan.rise <= 0 || plan.model.roof == RoofKind::mansard)
        return plan.rise;
    return plan.rise * (1 - std::min(1.0F, from_ridge / plan.y)) + 0.15F;
}

void add_chimney(BuildingSite& site, float x, float y, float top) {
    const float foot = site.plan.eaves;
    site.build.box({x - .42F, y - .26F, foot},
                   {x + .42F, y + .26F, top},
                   site.finish(BuildingFinish::masonry));
    site.build.box({x - .48F, y - .32F, top - .22F},
                   {x + .48F, y + .32F, top - .08F},
                   site.finish(BuildingFinish::trim));
    for (const float at : {-.2F, .2F})
        site.build.tube({{x + at, y, top}, {x + at, y, top + .38F}, .11F, .09F, 8},
                        site.finish(BuildingFinish::tiles));
}

void add_chimneys(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    if (plan.model.use == world::BuildingUse::terrace) {
        // On every other party wall.
        const int homes = std::max(2, plan.columns(2 * plan.x) / 2);
        for (int i = 0; i <= homes; i += 2) {
            const float x = -plan.x + 0.6F +
                            (2 * plan.x - 1.2F) * static_cast<float>(i) / static_cast<float>(homes);
            add_chimney(
                site,
                x,
                plan.y * 0.12F,
                plan.eaves + plan.rise + (plan.model.roof == RoofKind::mansard ? 1.6F : 0.9F));
        }
        return;
    }
    const float side = hash(plan.seed, 31) % 2 == 0 ? 1.0F : -1.0F;
    const float high = plan.model.roof == RoofKind::sawtooth ? 9.0F : plan.rise + 0.9F;
    add_chimney(site, side * plan.x * 0.55F, plan.y * 0.22F, plan.eaves + high);
}

/// A small house front with a roof of its own, standing out of a slope. `y`: its face; `z`: its
/// sill.
void add_dormer(BuildingSite& site, float x, float y, float z, float back) {
    const float half = 0.72F;
    const float top = z + 1.45F;
    const float side = back > y ? 1.0F : -1.0F;
    site.wall({x - side * half, y, z}, {x + side * half, y, z}, top, WallUse::window);
    const Finish cheek = site.finish(BuildingFinish::tiles);
    for (const float at : {-half, half})
        site.build.box({x + at - .05F, std::min(y + side * .02F, back), z - .6F},
                       {x + at + .05F, std::max(y + side * .02F, back), top},
                       cheek);
    const Finish tiles = site.finish(BuildingFinish::tiles);
    const Finish trim = site.finish(BuildingFinish::trim);
    const float front = y - side * .18F;
    for (const float at : {-1.0F, 1.0F}) {
        const Vector3f eave(x + at * (half + .18F), front, top - .02F);
        const Vector3f ridge(x, front, top + .62F);
        const Vector3f in(0, back - front, 0);
        if (at * side < 0)
            site.build.plate({eave, ridge, ridge + in, eave + in}, .1F, tiles, trim);
        else
            site.build.plate({ridge, eave, eave + in, ridge + in}, .1F, tiles, trim);
    }
    site.build.triangle({Vector3f(x - side * half, y, top),
                         Vector3f(x + side * half, y, top),
                         Vector3f(x, y, top + .52F)},
                        trim);
}

void add_dormers(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const bool mansard = plan.model.roof == RoofKind::mansard;
    const bool hipped = plan.model.roof == RoofKind::hipped;
    if (plan.rise < 2.2F)
        return;
    const float reach = plan.x - (hipped ? 0.7F * plan.y : 1.2F);
    const int count = std::max(1, static_cast<int>(2 * reach / (mansard ? 3.2F : 4.2F)));
    const float from_ridge = plan.y * 0.74F;
    const float sill =
        mansard ? plan.eaves + .45F : plan.eaves + roof_height(plan, from_ridge) - .1F;
    const float back = mansard ? plan.y - 1.3F : plan.y * 0.2F;
    const float face = mansard ? plan.y - .35F : from_ridge;
    for (int i = 0; i < count; ++i) {
        const float x =
            count == 1 ? 0
                       : -reach + reach / static_cast<float>(count) * static_cast<float>(2 * i + 1);
        add_dormer(site, x, -face, sill, -back);
        if (hash(plan.seed, 33) % 2 == 0)
            add_dormer(site, x, face, sill, back);
    }
}

void add_roof_plant(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const float deck = plan.eaves - .5F;
    const Finish machine = site.finish(BuildingFinish::machine);
    const float x = plan.x * (unit(hash(plan.seed, 35)) - 0.5F);
    // The house over stairs and lift.
    site.build.box({x - 2.2F, -1.6F, deck},
                   {x + 2.2F, 1.6F, plan.eaves + 2.3F},
                   site.finish(BuildingFinish::masonry));
    site.build.box({x - 2.35F, -1.75F, plan.eaves + 2.25F},
                   {x + 2.35F, 1.75F, plan.eaves + 2.42F},
                   site.finish(BuildingFinish::trim));
    const int units = 2 + static_cast<int>(hash(plan.seed, 36) % 3);
    for (int i = 0; i < units; ++i) {
        const std::uint32_t draw = hash(plan.seed, 37, static_cast<std::uint32_t>(i));
        const float at = plan.x * 0.72F * (2 * unit(draw) - 1);
        const float across = (draw & 1u) == 0 ? plan.y * 0.5F : -plan.y * 0.5F;
        const float half = 0.7F + 0.6F * unit(hash(draw));
        site.build.box({at - half * 1.4F, across - half, deck + .15F},
                       {at + half * 1.4F, across + half, deck + 1.5F},
                       machine);
        site.build.tube(
            {{at, across, deck + 1.5F}, {at, across, deck + 1.72F}, half * .7F, half * .7F, 12},
            site.finish(BuildingFinish::metal));
    }
    site.build.tube(
        {{-x, plan.y * .2F, deck}, {-x, plan.y * .2F, plan.eaves + 1.4F}, .16F, .16F, 8}, machine);
    if (plan.model.use == world::BuildingUse::tower)
        site.build.tube({{x, 0, plan.eaves + 2}, {x, 0, plan.eaves + 9}, .09F, .03F, 6},
                        site.finish(BuildingFinish::metal));
}

/// A turret with clocks in the middle of the roof's front.
void add_turret(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const bool dome = plan.model.roof == RoofKind::dome;
    const float half = dome ? 1.5F : 0.95F;
    const float foot = dome ? plan.eaves - .4F : plan.eaves + 0.55F * plan.rise;
    const float top = dome ? plan.eaves + 2.6F : plan.eaves + plan.rise + 2.4F;
    const float y = dome ? -plan.y + half + .1F : 0;
    site.walls_around(
        {-half, y - half, foot}, {half, y + half, top}, WallUse::blank, WallUse::blank);
    const float face = half * .78F;
    const float out = half + .03F;
    const float low = top - .12F - 2 * face;
    site.wall({-face, y - out, low}, {face, y - out, low}, top - .12F, WallUse::clock);
    site.wall({face, y + out, low}, {-face, y + out, low}, top - .12F, WallUse::clock);
    site.build.box({-half - .14F, y - half - .14F, top - .06F},
                   {half + .14F, y + half + .14F, top + .1F},
                   site.finish(BuildingFinish::trim));
    site.build.frustum(
        {0, y, top + .1F}, half + .1F, .03F, half * 1.7F, site.finish(BuildingFinish::copper));
}

}  // namespace

void add_roof_parts(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    if (plan.has(world::part_chimney))
        add_chimneys(site);
    if (plan.has(world::part_dormers))
        add_dormers(site);
    if (plan.has(world::part_roof_plant))
        add_roof_plant(site);
    if (plan.has(world::part_clock) && plan.model.roof != RoofKind::spire)
        add_turret(site);
}

}  // namespace reprise::render
