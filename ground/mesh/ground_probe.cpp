#include "ground/mesh/ground_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/geometry2d.h"

namespace reprise::ground {

namespace {

constexpr double cell = 4.0;          ///< [m] about a lane: few triangles in each
constexpr double least_area = 1e-9;   ///< [m2] twice that of a triangle from above
constexpr double headroom = 2.0;      ///< [m] terrain closer below a road carries only the road
constexpr double on_the_edge = 1e-9;  ///< [m2] a plumb line on a seam hits both sides

world::Box box_of(const GroundMesh& mesh, std::size_t triangle) {
    world::Box box;
    for (const std::uint32_t vertex : mesh.triangles[triangle])
        box.take(mesh.vertices[vertex].head<2>());
    return box;
}

/// Height of a triangle at a place in plan, when it is over it.
std::optional<double> height_at(const GroundMesh& mesh,
                                std::size_t triangle,
                                const Eigen::Vector2d& p) {
    const auto& [first, second, third] = mesh.triangles[triangle];
    const Eigen::Vector3d corners[] = {
        mesh.vertices[first], mesh.vertices[second], mesh.vertices[third]};
    double weights[3];
    double whole = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector2d from = corners[(i + 1) % 3].head<2>() - p;
        const Eigen::Vector2d to = corners[(i + 2) % 3].head<2>() - p;
        weights[i] = world::cross(from, to);
        whole += weights[i];
        if (weights[i] < -on_the_edge)
            return std::nullopt;
    }
    if (whole < least_area)
        return std::nullopt;
    return (weights[0] * corners[0].z() + weights[1] * corners[1].z() +
            weights[2] * corners[2].z()) /
           whole;
}

/// May a triangle be over any place of a box? By its sides: many are long, and far from the box.
bool may_cover(const GroundMesh& mesh, std::size_t triangle, const world::Box& box) {
    constexpr double rounding = 1e-6;  // [m2]
    const auto& vertices = mesh.triangles[triangle];
    for (std::size_t i = 0; i < 3; ++i) {
        const Eigen::Vector2d start = mesh.vertices[vertices[i]].head<2>();
        const Eigen::Vector2d along = mesh.vertices[vertices[(i + 1) % 3]].head<2>() - start;
        // Left of it the furthest corner of the box.
        const Eigen::Vector2d corner(along.y() > 0 ? box.low.x() : box.high.x(),
                                     along.x() > 0 ? box.high.y() : box.low.y());
        if (world::cross(along, corner - start) < -rounding)
            return false;
    }
    return true;
}

}  // namespace

/// Where height_at() may find something. Of what carries nobody: nowhere.
GroundProbe::Extent GroundProbe::extent_of(const GroundMesh& mesh, std::size_t triangle) {
    const Surface surface = mesh.surfaces[triangle];
    if (surface == Surface::kerb || surface == Surface::marking || surface == Surface::deck)
        return {};
    const auto& [first, second, third] = mesh.triangles[triangle];
    const Eigen::Vector2d corner = mesh.vertices[first].head<2>();
    const double area = std::abs(world::cross(mesh.vertices[second].head<2>() - corner,
                                              mesh.vertices[third].head<2>() - corner));
    world::Box box = box_of(mesh, triangle);
    // A splinter is hit beside it: by as much of its size as it is thinner than the seam allowed.
    const double beside = (box.high - box.low).sum() * 4 * on_the_edge / std::max(area, least_area);
    // Of single precision, which is a hand's breadth in coordinates of a whole country.
    constexpr double rounding = 0.01;  // [m]
    constexpr double of_place = 1.2e-7;
    const double more =
        beside + rounding +
        of_place * std::max(box.low.cwiseAbs().maxCoeff(), box.high.cwiseAbs().maxCoeff());
    return {static_cast<float>(box.low.x() - more),
            static_cast<float>(box.low.y() - more),
            static_cast<float>(box.high.x() + more),
            static_cast<float>(box.high.y() + more)};
}

GroundProbe::GroundProbe(const GroundMesh& mesh) : mesh_(&mesh) {
    std::vector<world::BoxGrid::Entry> entries;
    entries.reserve(mesh.triangles.size());
    extents_.reserve(mesh.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        entries.push_back({box_of(mesh, i), i});
        extents_.push_back(extent_of(mesh, i));
    }
    by_place_ = world::BoxGrid(entries, cell);
}

std::optional<GroundProbe::Hit> GroundProbe::highest_of(std::span<const std::uint32_t> triangles,
                                                        const Eigen::Vector3d& from_world) const {
    const Eigen::Vector2d p = from_world.head<2>();
    std::optional<Hit> highest;
    for (const std::uint32_t triangle : triangles) {
        const Extent& extent = extents_[triangle];
        if (p.x() < static_cast<double>(extent.west) || p.x() > static_cast<double>(extent.east) ||
            p.y() < static_cast<double>(extent.south) || p.y() > static_cast<double>(extent.north))
            continue;
        const std::optional<double> z = height_at(*mesh_, triangle, p);
        if (z && *z <= from_world.z() && (!highest || *z > highest->z))
            highest = Hit{*z, mesh_->surfaces[triangle]};
    }
    return highest;
}

std::optional<GroundProbe::Hit> GroundProbe::below(const Eigen::Vector3d& from_world) const {
    return highest_of(by_place_.at(from_world.head<2>()), from_world);
}

std::optional<GroundProbe::Hit> GroundProbe::below(const Eigen::Vector3d& from_world,
                                                   Around& around) const {
    constexpr double reach = 0.8;  // [m] half a second's walk
    const Eigen::Vector2d p = from_world.head<2>();
    const std::span<const std::uint32_t> cell = by_place_.at(p);
    const bool is_known = cell.data() == around.cell.data() && cell.size() == around.cell.size();
    if (!is_known || p.x() < around.box.low.x() || p.x() > around.box.high.x() ||
        p.y() < around.box.low.y() || p.y() > around.box.high.y()) {
        around.cell = cell;
        around.box = {};
        around.box.take(p, reach);
        around.triangles.clear();
        for (const std::uint32_t triangle : cell)
            if (extents_[triangle].west <= extents_[triangle].east &&
                may_cover(*mesh_, triangle, around.box))
                around.triangles.push_back(triangle);
    }
    return highest_of(around.triangles, from_world);
}

std::optional<GroundProbe::Hit> GroundProbe::nearest(const Eigen::Vector3d& near_world) const {
    const double z = near_world.z();
    std::optional<Hit> best;
    double from = std::numeric_limits<double>::max();
    while (const std::optional<Hit> hit = below({near_world.x(), near_world.y(), from})) {
        if (!best || std::abs(hit->z - z) < std::abs(best->z - z))
            best = hit;
        from = hit->z - headroom;
    }
    return best;
}

}  // namespace reprise::ground
