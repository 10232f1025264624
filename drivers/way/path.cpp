#include "drivers/way/path.h"

#include <algorithm>
#include <cmath>

#include "world/frames.h"

namespace reprise::drivers {

namespace {

// [samples] to both sides: headings of a polyline jump at its corners; a car's must not.
constexpr std::size_t heading_window = 2;
// Longer, because SUMO draws bends with corners some metres apart: taken by themselves these would
// look like hairpins.
constexpr std::size_t curvature_window = 6;
constexpr std::size_t car_window = 3;

}  // namespace

void Path::clear() {
    points_.clear();
    first_ = 0;
    end_ = rest_ = 0;
}

void Path::append(std::span<const Eigen::Vector3d> polyline, double limit) {
    if (polyline.empty())
        return;
    if (points_.empty()) {
        points_.push_back({polyline.front(), {1, 0}, 0, 0, limit, 0});
        tail_ = polyline.front();
    }
    for (const Eigen::Vector3d& next : polyline) {
        const double length = (next - tail_).norm();
        if (length < 1e-6)
            continue;
        double along = spacing - rest_;
        for (; along <= length; along += spacing)
            points_.push_back({tail_ + (next - tail_) * (along / length), {1, 0}, 0, 0, limit, 0});
        rest_ = length - (along - spacing);
        tail_ = next;
        end_ = s_of(points_.size() - 1) + rest_;
    }
}

void Path::finish(const PathComfort& comfort) {
    const std::size_t count = points_.size();
    if (count < 2)
        return;
    // Headings: over a short chord, unwrapped along the path.
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t back = i - std::min(i, heading_window);
        const std::size_t ahead = std::min(i + heading_window, count - 1);
        const Eigen::Vector2d chord = (points_[ahead].position - points_[back].position).head<2>();
        const double norm = chord.norm();
        if (norm > 1e-9)
            points_[i].direction = chord / norm;
        else if (i > 0)
            points_[i].direction = points_[i - 1].direction;
        const double yaw = std::atan2(points_[i].direction.y(), points_[i].direction.x());
        points_[i].yaw =
            i == 0 ? yaw : points_[i - 1].yaw + world::wrap_angle(yaw - points_[i - 1].yaw);
    }
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t back = i - std::min(i, curvature_window);
        const std::size_t ahead = std::min(i + curvature_window, count - 1);
        points_[i].curvature = (points_[ahead].yaw - points_[back].yaw) /
                               (static_cast<double>(ahead - back) * spacing);
    }
    // Envelope: what lanes and curves allow, then backwards what can be braked to in comfort.
    double next = points_.back().limit * points_.back().limit;
    for (std::size_t i = count; i-- > 0;) {
        PathPoint& point = points_[i];
        // The car is not a point: the bend that its ends are in counts, too.
        const double sharpest =
            std::max({std::abs(point.curvature),
                      std::abs(points_[i - std::min(i, car_window)].curvature),
                      std::abs(points_[std::min(i + car_window, count - 1)].curvature)});
        const double curve = comfort.lateral_acceleration / std::max(sharpest, 1e-6);
        next =
            std::min({point.limit * point.limit, curve, next + 2 * comfort.deceleration * spacing});
        point.squared_speed = next;
    }
}

void Path::drop_before(double s) {
    const std::size_t count = index(s);
    points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(count));
    first_ += count;
}

std::size_t Path::index(double s) const {
    const double steps = (s - start()) / spacing;
    if (steps <= 0 || points_.empty())
        return 0;
    return std::min(static_cast<std::size_t>(steps), points_.size() - 1);
}

PathPoint Path::at(double s) const {
    const std::size_t i = index(s);
    if (i + 1 >= points_.size())
        return points_.back();
    const PathPoint& source = points_[i];
    const PathPoint& target = points_[i + 1];
    const double share = std::clamp((s - s_of(i)) / spacing, 0.0, 1.0);
    const auto mix = [share](const auto& a, const auto& b) { return a + (b - a) * share; };
    PathPoint point = source;
    point.position = source.position + (target.position - source.position) * share;
    point.yaw = mix(source.yaw, target.yaw);
    point.direction = {std::cos(point.yaw), std::sin(point.yaw)};
    point.curvature = mix(source.curvature, target.curvature);
    point.squared_speed = mix(source.squared_speed, target.squared_speed);
    return point;
}

double Path::curvature(double s, double reach) const {
    const std::size_t back = index(s - reach);
    const std::size_t ahead = index(s + reach + spacing);
    if (ahead <= back)
        return 0;
    return (points_[ahead].yaw - points_[back].yaw) / (static_cast<double>(ahead - back) * spacing);
}

double Path::climb(double s, double reach) const {
    const Eigen::Vector3d along = at(s + reach).position - at(s - reach).position;
    const double length = along.norm();
    return length > 0 ? along.z() / length : 0;
}

double Path::project(const Eigen::Vector3d& p_world, double from, double reach) const {
    const Eigen::Vector2d p = p_world.head<2>();
    const std::size_t first = index(from);
    const std::size_t last = index(from + reach);
    const double bound = least_sample(p, first, last);
    double best = from;
    double least = INFINITY;
    for (std::size_t i = first; i <= last && i + 1 < points_.size();) {
        const Eigen::Vector2d start_point = points_[i].position.head<2>();
        const Eigen::Vector2d step = points_[i + 1].position.head<2>() - start_point;
        const Eigen::Vector2d offset = p - start_point;
        const double square = std::max(step.squaredNorm(), 1e-12);
        const double share = std::clamp(offset.dot(step) / square, 0.0, 1.0);
        const double distance = (offset - share * step).squaredNorm();
        if (distance < least) {
            least = distance;
            best = s_of(i) + share * spacing;
        }
        // Samples are no more than `spacing` apart: those next to one that is far away are far,
        // too.
        const double passed = (offset.norm() - bound) / spacing;
        i += passed > 2 ? static_cast<std::size_t>(passed) : 1;
    }
    return std::max(best, from);
}

/// [m] that nothing nearest to p is farther away than, by one sample of many; infinity where the
/// stretch is so short that to look at all of them costs less.
double Path::least_sample(const Eigen::Vector2d& p, std::size_t first, std::size_t last) const {
    constexpr std::size_t stride = 16;
    constexpr double rounding = 1e-3;  // [m] more than is lost to it
    if (last < first + 2 * stride)
        return INFINITY;
    double least = INFINITY;
    for (std::size_t i = first; i <= last; i += stride)
        least = std::min(least, (points_[i].position.head<2>() - p).squaredNorm());
    return std::sqrt(least) + rounding;
}

void Path::add_to(world::Hasher& hasher) const {
    static_assert(sizeof(PathPoint) == 9 * sizeof(double), "no padding");
    hasher.add(std::uint64_t{first_});
    hasher.add(std::uint64_t{points_.size()});
    hasher.add_bytes(points_.data(), points_.size() * sizeof(PathPoint));
    for (const double number : {end_, rest_, tail_.x(), tail_.y(), tail_.z()})
        hasher.add(number);
}

}  // namespace reprise::drivers
