#include <algorithm>

#include "ground/mesh/polygons.h"
#include "ground/mesh/roofs.h"
#include "render/shapes/buildings/building_mesh.h"
#include "render/shapes/buildings/building_site.h"
#include "render/shapes/noise.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

using Corners = std::vector<Vector2f>;

Vector3f at_height(const Vector2f& p, float z) {
    return {p.x(), p.y(), z};
}

/// Slopes from all sides, where the outline is plain enough; else false.
bool add_hips(BuildingSite& site, const Corners& outline) {
    constexpr double overhang = 0.4;
    constexpr float thick = .16F;
    world::Loop loop;
    for (const Vector2f& p : outline)
        loop.push_back(p.cast<double>());
    const auto faces = ground::hipped_faces(loop, overhang);
    for (const auto& face : faces) {
        std::vector<Vector3f> corners;
        for (const Eigen::Vector3d& p : face)
            corners.push_back(p.cast<float>() + Vector3f(0, 0, site.plan.eaves + thick));
        site.build.plate(
            corners, thick, site.finish(BuildingFinish::tiles), site.finish(BuildingFinish::trim));
    }
    return !faces.empty();
}

/// A deck below the walls' upper end, and a coping along them.
void add_deck(BuildingSite& site, const Corners& outline, float eaves) {
    ground::Area area(Eigen::Vector2d::Zero());
    world::Loop loop;
    for (const Vector2f& p : outline)
        loop.push_back(p.cast<double>());
    area.add(loop);
    const Finish deck = site.finish(BuildingFinish::deck);
    for (const world::Loop& piece : area.pieces())
        for (std::size_t i = 2; i < piece.size(); ++i)
            site.build.triangle({at_height(piece[0].cast<float>(), eaves - .4F),
                                 at_height(piece[i - 1].cast<float>(), eaves - .4F),
                                 at_height(piece[i].cast<float>(), eaves - .4F)},
                                deck);
    const Finish trim = site.finish(BuildingFinish::trim);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2f& from = outline[i];
        const Vector2f& to = outline[(i + 1) % outline.size()];
        const Vector2f along = (to - from).normalized();
        const Vector2f out(along.y(), -along.x());
        const Vector2f a = from - 0.05F * along;
        const Vector2f b = to + 0.05F * along;
        site.build.plate({at_height(a + 0.06F * out, eaves + .06F),
                          at_height(b + 0.06F * out, eaves + .06F),
                          at_height(b - 0.25F * out, eaves + .06F),
                          at_height(a - 0.25F * out, eaves + .06F)},
                         .12F,
                         trim,
                         trim);
    }
}

/// In plan, relative to `foot`, without repeated points; counter-clockwise.
Corners outline_of(const world::DrawnBuildingT& building, const Eigen::Vector3d& foot) {
    world::Loop loop;
    for (const world::Vec3& corner : building.outline) {
        const Eigen::Vector2d p = world::in_plan(corner) - foot.head<2>();
        if (loop.empty() || (p - loop.back()).norm() > 0.02)
            loop.push_back(p);
    }
    while (loop.size() > 1 && (loop.front() - loop.back()).norm() <= 0.02)
        loop.pop_back();
    if (world::signed_area(loop) < 0)
        std::reverse(loop.begin(), loop.end());
    Corners outline;
    for (const Eigen::Vector2d& p : loop)
        outline.push_back(p.cast<float>());
    return outline;
}

}  // namespace

void add_drawn_building(Mesh& mesh,
                        Facades& facades,
                        const world::DrawnBuildingT& building,
                        const Eigen::Vector3d& origin) {
    if (building.outline.size() < 3)
        return;
    Eigen::Vector3d foot = world::to_eigen(building.outline.front());
    for (const world::Vec3& corner : building.outline)
        foot.z() = std::min(foot.z(), corner.z());
    const Corners outline = outline_of(building, foot);
    if (outline.size() < 3)
        return;
    const world::BuildingModel& model =
        BuildingPlan::model_of(building.model, building.height, building.style);
    const BuildingPlan plan(model, 10, 10, building.height, building.style);
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.translation() = (foot - origin).cast<float>();
    const auto paint = static_cast<std::uint32_t>(facades.buildings.size());
    facades.buildings.emplace_back(model, plan.seed);
    BuildingSite site{Builder(mesh, pose),
                      plan,
                      facades.walls,
                      paint,
                      facades.buildings.back(),
                      facades.walls.size()};
    std::size_t longest = 0;
    const auto side = [&](std::size_t i) {
        return (outline[(i + 1) % outline.size()] - outline[i]).norm();
    };
    for (std::size_t i = 1; i < outline.size(); ++i)
        if (side(i) > side(longest))
            longest = i;
    for (std::size_t i = 0; i < outline.size(); ++i)
        site.wall(at_height(outline[i], 0),
                  at_height(outline[(i + 1) % outline.size()], 0),
                  plan.eaves,
                  i == longest     ? WallUse::front
                  : side(i) < 1.6F ? WallUse::blank
                                   : WallUse::side);
    const bool pitched =
        model.roof == world::RoofKind::gabled || model.roof == world::RoofKind::hipped;
    if (!pitched || !add_hips(site, outline))
        add_deck(site, outline, plan.eaves);
}

}  // namespace reprise::render
