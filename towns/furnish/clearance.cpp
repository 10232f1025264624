#include "towns/furnish/clearance.h"

#include <algorithm>
#include <cmath>

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using world::Box;

constexpr double cell_size = 8;
constexpr double overlap = -1e-3;  // any negative number does

std::int32_t cell_of(double coordinate) {
    return static_cast<std::int32_t>(std::floor(coordinate / cell_size));
}

/// Visits the keys of all cells that a box touches, row by row.
template <typename Visit>
void for_each_cell(const Box& box, Visit&& visit) {
    for (std::int32_t x = cell_of(box.low.x()); x <= cell_of(box.high.x()); ++x)
        for (std::int32_t y = cell_of(box.low.y()); y <= cell_of(box.high.y()); ++y)
            visit(std::uint64_t{static_cast<std::uint32_t>(x)} << 32 |
                  static_cast<std::uint32_t>(y));
}

/// Distance of a segment from the rectangle |x| <= half.x, |y| <= half.y; 0 when they meet.
double distance_to_box(const Vector2d& from, const Vector2d& to, const Vector2d& half) {
    // Does it cross? Clip the segment to the box (Liang and Barsky, 1984).
    const Vector2d along = to - from;
    double enter = 0;
    double leave = 1;
    for (int axis = 0; axis < 2; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const double towards = side * along[axis];
            const double room = half[axis] - side * from[axis];
            if (towards == 0 && room < 0)
                leave = -1;
            else if (towards > 0)
                leave = std::min(leave, room / towards);
            else if (towards < 0)
                enter = std::max(enter, room / towards);
        }
    }
    if (enter <= leave)
        return 0;
    // Apart: the nearest pair holds an end of the segment or a corner of the box.
    auto from_box = [&half](const Vector2d& p) {
        return (p.cwiseAbs() - half).cwiseMax(0.0).norm();
    };
    double nearest = std::min(from_box(from), from_box(to));
    const double squared = along.squaredNorm();
    for (const double x : {-half.x(), half.x()})
        for (const double y : {-half.y(), half.y()}) {
            const Vector2d corner(x, y);
            const double t =
                squared > 0 ? std::clamp((corner - from).dot(along) / squared, 0.0, 1.0) : 0;
            nearest = std::min(nearest, (from + t * along - corner).norm());
        }
    return nearest;
}

}  // namespace

world::Loop corners(const Footprint& footprint) {
    const Vector2d along = world::ahead_of(footprint.yaw);
    const Vector2d x = along * (footprint.length / 2);
    const Vector2d y = world::turned_left(along) * (footprint.width / 2);
    const Vector2d& c = footprint.centre;
    return {c - x - y, c + x - y, c + x + y, c - x + y};
}

void Clearance::add_segment(const Segment& segment) {
    const auto index = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back(segment);
    Box box;
    box.take(segment.from, segment.half_width);
    box.take(segment.to, segment.half_width);
    for_each_cell(box, [&](std::uint64_t cell) { cells_[cell].segments.push_back(index); });
}

void Clearance::add_line(const std::vector<world::Vec3>& line, double half_width) {
    for (std::size_t i = 1; i < line.size(); ++i)
        add_segment({world::in_plan(line[i - 1]), world::in_plan(line[i]), half_width});
}

void Clearance::add_polygon(const world::Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i)
        add_segment({loop[i], loop[(i + 1) % loop.size()], 0});
    if (loop.size() < 3)
        return;
    const auto index = static_cast<std::uint32_t>(loops_.size());
    loops_.push_back(loop);
    for_each_cell(world::box_around(loop),
                  [&](std::uint64_t cell) { cells_[cell].loops.push_back(index); });
}

void Clearance::add_polygon(const std::vector<world::Vec3>& outline) {
    add_polygon(world::in_plan(outline));
}

void Clearance::add_point(const Vector2d& point, double radius) {
    add_segment({point, point, radius});
}

double Clearance::nearest(const Footprint& footprint, double reach, double enough) const {
    const double cosine = std::cos(footprint.yaw);
    const double sine = std::sin(footprint.yaw);
    const Vector2d half(footprint.length / 2, footprint.width / 2);
    auto to_box = [&](const Vector2d& p) {
        const Vector2d d = p - footprint.centre;
        return Vector2d(cosine * d.x() + sine * d.y(), cosine * d.y() - sine * d.x());
    };
    double nearest = reach;
    Box box;
    for (const Vector2d& corner : corners(footprint))
        box.take(corner, reach);
    for_each_cell(box, [&](std::uint64_t key) {
        const auto cell = cells_.find(key);
        if (cell == cells_.end() || nearest < enough)
            return;
        for (const std::uint32_t index : cell->second.segments) {
            const Segment& s = segments_[index];
            const Vector2d low = s.from.cwiseMin(s.to) - Vector2d::Constant(s.half_width);
            const Vector2d high = s.from.cwiseMax(s.to) + Vector2d::Constant(s.half_width);
            if ((low.array() > box.high.array()).any() || (high.array() < box.low.array()).any())
                continue;
            const double apart = distance_to_box(to_box(s.from), to_box(s.to), half);
            nearest = std::min(nearest, apart > 0 ? apart - s.half_width : overlap - s.half_width);
        }
    });
    // A footprint that no border touches is inside of a polygon, or outside, with its middle.
    Box middle;
    middle.take(footprint.centre);
    for_each_cell(middle, [&](std::uint64_t key) {
        const auto cell = cells_.find(key);
        if (cell == cells_.end())
            return;
        for (const std::uint32_t index : cell->second.loops)
            if (world::contains(loops_[index], footprint.centre))
                nearest = std::min(nearest, overlap);
    });
    return nearest;
}

}  // namespace reprise::towns
