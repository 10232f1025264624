#include "world/town.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "world/check.h"
#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::world {

namespace {

/// What curve_radius says of a straight lane. [m]
constexpr double straight_radius = 1e6;

/// Where a point falls on a segment, and how far away that is.
struct Foot {
    double share = 0;  ///< of the segment, in [0, 1]
    double squared_distance = 0;
    Eigen::Vector3d position;
};

Foot foot_on(const Vec3& from, const Vec3& to, const Eigen::Vector3d& p_world) {
    const Eigen::Vector3d start = to_eigen(from);
    const Eigen::Vector3d along = to_eigen(to) - start;
    const double squared_length = along.squaredNorm();
    const double passed = (p_world - start).dot(along);
    Foot foot;
    // Most segments are passed, or not come to: these need no division.
    if (passed > 0)
        foot.share = passed < squared_length ? passed / squared_length : 1.0;
    foot.position = start + foot.share * along;
    foot.squared_distance = (p_world - foot.position).squaredNorm();
    return foot;
}

double length_of(const LaneT& lane, std::size_t segment) {
    return (to_eigen(lane.centre[segment + 1]) - to_eigen(lane.centre[segment])).norm();
}

/// Unit vector along a segment in plan; null where it is vertical.
Eigen::Vector2d heading(const LaneT& lane, std::size_t segment) {
    const Eigen::Vector3d along =
        to_eigen(lane.centre[segment + 1]) - to_eigen(lane.centre[segment]);
    const double length = std::hypot(along.x(), along.y());
    return length > 0 ? Eigen::Vector2d(along.head<2>() / length) : Eigen::Vector2d::Zero();
}

/// Metres left of the segment's line. At a bend's outside the nearest point is the corner: there
/// the whole way to it counts, so that t does not jump from one segment to the next.
double left_of(const LaneT& lane, std::size_t segment, const Foot& foot, const Eigen::Vector3d& p) {
    const Eigen::Vector3d offset = p - foot.position;
    const auto across = [&](const Eigen::Vector2d& along) {
        return cross(along, offset.head<2>());
    };
    const Eigen::Vector2d along = heading(lane, segment);
    const double distance = std::hypot(offset.x(), offset.y());
    if (foot.share == 0 && segment > 0)
        return std::copysign(distance, across(heading(lane, segment - 1) + along));
    if (foot.share == 1 && segment + 2 < lane.centre.size())
        return std::copysign(distance, across(along + heading(lane, segment + 1)));
    return across(along);
}

}  // namespace

LanePoint point_at(const LaneT& lane, double s) {
    REPRISE_CHECK(lane.centre.size() >= 2, "lane " + lane.name);
    // Walk to the segment that holds s; the last one also takes all that lies behind its end.
    double rest = std::max(s, 0.0);
    std::size_t segment = 0;
    Eigen::Vector3d start = to_eigen(lane.centre[0]);
    Eigen::Vector3d along = to_eigen(lane.centre[1]) - start;
    double length = along.norm();
    while (rest >= length && segment + 2 < lane.centre.size()) {
        rest -= length;
        ++segment;
        start = to_eigen(lane.centre[segment]);
        along = to_eigen(lane.centre[segment + 1]) - start;
        length = along.norm();
    }
    LanePoint point;
    const double share = length > 0 ? std::min(rest / length, 1.0) : 0.0;
    point.position = start + share * along;
    point.yaw = std::atan2(along.y(), along.x());
    point.pitch = std::atan2(along.z(), std::hypot(along.x(), along.y()));
    return point;
}

LaneProjection project(const LaneT& lane, const Eigen::Vector3d& p_world) {
    REPRISE_CHECK(lane.centre.size() >= 2, "lane " + lane.name);
    Foot nearest;
    std::size_t nearest_segment = 0;
    for (std::size_t segment = 0; segment + 1 < lane.centre.size(); ++segment) {
        const Foot foot = foot_on(lane.centre[segment], lane.centre[segment + 1], p_world);
        if (segment == 0 || foot.squared_distance < nearest.squared_distance) {
            nearest = foot;
            nearest_segment = segment;
        }
    }
    double passed = 0;
    for (std::size_t segment = 0; segment < nearest_segment; ++segment)
        passed += length_of(lane, segment);
    LaneProjection projection;
    projection.s = passed + nearest.share * length_of(lane, nearest_segment);
    projection.t = left_of(lane, nearest_segment, nearest, p_world);
    projection.distance = std::sqrt(nearest.squared_distance);
    return projection;
}

std::optional<std::uint32_t> find_lane(const TownT& town, std::string_view name) {
    const auto found = std::lower_bound(
        town.lanes.begin(), town.lanes.end(), name, [](const LaneT& lane, std::string_view wanted) {
            return lane.name < wanted;
        });
    if (found == town.lanes.end() || found->name != name)
        return std::nullopt;
    return static_cast<std::uint32_t>(found - town.lanes.begin());
}

double curve_radius(const LaneT& lane, double s) {
    if (lane.centre.size() < 3)
        return straight_radius;
    // The inner point nearest to s along the line.
    std::size_t middle = 1;
    double nearest = std::numeric_limits<double>::infinity();
    double passed = 0;
    for (std::size_t i = 1; i + 1 < lane.centre.size(); ++i) {
        passed += (to_eigen(lane.centre[i]) - to_eigen(lane.centre[i - 1])).norm();
        if (std::abs(passed - s) < nearest) {
            nearest = std::abs(passed - s);
            middle = i;
        }
    }
    // Circumscribed circle in plan: R = a b c / (4 area). A hill's crest is no curve.
    const auto flat = [&](std::size_t i) { return in_plan(lane.centre[i]); };
    const Eigen::Vector2d first = flat(middle) - flat(middle - 1);
    const Eigen::Vector2d second = flat(middle + 1) - flat(middle);
    const double twice_area = std::abs(cross(first, second));
    const double sides = first.norm() * second.norm() * (first + second).norm();
    return sides < 2 * twice_area * straight_radius ? sides / (2 * twice_area) : straight_radius;
}

}  // namespace reprise::world
