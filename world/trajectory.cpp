#include "world/trajectory.h"

#include <algorithm>
#include <cmath>

#include "world/check.h"
#include "world/frames.h"

namespace reprise::world {

namespace {

constexpr double slowest_heading = 0.05;  // [m/s] below it a direction of travel means nothing

}  // namespace

Trajectory::Trajectory(std::span<const PathPoint> points, bool has_headings) {
    REPRISE_CHECK(points.size() >= 2, std::to_string(points.size()) + " points");
    for (const PathPoint& point : points) {
        REPRISE_CHECK(times_.empty() || point.time() > times_.back(), std::to_string(point.time()));
        times_.push_back(point.time());
        east_.values.push_back(point.position().x());
        north_.values.push_back(point.position().y());
        up_.push_back(point.position().z());
        if (!has_headings)
            continue;
        // By the shorter turn from each to the next.
        const double last = heading_.values.empty() ? 0 : heading_.values.back();
        heading_.values.push_back(last + wrap_angle(point.heading() - last));
    }
    find_slopes(east_);
    find_slopes(north_);
    if (has_headings)
        find_slopes(heading_);
}

/// Of the parabola through three points, kept from overshooting. `end` is the first or last one.
double Trajectory::end_slope(const Curve& curve,
                             std::size_t end,
                             std::size_t next,
                             std::size_t far) const {
    const double near_time = times_[next] - times_[end];
    const double far_time = times_[far] - times_[next];
    const double near_slope = (curve.values[next] - curve.values[end]) / near_time;
    const double far_slope = (curve.values[far] - curve.values[next]) / far_time;
    const double slope =
        ((2 * near_time + far_time) * near_slope - near_time * far_slope) / (near_time + far_time);
    if (slope * near_slope <= 0)
        return 0;
    if (near_slope * far_slope <= 0 && std::abs(slope) > 3 * std::abs(near_slope))
        return 3 * near_slope;
    return slope;
}

void Trajectory::find_slopes(Curve& curve) const {
    const std::size_t last = times_.size() - 1;
    curve.slopes.assign(times_.size(), 0);
    if (last == 1) {
        const double slope = (curve.values[1] - curve.values[0]) / (times_[1] - times_[0]);
        curve.slopes = {slope, slope};
        return;
    }
    for (std::size_t i = 1; i < last; ++i) {
        const double before = times_[i] - times_[i - 1];
        const double behind = times_[i + 1] - times_[i];
        const double slope_before = (curve.values[i] - curve.values[i - 1]) / before;
        const double slope_behind = (curve.values[i + 1] - curve.values[i]) / behind;
        if (slope_before * slope_behind <= 0)
            continue;  // a turning point: flat
        const double weight_before = 2 * behind + before;
        const double weight_behind = behind + 2 * before;
        curve.slopes[i] = (weight_before + weight_behind) /
                          (weight_before / slope_before + weight_behind / slope_behind);
    }
    curve.slopes[0] = end_slope(curve, 0, 1, 2);
    curve.slopes[last] = end_slope(curve, last, last - 1, last - 2);
}

/// Hermite's cubic on the piece from point `piece` to the next.
Trajectory::Sample Trajectory::sample(const Curve& curve, std::size_t piece, double time) const {
    const double length = times_[piece + 1] - times_[piece];
    const double u = (time - times_[piece]) / length;
    const double from = curve.values[piece];
    const double way = curve.values[piece + 1] - from;
    const double from_slope = curve.slopes[piece] * length;
    const double to_slope = curve.slopes[piece + 1] * length;
    // from + from_slope u + b u^2 + a u^3
    const double a = from_slope + to_slope - 2 * way;
    const double b = 3 * way - 2 * from_slope - to_slope;
    if (u >= 1)  // exactly there, whatever the rounding of the sum
        return {
            curve.values[piece + 1], curve.slopes[piece + 1], (2 * b + 6 * a) / (length * length)};
    return {from + u * (from_slope + u * (b + u * a)),
            (from_slope + u * (2 * b + u * 3 * a)) / length,
            (2 * b + 6 * a * u) / (length * length)};
}

Trajectory::State Trajectory::at(double time) const {
    time = std::clamp(time, start(), end());
    const auto behind = std::upper_bound(times_.begin() + 1, times_.end() - 1, time);
    const auto piece = static_cast<std::size_t>(behind - times_.begin() - 1);
    const Sample east = sample(east_, piece, time);
    const Sample north = sample(north_, piece, time);
    const double share = (time - times_[piece]) / (times_[piece + 1] - times_[piece]);
    State state;
    state.position = {east.value, north.value, up_[piece] + share * (up_[piece + 1] - up_[piece])};
    state.velocity = {east.rate, north.rate};
    if (!heading_.values.empty()) {
        const Sample heading = sample(heading_, piece, time);
        state.heading = wrap_angle(heading.value);
        state.turn_rate = heading.rate;
        return state;
    }
    const double squared_speed = state.velocity.squaredNorm();
    if (squared_speed >= slowest_heading * slowest_heading) {
        state.heading = std::atan2(north.rate, east.rate);
        state.turn_rate = (east.rate * north.change - north.rate * east.change) / squared_speed;
    }
    return state;
}

std::optional<double> Trajectory::first_heading() const {
    if (const auto heading = at(start()).heading)
        return heading;
    for (std::size_t i = 1; i < times_.size(); ++i) {
        const double east = east_.values[i] - east_.values[i - 1];
        const double north = north_.values[i] - north_.values[i - 1];
        if (std::hypot(east, north) > 1e-3)
            return std::atan2(north, east);
    }
    return std::nullopt;
}

void Trajectory::add_to(Hasher& hasher) const {
    hasher.add(static_cast<std::uint64_t>(times_.size()));
    for (const std::vector<double>* numbers :
         {&times_, &east_.values, &north_.values, &up_, &heading_.values})
        hasher.add(std::span<const double>(*numbers));
}

std::uint64_t last_tick_of(std::span<const PathPoint> points, double step) {
    constexpr double rounding = 1e-9;  // [s]
    return static_cast<std::uint64_t>(
        std::max(0.0, std::floor((points.back().time() + rounding) / step)));
}

}  // namespace reprise::world
