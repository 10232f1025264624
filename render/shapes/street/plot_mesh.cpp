#include "render/shapes/street/plot_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ground/mesh/polygons.h"
#include "render/shapes/fast_math.h"
#include "world/geometry2d.h"

namespace reprise::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3d;
using world::Loop;

/// The part of a convex polygon to the left of the line from `from` to `to` (Sutherland and
/// Hodgman, "Reentrant polygon clipping", 1974).
Loop left_part(const Loop& polygon, const Vector2d& from, const Vector2d& to) {
    Loop kept;
    const auto side = [&](const Vector2d& p) { return world::cross(to - from, p - from); };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector2d& last = polygon[(i + polygon.size() - 1) % polygon.size()];
        const Vector2d& next = polygon[i];
        const double was = side(last);
        const double is = side(next);
        if ((was < 0) != (is < 0))
            kept.push_back(last + (next - last) * (was / (was - is)));
        if (is >= 0)
            kept.push_back(next);
    }
    return kept;
}

using Corners = std::array<Vector3d, 3>;

/// Lays what a terrain triangle and a convex piece have in common onto the triangle.
void drape(Mesh& mesh,
           const Corners& corners,
           const Loop& piece,
           double lift,
           const Vector3d& origin,
           Finish finish) {
    Loop common = {corners[0].head<2>(), corners[1].head<2>(), corners[2].head<2>()};
    for (std::size_t i = 0; i < piece.size() && common.size() >= 3; ++i)
        common = left_part(common, piece[i], piece[(i + 1) % piece.size()]);
    if (common.size() < 3)
        return;
    const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vector2d& p : common) {
        const Vector2d away = p - corners[0].head<2>();
        const double z = corners[0].z() - normal.head<2>().dot(away) / normal.z() + lift;
        add_vertex(mesh, (Vector3d(p.x(), p.y(), z) - origin).cast<float>());
    }
    for (std::uint32_t i = 2; i < common.size(); ++i)
        add_triangle(mesh, first, first + i - 1, first + i, finish);
}

/// The terrain's triangles that are not upright, by place.
struct TerrainGrid {
    explicit TerrainGrid(const ground::GroundMesh& ground) {
        std::vector<world::BoxGrid::Entry> entries;
        for (std::size_t i = 0; i < ground.triangles.size(); ++i) {
            if (ground.surfaces[i] != ground::Surface::terrain)
                continue;
            Corners corners;
            world::Box box;
            for (std::size_t k = 0; k < 3; ++k) {
                corners[k] = ground.vertices[ground.triangles[i][k]];
                box.take(corners[k].head<2>());
            }
            if ((corners[1] - corners[0]).cross(corners[2] - corners[0]).z() < 1e-6)
                continue;
            entries.push_back({box, static_cast<std::uint32_t>(triangles.size())});
            triangles.push_back(corners);
        }
        grid = world::BoxGrid(entries);
    }

    std::vector<Corners> triangles;
    world::BoxGrid grid;
};

/// The outline of each plot, less what later ones cover: two cloths at one height would flicker.
std::vector<ground::Area> visible_parts(const world::TownT& town) {
    std::vector<Loop> outlines;
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < town.plots.size(); ++i) {
        outlines.push_back(world::in_plan(town.plots[i].outline));
        if (outlines[i].size() >= 3)
            entries.push_back({world::box_around(outlines[i]), i});
    }
    const world::BoxGrid by_place(entries);
    std::vector<ground::Area> parts(outlines.size());
    for (const auto& [box, i] : entries) {
        ground::Area covers(outlines[i].front());
        for (const std::uint32_t later : by_place.near(box))
            if (later > i)
                covers.add(outlines[later]);
        parts[i] = ground::Area(outlines[i].front());
        parts[i].add(outlines[i]);
        parts[i].subtract(covers);
    }
    return parts;
}

}  // namespace

PlotFrame::PlotFrame(const world::PlotT& plot, const Vector3d& origin)
    : kind(plot.kind),
      longest(0) {
    for (const world::Vec3& corner : plot.outline)
        outline.emplace_back((world::in_plan(corner) - origin.head<2>()).cast<float>());
    start = outline.empty() ? Vector2f(0, 0) : outline.front();
    along = Vector2f(1, 0);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2f side = outline[(i + 1) % outline.size()] - outline[i];
        if (side.norm() > longest) {
            longest = side.norm();
            start = outline[i];
            along = side / longest;
        }
    }
}

float PlotFrame::edge_distance(const Vector2f& p) const {
    float least = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Vector2f side = outline[(i + 1) % outline.size()] - outline[i];
        const Vector2f away = p - outline[i];
        const float share = clamp01(away.dot(side) / std::max(1e-9F, side.squaredNorm()));
        least = std::min(least, (away - share * side).squaredNorm());
    }
    return std::sqrt(least);
}

Mesh plot_mesh(const world::TownT& town, const ground::GroundMesh& ground, const Vector3d& origin) {
    Mesh mesh;
    if (town.plots.empty())
        return mesh;
    const TerrainGrid terrain(ground);
    // Low enough that its edge throws no shadow to be seen.
    constexpr double lift = 0.01;  // [m]
    const std::vector<ground::Area> parts = visible_parts(town);
    for (std::uint32_t i = 0; i < parts.size(); ++i)
        for (const Loop& piece : parts[i].pieces())
            for (const std::uint32_t item : terrain.grid.near(world::box_around(piece)))
                drape(
                    mesh, terrain.triangles[item], piece, lift, origin, Finish{Material::plot, i});
    drop_degenerate(mesh);
    return mesh;
}

}  // namespace reprise::render
