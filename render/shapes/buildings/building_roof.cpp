#include <algorithm>
#include <cmath>

#include "render/shapes/buildings/building_site.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;
using world::RoofKind;

constexpr float thick = 0.16F;     // [m] of a pitched roof
constexpr float overhang = 0.40F;  // [m] of its eaves over the walls

/// A sloping face with its thickness; `rest` is what is seen of its edges.
void add_slope(BuildingSite& site, const std::vector<Vector3f>& corners) {
    std::vector<Vector3f> raised;
    for (const Vector3f& corner : corners)
        raised.push_back(corner + Vector3f(0, 0, thick));
    site.build.plate(
        raised, thick, site.finish(BuildingFinish::tiles), site.finish(BuildingFinish::trim));
}

/// Steep lower and flat upper slopes all around.
void add_mansard_roof(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const float inset = 0.95F;
    const float knee = plan.eaves + 2.5F;
    const std::array<Vector2f, 4> plan_corners{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    const auto corner = [&](std::size_t i, float in, float z) {
        const Vector2f& p = plan_corners[i % 4];
        return Vector3f(p.x() * (plan.x - in), p.y() * (plan.y - in), z);
    };
    for (std::size_t i = 0; i < 4; ++i)
        site.build.quad({corner(i, 0.05F, plan.eaves),
                         corner(i + 1, 0.05F, plan.eaves),
                         corner(i + 1, inset, knee),
                         corner(i, inset, knee)},
                        site.finish(BuildingFinish::tiles));
    // The cornice that the lower slopes stand on, closed below.
    const Finish trim = site.finish(BuildingFinish::trim);
    site.build.box({-plan.x - .28F, -plan.y - .28F, plan.eaves - .3F},
                   {plan.x + .28F, plan.y + .28F, plan.eaves + .02F},
                   trim);
    site.build.box({-plan.x + inset - .12F, -plan.y + inset - .12F, knee - .05F},
                   {plan.x - inset + .12F, plan.y - inset + .12F, knee + .07F},
                   trim);
    const float narrow = std::min(plan.x, plan.y) - inset;
    add_hipped_roof(site,
                    {0, 0, knee + .02F},
                    {plan.x - inset - overhang, plan.y - inset - overhang},
                    narrow * 0.22F);
}

/// Higher at the front, as one plane.
void add_shed_roof(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const float slope = plan.rise / (2 * plan.y);
    const float back = plan.eaves - overhang * slope;
    const float front = plan.eaves + plan.rise + overhang * slope;
    const float x = plan.x + 0.25F;
    add_slope(site,
              {{-x, -plan.y - overhang, front},
               {x, -plan.y - overhang, front},
               {x, plan.y + overhang, back},
               {-x, plan.y + overhang, back}});
    const float top = plan.eaves + plan.rise;
    site.wall({-plan.x, -plan.y, plan.eaves}, {plan.x, -plan.y, plan.eaves}, top, WallUse::blank);
    const Finish wall = site.finish(BuildingFinish::masonry);
    for (const float side : {-1.0F, 1.0F})
        site.build.triangle({Vector3f(side * plan.x, -side * plan.y, plan.eaves),
                             Vector3f(side * plan.x, side * plan.y, plan.eaves),
                             Vector3f(side * plan.x, -plan.y, top)},
                            wall);
}

/// Teeth along x, each with a strip of glass that looks east.
void add_sawtooth_roof(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const int teeth = std::max(2, static_cast<int>(2 * plan.x / 5.5F));
    const float tooth = 2 * plan.x / static_cast<float>(teeth);
    const Finish wall = site.finish(BuildingFinish::masonry);
    const float top = plan.eaves + plan.rise;
    for (int i = 0; i < teeth; ++i) {
        const float west = -plan.x + tooth * static_cast<float>(i);
        const float east = west + tooth;
        site.build.quad({Vector3f(west, -plan.y, plan.eaves),
                         Vector3f(east, -plan.y, top),
                         Vector3f(east, plan.y, top),
                         Vector3f(west, plan.y, plan.eaves)},
                        site.finish(BuildingFinish::tiles));
        site.build.quad({Vector3f(east, -plan.y, plan.eaves),
                         Vector3f(east, plan.y, plan.eaves),
                         Vector3f(east, plan.y, top),
                         Vector3f(east, -plan.y, top)},
                        site.finish(BuildingFinish::glass));
        for (const float side : {-1.0F, 1.0F}) {
            const Vector3f low(west, side * plan.y, plan.eaves);
            const Vector3f foot(east, side * plan.y, plan.eaves);
            const Vector3f peak(east, side * plan.y, top);
            if (side < 0)
                site.build.triangle({low, foot, peak}, wall);
            else
                site.build.triangle({foot, low, peak}, wall);
            site.build.box({east - .18F, side * plan.y - .12F, plan.eaves},
                           {east + .04F, side * plan.y + .12F, top + .08F},
                           site.finish(BuildingFinish::trim));
        }
    }
}

}  // namespace

