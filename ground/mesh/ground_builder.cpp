#include "ground/mesh/ground_builder.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <Eigen/Geometry>

#include "world/geometry2d.h"

namespace reprise::ground {

namespace {

/// [m2] Smaller triangles hold no wheel, and their normals are noise.
constexpr double smallest_triangle = 1e-6;

/// The part of a convex polygon where coordinate `axis` lies on `side` (+1 above, -1 below) of
/// `at`.
world::Loop clip(const world::Loop& polygon, int axis, double at, double side) {
    world::Loop kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Eigen::Vector2d& from = polygon[i];
        const Eigen::Vector2d& to = polygon[(i + 1) % polygon.size()];
        const double start = side * (from[axis] - at);
        const double end = side * (to[axis] - at);
        if (start >= 0)
            kept.push_back(from);
        if ((start > 0 && end < 0) || (start < 0 && end > 0))
            kept.push_back(from + (to - from) * (start / (start - end)));
    }
    return kept;
}

/// Cut along the lines where `axis` is a multiple of `cell`.
std::vector<world::Loop> cut(const std::vector<world::Loop>& polygons, int axis, double cell) {
    std::vector<world::Loop> parts;
    for (const world::Loop& polygon : polygons) {
        const world::Box box = world::box_around(polygon);
        world::Loop rest = polygon;
        const double last = std::floor(box.high[axis] / cell);
        for (double line = std::floor(box.low[axis] / cell) + 1; line <= last; ++line) {
            parts.push_back(clip(rest, axis, line * cell, -1));
            rest = clip(rest, axis, line * cell, 1);
        }
        parts.push_back(std::move(rest));
    }
    return parts;
}

}  // namespace

std::size_t GroundBuilder::Hash::operator()(const std::array<double, 3>& p) const {
    std::uint64_t hash = 0;
    for (const double coordinate : p)
        hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 32);
}

std::uint32_t GroundBuilder::vertex(const Eigen::Vector3d& p) {
    const auto next = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto [found, is_new] = index_.try_emplace({p.x(), p.y(), p.z()}, next);
    if (is_new)
        mesh_.vertices.push_back(p);
    return found->second;
}

void GroundBuilder::add_triangle(const Eigen::Vector3d& p,
                                 const Eigen::Vector3d& q,
                                 const Eigen::Vector3d& r,
                                 Surface surface) {
    const double area = (q - p).cross(r - p).norm() / 2;
    if (!(area > smallest_triangle) || !std::isfinite(area))
        return;
    mesh_.triangles.push_back({vertex(p), vertex(q), vertex(r)});
    mesh_.surfaces.push_back(surface);
}

void GroundBuilder::add_face(const std::vector<Eigen::Vector3d>& corners, Surface surface) {
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Eigen::Vector2d first = (corners[i] - corners[0]).head<2>();
        const Eigen::Vector2d second = (corners[i + 1] - corners[0]).head<2>();
        const double area = world::cross(first, second) / 2;
        if (area > smallest_triangle)
            add_triangle(corners[0], corners[i], corners[i + 1], surface);
        else if (area < -smallest_triangle)
            add_triangle(corners[0], corners[i + 1], corners[i], surface);
    }
}

void GroundBuilder::add_face(const world::Loop& corners,
                             const Height& height,
                             double cell,
                             Surface surface) {
    std::vector<world::Loop> parts{corners};
    if (cell > 0)
        parts = cut(cut(parts, 0, cell), 1, cell);
    for (const world::Loop& part : parts) {
        std::vector<Eigen::Vector3d> raised;
        for (const Eigen::Vector2d& p : part)
            raised.emplace_back(p.x(), p.y(), height(p));
        add_face(raised, surface);
    }
}

void GroundBuilder::add_wall(const Eigen::Vector3d& from,
                             const Eigen::Vector3d& to,
                             double bottom,
                             double top,
                             Surface surface) {
    const Eigen::Vector3d down = bottom * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d up = top * Eigen::Vector3d::UnitZ();
    add_triangle(from + down, to + down, to + up, surface);
    add_triangle(from + down, to + up, from + up, surface);
}

void GroundBuilder::add_ceiling(std::vector<Eigen::Vector3d> corners,
                                double depth,
                                Surface surface) {
    for (Eigen::Vector3d& corner : corners)
        corner.z() -= depth;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        add_triangle(corners[0], corners[i + 1], corners[i], surface);
}

}  // namespace reprise::ground
