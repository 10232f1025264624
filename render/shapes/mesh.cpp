#include "render/shapes/mesh.h"

#include <cmath>
#include <map>
#include <numbers>

#include "world/check.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

Vector3f area_normal(const Mesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
    const Vector3f& a = mesh.vertices[triangle[0]];
    return (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
}

/// Corners of the unit circle: a town has a thousand circles of a dozen numbers of corners.
const std::vector<Eigen::Vector2f>& unit_circle(int sides) {
    thread_local std::map<int, std::vector<Eigen::Vector2f>> circles;
    std::vector<Eigen::Vector2f>& corners = circles[sides];
    for (int i = static_cast<int>(corners.size()); i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        corners.emplace_back(static_cast<float>(std::cos(angle)),
                             static_cast<float>(std::sin(angle)));
    }
    return corners;
}

/// Points on a circle around `centre` spanned by two radii.
std::vector<Vector3f> circle(const Vector3f& centre,
                             const Vector3f& u,
                             const Vector3f& v,
                             int sides) {
    std::vector<Vector3f> points;
    points.reserve(static_cast<std::size_t>(sides));
    for (const Eigen::Vector2f& corner : unit_circle(sides))
        points.emplace_back(centre + corner.x() * u + corner.y() * v);
    return points;
}

}  // namespace

std::uint32_t add_vertex(Mesh& mesh, const Vector3f& position) {
    mesh.vertices.push_back(position);
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, Finish finish) {
    mesh.triangles.push_back({a, b, c});
    mesh.materials.push_back(finish.material);
    mesh.tags.push_back(finish.tag);
}

void add_quad(Mesh& mesh, const std::array<Vector3f, 4>& corners, Finish finish) {
    const std::uint32_t first = add_vertex(mesh, corners[0]);
    for (std::size_t i = 1; i < 4; ++i)
        add_vertex(mesh, corners[i]);
    add_triangle(mesh, first, first + 1, first + 2, finish);
    add_triangle(mesh, first, first + 2, first + 3, finish);
}

void add_box(Mesh& mesh,
             const Eigen::Isometry3f& pose,
             const Vector3f& half,
             Finish finish,
             unsigned without) {
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0F, 1.0F}) {
            if ((without >> (2 * axis + (side > 0 ? 1 : 0)) & 1U) != 0)
                continue;
            Vector3f out = Vector3f::Zero();
            Vector3f u = Vector3f::Zero();
            Vector3f v = Vector3f::Zero();
            out[axis] = side * half[axis];
            u[(axis + 1) % 3] = side * half[(axis + 1) % 3];
            v[(axis + 2) % 3] = half[(axis + 2) % 3];
            add_quad(mesh,
                     {pose * Vector3f(out - u - v),
                      pose * Vector3f(out + u - v),
                      pose * Vector3f(out + u + v),
                      pose * Vector3f(out - u + v)},
                     finish);
        }
    }
}

void add_tube(Mesh& mesh, const Tube& tube, Finish finish) {
    const Vector3f axis = (tube.to - tube.from).normalized();
    const Vector3f u = axis.unitOrthogonal();
    const Vector3f v = axis.cross(u);
    add_loft(mesh,
             {std::vector<Vector3f>(static_cast<std::size_t>(tube.sides), tube.from),
              circle(tube.from, tube.radius_from * u, tube.radius_from * v, tube.sides),
              circle(tube.to, tube.radius_to * u, tube.radius_to * v, tube.sides),
              std::vector<Vector3f>(static_cast<std::size_t>(tube.sides), tube.to)},
             true,
             finish);
}

void add_loft(Mesh& mesh,
              const std::vector<std::vector<Vector3f>>& rings,
              bool closed,
              Finish finish) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::vector<Vector3f>& ring : rings)
        for (const Vector3f& point : ring)
            add_vertex(mesh, point);
    const auto size = static_cast<std::uint32_t>(rings.front().size());
    for (std::uint32_t i = 0; i + 1 < rings.size(); ++i) {
        for (std::uint32_t j = 0; j + (closed ? 0 : 1) < size; ++j) {
            const std::uint32_t next = (j + 1) % size;
            const std::uint32_t low = first + i * size;
            const std::uint32_t high = low + size;
            add_triangle(mesh, low + j, low + next, high + next, finish);
            add_triangle(mesh, low + j, high + next, high + j, finish);
        }
    }
}

