#include "ground/mesh/triangulation.h"

#include <cmath>
#include <cstdint>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

#include "world/geometry2d.h"

namespace reprise::ground {

namespace {

__extension__ using Wide = __int128;
using Point = CGAL::Simple_cartesian<double>::Point_2;

/// A whole-numbered vector. Exact below 2^29, which is 500 km in millimetres.
struct Step {
    Step(const Point& from, const Point& to)
        : x(std::llround(to.x() - from.x())),
          y(std::llround(to.y() - from.y())) {}

    Wide squared() const { return Wide(x) * x + Wide(y) * y; }

    std::int64_t x;
    std::int64_t y;
};

Wide cross(const Step& one, const Step& other) {
    return Wide(one.x) * other.y - Wide(one.y) * other.x;
}

CGAL::Sign sign(const Wide& number) {
    return number > 0 ? CGAL::POSITIVE : number < 0 ? CGAL::NEGATIVE : CGAL::ZERO;
}

/// CGAL's own exact kernels change the processor's rounding mode, which nothing in a step may do.
/// Corners are whole numbers, so that its two questions can be answered in whole numbers.
struct Kernel : CGAL::Simple_cartesian<double> {
    struct Orientation_2 {
        CGAL::Orientation operator()(const Point& p, const Point& q, const Point& r) const {
            return sign(cross(Step(p, q), Step(p, r)));
        }
    };

    /// Of s and the circle through p, q, r: the determinant of their lifted vectors from s.
    struct Side_of_oriented_circle_2 {
        CGAL::Oriented_side operator()(const Point& p,
                                       const Point& q,
                                       const Point& r,
                                       const Point& s) const {
            const Step one(s, p);
            const Step two(s, q);
            const Step three(s, r);
            return sign(one.squared() * cross(two, three) - two.squared() * cross(one, three) +
                        three.squared() * cross(one, two));
        }
    };

    Orientation_2 orientation_2_object() const { return {}; }

    Side_of_oriented_circle_2 side_of_oriented_circle_2_object() const { return {}; }
};

/// Whether a face lies inside; not known at first.
enum class Location { unknown, outside, inside };

using Vertices = CGAL::Triangulation_vertex_base_2<Kernel>;
using Faces = CGAL::Constrained_triangulation_face_base_2<
    Kernel,
    CGAL::Triangulation_face_base_with_info_2<Location, Kernel>>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<Vertices, Faces>,
    CGAL::Exact_predicates_tag>;

/// From the outside inwards: whoever crosses a border changes sides.
void find_sides(Triangulation& triangulation) {
    for (const auto face : triangulation.all_face_handles())
        face->info() = Location::unknown;
    triangulation.infinite_face()->info() = Location::outside;
    std::vector<Triangulation::Face_handle> open{triangulation.infinite_face()};
    while (!open.empty()) {
        const Triangulation::Face_handle face = open.back();
        open.pop_back();
        for (int i = 0; i < 3; ++i) {
            const Triangulation::Face_handle next = face->neighbor(i);
            if (next->info() != Location::unknown)
                continue;
            const bool crosses = face->is_constrained(i);
            next->info() = (face->info() == Location::inside) != crosses ? Location::inside
                                                                         : Location::outside;
            open.push_back(next);
        }
    }
}

}  // namespace

std::vector<std::array<Eigen::Vector2d, 3>> triangulate(const std::vector<world::Loop>& borders) {
    Triangulation triangulation;
    for (const world::Loop& border : borders) {
        if (border.size() < 3)
            continue;
        Triangulation::Vertex_handle first = triangulation.insert({border[0].x(), border[0].y()});
        Triangulation::Vertex_handle last = first;
        for (std::size_t i = 1; i < border.size(); ++i) {
            const Triangulation::Vertex_handle next =
                triangulation.insert({border[i].x(), border[i].y()});
            if (next != last)
                triangulation.insert_constraint(last, next);
            last = next;
        }
        if (last != first)
            triangulation.insert_constraint(last, first);
    }
    if (triangulation.dimension() < 2)
        return {};
    find_sides(triangulation);
    std::vector<std::array<Eigen::Vector2d, 3>> triangles;
    for (const auto face : triangulation.finite_face_handles()) {
        if (face->info() != Location::inside)
            continue;
        std::array<Eigen::Vector2d, 3> triangle;
        for (int i = 0; i < 3; ++i) {
            const Kernel::Point_2& p = face->vertex(i)->point();
            triangle[static_cast<std::size_t>(i)] = {p.x(), p.y()};
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

}  // namespace reprise::ground
