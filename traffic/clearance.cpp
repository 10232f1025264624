#include "traffic/clearance.h"

#include <algorithm>
#include <cmath>

namespace reprise::traffic {

namespace {

constexpr double cell_size = 24;

std::int32_t cell_of(double coordinate) {
    return static_cast<std::int32_t>(std::floor(coordinate / cell_size));
}

/// Distance of a segment from the rectangle |x| <= half.x, |y| <= half.y; 0 when they meet.
double distance_to_box(const Eigen::Vector2d& from,
                       const Eigen::Vector2d& to,
                       const Eigen::Vector2d& half) {
    // Does it cross? Clip the segment to the box (Liang and Barsky, 1984).
    const Eigen::Vector2d along = to - from;
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
    auto from_box = [&half](const Eigen::Vector2d& p) {
        return (p.cwiseAbs() - half).cwiseMax(0.0).norm();
    };
    double nearest = std::min(from_box(from), from_box(to));
    for (const double x : {-half.x(), half.x()})
        for (const double y : {-half.y(), half.y()}) {
            const Eigen::Vector2d corner(x, y);
            const double squared = along.squaredNorm();
            const double t =
                squared > 0 ? std::clamp((corner - from).dot(along) / squared, 0.0, 1.0) : 0;
            nearest = std::min(nearest, (from + t * along - corner).norm());
        }
    return nearest;
}

Eigen::Vector2d flat(const world::Vec3& p) {
    return {p.x(), p.y()};
}

}  // namespace

void Clearance::add_segment(const Segment& segment) {
    const auto index = static_cast<std::uint32_t>(segments_.size());
    segments_.push_back(segment);
    const Eigen::Vector2d margin = Eigen::Vector2d::Constant(segment.half_width);
    const Eigen::Vector2d low = segment.from.cwiseMin(segment.to) - margin;
    const Eigen::Vector2d high = segment.from.cwiseMax(segment.to) + margin;
    for (std::int32_t x = cell_of(low.x()); x <= cell_of(high.x()); ++x)
        for (std::int32_t y = cell_of(low.y()); y <= cell_of(high.y()); ++y)
            cells_[{x, y}].push_back(index);
}

void Clearance::add_line(const std::vector<world::Vec3>& line, double half_width) {
    for (std::size_t i = 1; i < line.size(); ++i)
        add_segment({flat(line[i - 1]), flat(line[i]), half_width});
}

void Clearance::add_polygon(const std::vector<world::Vec3>& outline) {
    for (std::size_t i = 0; i < outline.size(); ++i)
        add_segment({flat(outline[i]), flat(outline[(i + 1) % outline.size()]), 0});
    // The inside as a fan of spokes would leave gaps; horizontal strips fill any polygon, simple or
    // not, by the even-odd rule.
    constexpr double strip = 3;
    if (outline.size() < 3)
        return;
    double low = outline.front().y();
    double high = low;
    for (const world::Vec3& p : outline) {
        low = std::min(low, p.y());
        high = std::max(high, p.y());
    }
    for (double y = low + strip / 2; y < high; y += strip) {
        std::vector<double> crossings;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const world::Vec3& p = outline[i];
            const world::Vec3& q = outline[(i + 1) % outline.size()];
            if ((p.y() <= y) != (q.y() <= y))
                crossings.push_back(p.x() + (q.x() - p.x()) * (y - p.y()) / (q.y() - p.y()));
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
            add_segment({{crossings[i], y}, {crossings[i + 1], y}, 0});
    }
}

void Clearance::add_footprint(const Footprint& footprint) {
    // The middle line, as thick as the shorter side: caps reach beyond the ends a little, which
    // errs to the safe side.
    const bool lengthwise = footprint.length >= footprint.width;
    const double longer = std::max(footprint.length, footprint.width);
    const double shorter = std::min(footprint.length, footprint.width);
    const double yaw = footprint.yaw + (lengthwise ? 0 : std::acos(0.0));
    const Eigen::Vector2d half = Eigen::Vector2d(std::cos(yaw), std::sin(yaw)) * (longer / 2);
    add_segment({footprint.centre - half, footprint.centre + half, shorter / 2});
}

double Clearance::of(const Footprint& footprint) const {
    const double cosine = std::cos(footprint.yaw);
    const double sine = std::sin(footprint.yaw);
    const Eigen::Vector2d half(footprint.length / 2, footprint.width / 2);
    const double radius = half.norm() + reach_;
    auto to_box = [&](const Eigen::Vector2d& p) {
        const Eigen::Vector2d d = p - footprint.centre;
        return Eigen::Vector2d(cosine * d.x() + sine * d.y(), cosine * d.y() - sine * d.x());
    };
    double nearest = reach_;
    const Eigen::Vector2d& c = footprint.centre;
    for (std::int32_t x = cell_of(c.x() - radius); x <= cell_of(c.x() + radius); ++x)
        for (std::int32_t y = cell_of(c.y() - radius); y <= cell_of(c.y() + radius); ++y) {
            const auto cell = cells_.find({x, y});
            if (cell == cells_.end())
                continue;
            for (const std::uint32_t index : cell->second) {
                const Segment& segment = segments_[index];
                const double apart =
                    distance_to_box(to_box(segment.from), to_box(segment.to), half);
                nearest = std::min(nearest, apart - segment.half_width);
            }
        }
    return nearest;
}

}  // namespace reprise::traffic