void add_ellipsoid(
    Mesh& mesh, const Vector3f& centre, const Vector3f& radii, int segments, Finish finish) {
    std::vector<std::vector<Vector3f>> rings;
    const int rows = segments / 2;
    for (int i = 0; i <= rows; ++i) {
        const double polar = std::numbers::pi * i / rows - std::numbers::pi / 2;
        const auto wide = static_cast<float>(i == 0 || i == rows ? 0.0 : std::cos(polar));
        const Vector3f level =
            centre + Vector3f(0, 0, radii.z() * static_cast<float>(std::sin(polar)));
        rings.push_back(circle(
            level, Vector3f(wide * radii.x(), 0, 0), Vector3f(0, wide * radii.y(), 0), segments));
    }
    add_loft(mesh, rings, true, finish);
}

void smooth(Mesh& mesh, double crease) {
    const std::size_t count = mesh.triangles.size();
    std::vector<Vector3f> normals;  // of triangles, as long as these are large
    std::vector<Vector3f> units;
    normals.reserve(count);
    units.reserve(count);
    // Of vertex v: around[begin[v]] to around[begin[v + 1]], ascending.
    std::vector<std::uint32_t> begin(mesh.vertices.size() + 2, 0);
    for (const auto& triangle : mesh.triangles) {
        normals.push_back(area_normal(mesh, triangle));
        units.push_back(normals.back().normalized());
        for (const std::uint32_t corner : triangle)
            ++begin[corner + 2];
    }
    for (std::size_t v = 2; v < begin.size(); ++v)
        begin[v] += begin[v - 1];
    std::vector<std::uint32_t> around(3 * count);
    for (std::uint32_t i = 0; i < count; ++i)
        for (const std::uint32_t corner : mesh.triangles[i])
            around[begin[corner + 1]++] = i;

    const auto least_cosine = static_cast<float>(std::cos(crease));
    mesh.normals.assign(count, {});
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = mesh.triangles[i][corner];
            Vector3f sum = normals[i];
            bool alone = true;
            for (std::uint32_t k = begin[vertex]; k < begin[vertex + 1]; ++k) {
                const std::uint32_t other = around[k];
                if (other != i && units[other].dot(units[i]) > least_cosine) {
                    sum += normals[other];
                    alone = false;
                }
            }
            mesh.normals[i][corner] = alone ? units[i] : sum.normalized();
        }
}

void append(Mesh& mesh, const Mesh& part) {
    REPRISE_CHECK(mesh.normals.empty() && part.normals.empty(), "flat meshes only");
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
    for (const auto& [a, b, c] : part.triangles)
        mesh.triangles.push_back({first + a, first + b, first + c});
    mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
    mesh.tags.insert(mesh.tags.end(), part.tags.begin(), part.tags.end());
}

void drop_degenerate(Mesh& mesh) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const Vector3f normal = area_normal(mesh, mesh.triangles[i]);
        // Not a comparison with zero: slivers below a square of 10 um are as useless. NaN fails
        // too.
        if (!(normal.norm() > 1e-10F) || !normal.allFinite())
            continue;
        mesh.triangles[kept] = mesh.triangles[i];
        mesh.materials[kept] = mesh.materials[i];
        mesh.tags[kept] = mesh.tags[i];
        if (!mesh.normals.empty())
            mesh.normals[kept] = mesh.normals[i];
        ++kept;
    }
    mesh.triangles.resize(kept);
    mesh.materials.resize(kept);
    mesh.tags.resize(kept);
    if (!mesh.normals.empty())
        mesh.normals.resize(kept);
}

}  // namespace reprise::render