void add_hipped_roof(BuildingSite& site, const Vector3f& middle, const Vector2f& half, float rise) {
    const float slope = rise / std::min(half.x(), half.y());
    const Vector2f wide = half + Vector2f::Constant(overhang);
    const float low = -overhang * slope;
    const bool along = half.x() >= half.y();
    const float ridge = std::abs(half.x() - half.y());
    const Vector3f end = along ? Vector3f(ridge, 0, rise) : Vector3f(0, ridge, rise);
    const Vector3f a = middle + Vector3f(-wide.x(), -wide.y(), low);
    const Vector3f b = middle + Vector3f(wide.x(), -wide.y(), low);
    const Vector3f c = middle + Vector3f(wide.x(), wide.y(), low);
    const Vector3f d = middle + Vector3f(-wide.x(), wide.y(), low);
    const Vector3f far = middle + end;
    const Vector3f near = middle + Vector3f(-end.x(), -end.y(), rise);
    if (along) {
        add_slope(site, {a, b, far, near});
        add_slope(site, {b, c, far});
        add_slope(site, {c, d, near, far});
        add_slope(site, {d, a, near});
    } else {
        add_slope(site, {a, b, near});
        add_slope(site, {b, c, far, near});
        add_slope(site, {c, d, far});
        add_slope(site, {d, a, near, far});
    }
}

void add_gabled_roof(BuildingSite& site, const Vector3f& middle, const Vector2f& half, float rise) {
    const float low = -overhang * rise / half.y();
    const float x = half.x() + 0.28F;
    const float y = half.y() + overhang;
    for (const float side : {-1.0F, 1.0F}) {
        add_slope(site,
                  {middle + Vector3f(side * x, side * y, low),
                   middle + Vector3f(-side * x, side * y, low),
                   middle + Vector3f(-side * x, 0, rise),
                   middle + Vector3f(side * x, 0, rise)});
        site.build.triangle({middle + Vector3f(side * half.x(), -side * half.y(), -.02F),
                             middle + Vector3f(side * half.x(), side * half.y(), -.02F),
                             middle + Vector3f(side * half.x(), 0, rise)},
                            site.finish(BuildingFinish::masonry));
    }
}

void add_flat_roof(BuildingSite& site, const Vector2f& half, float top) {
    const float deck = top - 0.5F;
    site.build.quad({Vector3f(-half.x(), -half.y(), deck),
                     Vector3f(half.x(), -half.y(), deck),
                     Vector3f(half.x(), half.y(), deck),
                     Vector3f(-half.x(), half.y(), deck)},
                    site.finish(BuildingFinish::deck));
    // The coping closes the parapet above; its inner face is 25 cm behind the wall.
    const Finish trim = site.finish(BuildingFinish::trim);
    const float in = 0.25F;
    const float out = 0.07F;
    for (const float side : {-1.0F, 1.0F}) {
        const float near = side * (half.y() - in);
        const float far = side * (half.y() + out);
        site.build.box({-half.x() - out, std::min(near, far), top - .04F},
                       {half.x() + out, std::max(near, far), top + .07F},
                       trim);
        site.build.box({-half.x() + .01F, std::min(near, side * (half.y() - .02F)), deck - .01F},
                       {half.x() - .01F, std::max(near, side * (half.y() - .02F)), top - .02F},
                       trim);
        const float west = side * (half.x() - in);
        const float east = side * (half.x() + out);
        site.build.box({std::min(west, east), -half.y() + in, top - .04F},
                       {std::max(west, east), half.y() - in, top + .07F},
                       trim);
        site.build.box({std::min(west, side * (half.x() - .02F)), -half.y() + in, deck - .01F},
                       {std::max(west, side * (half.x() - .02F)), half.y() - in, top - .02F},
                       trim);
    }
}

void add_roof(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    switch (plan.model.roof) {
        case RoofKind::flat:
            return add_flat_roof(site, {plan.x, plan.y}, plan.eaves);
        case RoofKind::gabled:
            return add_gabled_roof(site, {0, 0, plan.eaves}, {plan.x, plan.y}, plan.rise);
        case RoofKind::hipped:
            return add_hipped_roof(site, {0, 0, plan.eaves}, {plan.x, plan.y}, plan.rise);
        case RoofKind::mansard:
            return add_mansard_roof(site);
        case RoofKind::shed:
            return add_shed_roof(site);
        case RoofKind::sawtooth:
            return add_sawtooth_roof(site);
        case RoofKind::spire:
            return add_church(site);
        case RoofKind::dome:
            return add_dome(site);
    }
}

}  // namespace reprise::render
