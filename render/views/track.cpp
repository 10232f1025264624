#include "render/views/track.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "world/check.h"
#include "world/frames.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

// Standard deviations. [s] Places less than angles: the actor stays where it is in the picture, and
// the camera swings around it at ease.
constexpr double place_deviation = 0.25;
constexpr double angle_deviation = 0.45;
constexpr double deviations = 3;       // that a mean reaches to both sides
constexpr double jump = 4;             // [m] in one tick: 80 m/s
constexpr double steepest_look = 0.4;  // [rad]

/// Nose up of a pose; of a vehicle that stands on its nose, no more than one can look along.
double pitch_of(const Eigen::Isometry3d& pose) {
    return std::clamp(
        std::asin(std::clamp(pose.linear()(2, 0), -1.0, 1.0)), -steepest_look, steepest_look);
}

}  // namespace

std::size_t Track::index(std::uint64_t tick) const {
    return static_cast<std::size_t>(std::clamp(tick, first, last()) - first);
}

Eigen::Isometry3d Heading::pose() const {
    return world::pose(world::to_vec3(position), yaw, pitch);
}

SmoothTrack::SmoothTrack(Track track) : track_(std::move(track)) {
    const std::size_t count = track_.poses.size();
    REPRISE_CHECK(count > 0, "a track of nothing");
    std::vector<bool> begins(count, false);
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Isometry3d& pose = track_.poses[i];
        const Vector3d p = pose.translation();
        begins[i] = i == 0 || (p - track_.poses[i - 1].translation()).norm() > jump;
        x_.push_back(p.x());
        y_.push_back(p.y());
        z_.push_back(p.z());
        const double yaw = std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
        yaw_.push_back(begins[i] ? yaw : yaw_.back() + world::wrap_angle(yaw - yaw_.back()));
        pitch_.push_back(pitch_of(pose));
        piece_first_.push_back(begins[i] ? i : piece_first_.back());
    }
    piece_last_.assign(count, count - 1);
    for (std::size_t i = count - 1; i > 0; --i)
        piece_last_[i - 1] = begins[i] ? i - 1 : piece_last_[i];
}

std::size_t SmoothTrack::ticks(double seconds) const {
    return static_cast<std::size_t>(std::lround(seconds / track_.step));
}

SmoothTrack::Span SmoothTrack::around(std::size_t index, std::size_t reach, bool even) const {
    std::size_t before = std::min(reach, index - piece_first_[index]);
    std::size_t behind = std::min(reach, piece_last_[index] - index);
    if (even)
        before = behind = std::min(before, behind);
    return {index - before, index + behind};
}

double SmoothTrack::mean_of(std::size_t index,
                            double deviation,
                            const std::vector<double>& values) const {
    const double width = deviation / track_.step;  // [ticks]
    const Span span = around(index, ticks(deviations * deviation), true);
    double sum = 0;
    double weights = 0;
    for (std::size_t i = span.first; i <= span.last; ++i) {
        const double away = (static_cast<double>(i) - static_cast<double>(index)) / width;
        const double weight = std::exp(-away * away / 2);
        sum += weight * (values[i] - values[index]);
        weights += weight;
    }
    return values[index] + sum / weights;
}

Heading SmoothTrack::at(std::uint64_t tick) const {
    const std::size_t index = track_.index(tick);
    return {{mean_of(index, place_deviation, x_),
             mean_of(index, place_deviation, y_),
             mean_of(index, place_deviation, z_)},
            mean_of(index, angle_deviation, yaw_),
            mean_of(index, angle_deviation, pitch_)};
}

}  // namespace reprise::render
