#include "traffic/cars/trail.h"

#include <algorithm>
#include <array>

#include "world/digest.h"

namespace reprise::traffic {

namespace {

constexpr double spacing = 0.25;          // [m] between points kept: finer is not visible
constexpr std::size_t spent_points = 16;  // thrown away together

}  // namespace

void Trail::start(const Eigen::Vector3d& front, const Eigen::Vector3d& behind, double distance) {
    start(std::vector<Eigen::Vector3d>{front + behind * distance, front}, distance);
}

void Trail::start(const std::vector<Eigen::Vector3d>& from_rear_to_front, double distance) {
    points_.clear();
    at_ = 0;
    travelled_ = 0;
    distance_ = distance;
    reach_ = std::max(distance, least_reach);
    points_digest_ = 0;
    front_ = from_rear_to_front.front();
    add_point();
    for (const Eigen::Vector3d& point : from_rear_to_front) {
        travelled_ += (point - front_).norm();
        front_ = point;
        add_point();
    }
    advance(front_);
}

void Trail::add_point() {
    points_.push_back({front_, travelled_});
    const std::array<double, 4> numbers{front_.x(), front_.y(), front_.z(), travelled_};
    points_digest_ = world::digest64(points_digest_, numbers.data(), sizeof(numbers));
}

void Trail::advance(const Eigen::Vector3d& front) {
    travelled_ += (front - front_).norm();
    front_ = front;
    if (travelled_ - points_.back().travelled >= spacing)
        add_point();
    const double wanted = travelled_ - reach_;
    while (at_ + 1 < points_.size() && points_[at_ + 1].travelled <= wanted)
        ++at_;
    if (at_ >= spent_points) {
        points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ = 0;
    }
}

Eigen::Vector3d Trail::rear() const {
    return reach_ == distance_ ? heads_from() : behind(distance_);
}

Eigen::Vector3d Trail::heads_from() const {
    return between(at_, travelled_ - reach_);
}

Eigen::Vector3d Trail::behind(double distance) const {
    const double wanted = travelled_ - std::min(distance, distance_);
    // The first point after the axle's that lies beyond, by halving what is left without a branch:
    // a processor cannot foretell them.
    std::size_t after = at_ + 1;
    for (std::size_t left = points_.size() - after; left > 0;) {
        const std::size_t half = left / 2;
        const bool is_beyond = wanted < points_[after + half].travelled;
        after = is_beyond ? after : after + half + 1;
        left = is_beyond ? half : left - half - 1;
    }
    return between(after - 1, wanted);
}

/// Where it was, by then `travelled` [m] from the start, between points_[at] and the one after it.
Eigen::Vector3d Trail::between(std::size_t at, double travelled) const {
    const Point& from = points_[at];
    const Point to = at + 1 < points_.size() ? points_[at + 1] : Point{front_, travelled_};
    const double length = to.travelled - from.travelled;
    const double share = length > 0 ? (travelled - from.travelled) / length : 0;
    return from.position + share * (to.position - from.position);
}

}  // namespace reprise::traffic
