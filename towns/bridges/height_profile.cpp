#include "towns/bridges/height_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace reprise::towns {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double noticed = 0.0005;  ///< [m] less is written as 0
constexpr double separate = 0.3;    ///< [m] nearer points of a line are one
constexpr double spacing = 5;       ///< [m] of points
constexpr double ending = 10;       ///< [m] from its ends a lane comes to the junction's height

}  // namespace

HeightProfile::HeightProfile(const RoadChains& roads,
                             const std::vector<double>& heights,
                             const OnChain& road) {
    const Chain& chain = roads.chains[road.chain];
    for (std::size_t i = 0; i < chain.points.size(); ++i)
        line_.emplace_back(chain.places[i].x(), chain.places[i].y(), heights[chain.points[i]]);
    if (road.reversed)
        std::reverse(line_.begin(), line_.end());
    for (std::size_t i = 0; i + 1 < line_.size(); ++i)
        length_ += (line_[i + 1] - line_[i]).head<2>().norm();
}

bool HeightProfile::is_flat() const {
    return std::all_of(
        line_.begin(), line_.end(), [](const Vector3d& p) { return std::abs(p.z()) < noticed; });
}

/// The height of the road's nearest point to a place, about at a share of its length. A road that
/// winds up over itself is near the place more than once.
double HeightProfile::beside(const Vector2d& place, double share) const {
    const double reach = 15 + 0.05 * length_;  // [m] by which lanes of one road run ahead of it
    double nearest = std::numeric_limits<double>::infinity();
    double height = line_.front().z();
    double start = 0;
    for (std::size_t i = 0; i + 1 < line_.size(); ++i) {
        const Vector2d from = line_[i].head<2>();
        const Vector2d along = line_[i + 1].head<2>() - from;
        const double length = along.norm();
        const bool is_about = std::abs(start + length / 2 - share * length_) < reach + length / 2;
        start += length;
        if (!is_about || length == 0)
            continue;
        const double part = std::clamp((place - from).dot(along) / (length * length), 0.0, 1.0);
        const double distance = (from + part * along - place).norm();
        if (distance >= nearest)
            continue;
        nearest = distance;
        height = line_[i].z() + part * (line_[i + 1].z() - line_[i].z());
    }
    return height;
}

/// Lanes end where the junction begins, at its height, which is not at the same place for all.
double HeightProfile::at(const Vector2d& place, double from_start, double length) const {
    const double height = beside(place, length > 0 ? from_start / length : 0);
    const double to_end = length - from_start;
    const Vector3d& end = from_start < to_end ? line_.front() : line_.back();
    const double weight = std::clamp(std::min(from_start, to_end) / ending, 0.0, 1.0);
    return weight * height + (1 - weight) * end.z();
}

std::vector<Vector3d> HeightProfile::lift(const world::Loop& line) const {
    const double whole = plan_length(line);
    std::vector<Vector3d> lifted;
    double start = 0;
    const auto add = [&](const Vector2d& place, double from_start) {
        lifted.emplace_back(place.x(), place.y(), at(place, from_start, whole));
    };
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vector2d along = line[i + 1] - line[i];
        const double length = along.norm();
        add(line[i], start);
        for (double s = (std::floor(start / spacing) + 1) * spacing; s < start + length - separate;
             s += spacing)
            if (s - start > separate)
                add(line[i] + along * ((s - start) / length), s);
        start += length;
    }
    add(line.back(), whole);
    return lifted;
}

double steepest(const std::vector<Vector3d>& line) {
    double most = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vector3d along = line[i + 1] - line[i];
        if (const double length = along.head<2>().norm(); length > separate)
            most = std::max(most, std::abs(along.z()) / length);
    }
    return most;
}

std::string shape_text(const std::vector<Vector3d>& line) {
    std::string text;
    for (const Vector3d& p : line) {
        text += fmt::format("{}{:.3f},{:.3f}", text.empty() ? "" : " ", p.x(), p.y());
        if (std::abs(p.z()) >= noticed)
            text += fmt::format(",{:.3f}", p.z());
    }
    // netconvert's lanes of no length begin and end at one place.
    return line.size() == 1 ? text + " " + text : text;
}

}  // namespace reprise::towns
