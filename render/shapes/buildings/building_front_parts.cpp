#include <algorithm>

#include "render/shapes/buildings/building_site.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// Left end of a column of the front, and the width of one.
float column_at(const BuildingPlan& plan, int column) {
    const int columns = plan.columns(2 * plan.x);
    return -plan.x + 2 * plan.x * static_cast<float>(column) / static_cast<float>(columns);
}

enum class Railing : std::uint8_t { panel, glass, bars };

/// A slab with a railing on three sides, standing out of the wall at y.
void add_balcony(BuildingSite& site, float left, float right, float y, float z, Railing railing) {
    const float out = y - 1.15F;
    site.build.box({left, out, z - .16F},
                   {right, y + .02F, z + .02F},
                   site.finish(BuildingFinish::trim),
                   box_side::high_y);
    const Finish metal = site.finish(BuildingFinish::metal);
    const auto fence = [&](float low, float high, float thickness, Finish finish) {
        site.build.box({left, out, z + low}, {right, out + thickness, z + high}, finish);
        // Between the front and the wall.
        constexpr unsigned ends = box_side::low_y | box_side::high_y;
        site.build.box(
            {left, out + thickness, z + low}, {left + thickness, y, z + high}, finish, ends);
        site.build.box(
            {right - thickness, out + thickness, z + low}, {right, y, z + high}, finish, ends);
    };
    switch (railing) {
        case Railing::panel:
            fence(.02F, 1.0F, .06F, site.finish(BuildingFinish::masonry));
            break;
        case Railing::glass:
            fence(.06F, .98F, .02F, site.finish(BuildingFinish::glass));
            fence(.98F, 1.03F, .05F, metal);
            break;
        case Railing::bars:
            for (const float at : {.14F, .34F, .54F, .74F})
                fence(at, at + .025F, .025F, metal);
            fence(.98F, 1.03F, .05F, metal);
            break;
    }
}

void add_balconies(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const int columns = plan.columns(2 * plan.x);
    const auto railing = static_cast<Railing>(hash(plan.seed, 41) % 3);
    for (int level = 1; level <= plan.floors; ++level)
        for (int i = 0; i < columns; ++i)
            if (has_balcony(plan.model, i, columns))
                add_balcony(site,
                            column_at(plan, i) + .1F,
                            column_at(plan, i + 1) - .1F,
                            -plan.y,
                            plan.floor(level),
                            railing);
}

/// Bay windows over the height of the front, with small roofs.
void add_bays(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const int columns = plan.columns(2 * plan.x);
    const float out = 0.6F;
    for (int i = 0; i < columns; ++i) {
        const bool door =
            plan.model.use == world::BuildingUse::terrace ? i % 2 == 0 : i == columns / 2;
        const bool here =
            plan.model.use == world::BuildingUse::terrace ? !door : (i == 0 || i == columns - 1);
        if (!here)
            continue;
        const float left = column_at(plan, i) + .2F;
        const float right = column_at(plan, i + 1) - .2F;
        const float top = plan.eaves - .35F;
        const float y = -plan.y;
        site.wall({left + .3F, y - out, 0}, {right - .3F, y - out, 0}, top, WallUse::window);
        site.wall({left, y, 0}, {left + .3F, y - out, 0}, top, WallUse::blank);
        site.wall({right - .3F, y - out, 0}, {right, y, 0}, top, WallUse::blank);
        const Finish trim = site.finish(BuildingFinish::trim);
        site.build.plate({{left - .1F, y, top + .1F},
                          {left + .25F, y - out - .1F, top + .1F},
                          {right - .25F, y - out - .1F, top + .1F},
                          {right + .1F, y, top + .1F}},
                         .16F,
                         trim,
                         trim);
    }
}

/// A roof on two posts over a door, and a step before it.
void add_porch(BuildingSite& site, float x, bool posts) {
    const float y = -site.plan.y;
    const float out = posts ? 1.15F : 0.75F;
    const Finish timber = site.finish(BuildingFinish::timber);
    const Finish tiles = site.finish(BuildingFinish::tiles);
    const float z = 2.35F;
    for (const float side : {-1.0F, 1.0F}) {
        const Vector3f eave(x + side * 1.0F, y - out, z);
        const Vector3f ridge(x, y - out, z + .6F);
        const Vector3f in(0, out, 0);
        if (side < 0)
            site.build.plate({eave, ridge, ridge + in, eave + in}, .08F, tiles, timber);
        else
            site.build.plate({ridge, eave, eave + in, ridge + in}, .08F, tiles, timber);
        if (posts)
            site.build.box({x + side * .82F - .06F, y - out + .1F, 0},
                           {x + side * .82F + .06F, y - out + .22F, z},
                           timber);
    }
    site.build.triangle({Vector3f(x - .95F, y - out + .04F, z),
                         Vector3f(x + .95F, y - out + .04F, z),
                         Vector3f(x, y - out + .04F, z + .55F)},
                        timber);
    site.build.box({x - .8F, y - out, -.3F}, {x + .8F, y, .13F}, site.finish(BuildingFinish::trim));
}

