#include "render/views/preset_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace reprise::render {

namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

constexpr double chase_axis = 11.7;  // [m] how far ahead of a chasing camera it looks
constexpr double lift = 3;           // [m] a camera rises by this when it must come all the way
constexpr double top_height = 55;    // [m]
constexpr double orbit_time = 24;    // [s] once around
constexpr double share_reach = 1;    // [s] ahead of and behind a narrow place

double fov_of(Preset preset) {
    switch (preset) {
        case Preset::chase:
            return 75 * degree;
        case Preset::top:
            return 60 * degree;
        case Preset::driver:
            return 80 * degree;
        case Preset::orbit:
            return 60 * degree;
    }
    return 0;
}

/// Turned so that it looks from one point to another.
void aim(world::SensorSpec& sensor, const Vector3d& from, const Vector3d& to) {
    const Vector3d way = to - from;
    sensor.position = from;
    sensor.yaw = std::atan2(way.y(), way.x());
    sensor.pitch = std::atan2(way.z(), way.head<2>().norm());
}

}  // namespace

PresetCamera::PresetCamera(const PresetWish& wish, Track track, const world::TownT& town)
    : wish_(wish),
      track_(std::move(track)),
      clear_shares_(track_.track().poses.size(), -1) {
    if (wish_.preset == Preset::chase || wish_.preset == Preset::orbit)
        sight_.emplace(town);
}

Vector3d PresetCamera::focus(const Heading& heading) const {
    const world::Extent& extent = track_.track().extent;
    return heading.pose() * Vector3d(extent.middle(), 0, extent.height);
}

PresetCamera::Look PresetCamera::chase(const Heading& heading, double share) const {
    const world::Viewpoint behind = world::chase(track_.track().extent);
    Vector3d place = behind.place;
    const Vector3d axis(std::cos(behind.pitch), 0, std::sin(behind.pitch));
    const Vector3d seen = place + chase_axis * axis;
    if (wish_.distance)
        place = seen - (*wish_.distance + seen.x() - track_.track().extent.rear) * axis;
    const Vector3d middle = focus(heading);
    const Vector3d from = middle + share * (heading.pose() * place - middle);
    return {from + Vector3d(0, 0, (1 - share) * lift), heading.pose() * seen};
}

PresetCamera::Look PresetCamera::orbit(const Heading& heading,
                                       std::uint64_t tick,
                                       double share) const {
    const world::Extent& extent = track_.track().extent;
    const double radius = wish_.distance.value_or(4 + 1.1 * (extent.front - extent.rear));
    const double turn = 2 * std::numbers::pi / orbit_time * track_.track().step;
    const double angle = turn * static_cast<double>(tick);
    const Vector3d middle = focus(heading);
    const Vector3d out(std::cos(angle), std::sin(angle), 0.25);
    const Vector3d from = middle + share * radius * out;
    return {from + Vector3d(0, 0, (1 - share) * lift), middle - Vector3d(0, 0, extent.height / 2)};
}

PresetCamera::Look PresetCamera::look(std::uint64_t tick, double share) const {
    const Heading heading = track_.at(tick);
    return wish_.preset == Preset::chase ? chase(heading, share) : orbit(heading, tick, share);
}

double PresetCamera::clear_share(std::size_t index) const {
    if (clear_shares_[index] < 0) {
        const std::uint64_t tick = track_.track().first + index;
        clear_shares_[index] = sight_->share(focus(track_.at(tick)), look(tick, 1).from);
    }
    return clear_shares_[index];
}

/// The mean of the smallest around is nowhere more than what is clear there.
double PresetCamera::gentle_share(std::uint64_t tick) const {
    const std::size_t reach = track_.ticks(share_reach);
    const SmoothTrack::Span mean = track_.around(track_.track().index(tick), reach, false);
    double sum = 0;
    for (std::size_t i = mean.first; i <= mean.last; ++i) {
        const SmoothTrack::Span near = track_.around(i, reach, false);
        double least = 1;
        for (std::size_t j = near.first; j <= near.last; ++j)
            least = std::min(least, clear_share(j));
        sum += least;
    }
    return sum / static_cast<double>(mean.last - mean.first + 1);
}

world::SensorSpec PresetCamera::at(std::uint64_t tick, world::SensorSpec sensor) const {
    sensor.actor = 0;
    sensor.fov = wish_.fov.value_or(fov_of(wish_.preset));
    const Heading heading = track_.at(tick);
    switch (wish_.preset) {
        case Preset::driver:
            sensor.actor = track_.track().actor;
            sensor.position = track_.track().eye.place;
            sensor.yaw = 0;
            sensor.pitch = track_.track().eye.pitch;
            break;
        case Preset::top:
            sensor.position = focus(heading) + Vector3d(0, 0, wish_.distance.value_or(top_height));
            sensor.yaw = wish_.heading_up ? heading.yaw : std::numbers::pi / 2;
            sensor.pitch = -std::numbers::pi / 2;
            break;
        default: {
            const Look seen = look(tick, gentle_share(tick));
            aim(sensor, sight_->above_ground(heading.position, seen.from), seen.to);
        }
    }
    return sensor;
}

}  // namespace reprise::render
