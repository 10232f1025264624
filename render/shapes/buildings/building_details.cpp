#include <cmath>

#include "render/shapes/buildings/building_site.h"
#include "render/shapes/buildings/openings.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::FacadeKind;
using world::RoofKind;

/// x along the wall, y into it, z up, from its foot.
Eigen::Isometry3f frame_of(const Wall& wall) {
    Eigen::Isometry3f frame = Eigen::Isometry3f::Identity();
    frame.linear().col(0) = wall.along;
    frame.linear().col(1) = Vector3f(-wall.along.y(), wall.along.x(), 0);
    frame.translation() = wall.foot;
    return frame;
}

void add_sills(const BuildingSite& site, const Wall& wall) {
    const Builder at_wall = site.build.in(frame_of(wall));
    Builder build = at_wall;
    const float width = wall.length / static_cast<float>(wall.columns);
    const int lowest = wall.ground_floor > 0 ? 0 : 1;
    for (int level = lowest; level <= wall.floors; ++level) {
        const float floor = level == 0 ? wall.ground_floor : wall.floor_height;
        const float foot =
            level == 0 ? 0 : wall.ground_floor + wall.floor_height * static_cast<float>(level - 1);
        for (int column = 0; column < wall.columns; ++column) {
            const float middle = width * (static_cast<float>(column) + 0.5F);
            const Opening opening = opening_at(wall, site.painted, middle, foot + 0.5F * floor);
            if (opening.kind != OpeningKind::window || opening.low < foot + 0.3F)
                continue;
            build.box({opening.left - .09F, -.10F, opening.low - .08F},
                      {opening.right + .09F, .02F, opening.low},
                      site.finish(BuildingFinish::trim),
                      box_side::high_y);
        }
    }
}

/// Along the eaves of both long sides, with a pipe down at a corner of each; rows of houses have
/// one at every second home.
void add_gutters(BuildingSite& site) {
    const BuildingPlan& plan = site.plan;
    const bool hipped = plan.model.roof == RoofKind::hipped;
    const float slope = plan.rise / (hipped ? std::min(plan.x, plan.y) : plan.y);
    const float out = 0.45F;
    const float z = plan.eaves - 0.4F * slope + 0.08F;
    const float x = plan.x + 0.3F;
    const Finish metal = site.finish(BuildingFinish::metal);
    for (const float side : {-1.0F, 1.0F}) {
        const float eave = side * (plan.y + out);
        site.build.tube({{-x, eave, z}, {x, eave, z}, .065F, .065F, 6}, metal);
        const int homes = plan.model.use == world::BuildingUse::terrace
                              ? std::max(1, plan.columns(2 * plan.x) / 4)
                              : 1;
        for (int i = 0; i < homes; ++i) {
            const float share = static_cast<float>(i) / static_cast<float>(homes);
            const float at = -side * (plan.x - 0.12F - 2 * (plan.x - 0.12F) * share);
            const float wall = side * (plan.y + .07F);
            site.build.tube({{at, eave, z}, {at, wall, z - .45F}, .04F, .04F, 5}, metal);
            site.build.tube({{at, wall, z - .43F}, {at, wall, -.1F}, .04F, .04F, 5}, metal);
        }
    }
}

}  // namespace

void add_details(BuildingSite& site) {
    const FacadeKind facade = site.plan.model.facade;
    const RoofKind roof = site.plan.model.roof;
    const bool massive = facade == FacadeKind::brick || facade == FacadeKind::plaster ||
                         facade == FacadeKind::stone || facade == FacadeKind::timber;
    // Towers are too far to see the sills of.
    if (massive && site.plan.floors <= 7) {
        for (std::size_t i = site.first_wall; i < site.walls.size(); ++i)
            if (site.walls[i].use != WallUse::back)
                add_sills(site, site.walls[i]);
    }
    if (roof == RoofKind::gabled || roof == RoofKind::hipped)
        add_gutters(site);
}

}  // namespace reprise::render