void add_porches(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const int columns = plan.columns(2 * plan.x);
    const bool terrace = plan.model.use == world::BuildingUse::terrace;
    for (int i = 0; i < columns; ++i)
        if (terrace ? i % 2 == 0 : i == columns / 2)
            add_porch(site, 0.5F * (column_at(plan, i) + column_at(plan, i + 1)), !terrace);
}

/// The board over the shop windows, and awnings below it.
void add_shop(BuildingSite& site, float y) {
    const BuildingPlan& plan = site.plan;
    const float low = plan.ground_floor - .95F;
    const float high = plan.ground_floor - .22F;
    const float x = plan.x - .35F;
    // One board a shop: wide houses hold several.
    const int shops = plan.model.use == world::BuildingUse::shop && plan.model.longest > 35
                          ? 1
                          : std::max(1, static_cast<int>(2 * plan.x / 8.5F));
    const float width = 2 * x / static_cast<float>(shops);
    const Finish trim = site.finish(BuildingFinish::trim);
    for (int i = 0; i < shops; ++i) {
        const float left = -x + width * static_cast<float>(i) + .12F;
        const float right = left + width - .24F;
        site.build.box({left, y - .10F, low}, {right, y + .02F, high}, trim, box_side::high_y);
        site.wall({left + .03F, y - .115F, low + .03F},
                  {right - .03F, y - .115F, low + .03F},
                  high - .03F,
                  WallUse::sign);
        if (!plan.has(world::part_awning) ||
            hash(plan.seed, 45, static_cast<std::uint32_t>(i)) % 4 == 0)
            continue;
        const Finish awning = site.finish(BuildingFinish::awning);
        const float out = y - 1.25F;
        const float edge = low - .72F;
        site.build.plate({{left + .1F, out, edge},
                          {right - .1F, out, edge},
                          {right - .1F, y, low - .04F},
                          {left + .1F, y, low - .04F}},
                         .03F,
                         awning,
                         awning);
        site.build.box(
            {left + .1F, out - .015F, edge - .24F}, {right - .1F, out + .01F, edge}, awning);
    }
}

/// Landings with railings and ladders before the front, from the first floor up.
void add_fire_escape(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const Finish metal = site.finish(BuildingFinish::metal);
    const int columns = plan.columns(2 * plan.x);
    const int first = columns / 2 - (columns > 2 ? 1 : 0);
    const float left = column_at(plan, first);
    const float right = column_at(plan, std::min(columns, first + 2));
    const float y = -plan.y;
    const float out = y - 1.1F;
    for (int level = 1; level <= plan.floors; ++level) {
        const float z = plan.floor(level) + .1F;
        site.build.box({left, out, z - .07F}, {right, y, z}, metal, box_side::high_y);
        for (const float at : {.35F, .68F, 1.0F}) {
            site.build.box({left, out, z + at - .02F}, {right, out + .035F, z + at + .02F}, metal);
            site.build.box({left, out, z + at - .02F},
                           {left + .035F, y, z + at + .02F},
                           metal,
                           box_side::high_y);
            site.build.box({right - .035F, out, z + at - .02F},
                           {right, y, z + at + .02F},
                           metal,
                           box_side::high_y);
        }
        const int posts = 5;
        for (int i = 0; i <= posts; ++i) {
            const float x = mix(left, right, static_cast<float>(i) / posts);
            site.build.box({x - .02F, out, z},
                           {x + .02F, out + .035F, z + 1},
                           metal,
                           box_side::low_z | box_side::high_z);
        }
        if (level == plan.floors)
            continue;
        // A steep stair to the next landing, leaning the other way on every other floor.
        const float rise = plan.floor(level + 1) + .1F - z;
        const bool east = level % 2 == 0;
        const float foot = east ? left + .5F : right - .5F;
        const float head = east ? right - .9F : left + .9F;
        const auto at = [&](float share, float across, float up) {
            return Vector3f(mix(foot, head, share), across, z + rise * share + up);
        };
        for (const float across : {out + .14F, out + .72F}) {
            const Vector3f low = at(0, across, 0);
            const Vector3f high = at(1, across, 0);
            site.build.tube({low, high, .05F, .05F, 4}, metal);
            site.build.tube(
                {low + Vector3f(0, 0, .85F), high + Vector3f(0, 0, .85F), .02F, .02F, 4}, metal);
        }
        const int steps = 11;
        for (int i = 1; i < steps; ++i) {
            const Vector3f p = at(static_cast<float>(i) / steps, 0, 0);
            site.build.box({p.x() - .11F, out + .16F, p.z() - .02F},
                           {p.x() + .11F, out + .7F, p.z() + .01F},
                           metal);
        }
    }
}

}  // namespace

void add_front_parts(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const bool arcade = plan.has(world::part_arcade);
    if (plan.has(world::part_balconies))
        add_balconies(site);
    if (plan.has(world::part_bays))
        add_bays(site);
    if (plan.has(world::part_porch) && !plan.has(world::part_shop_front))
        add_porches(site);
    if (plan.has(world::part_shop_front) && !arcade)
        add_shop(site, -plan.y);
    if (plan.has(world::part_fire_escape))
        add_fire_escape(site);
}

}  // namespace reprise::render
