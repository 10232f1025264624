#include "kernel/physics/guide.h"

#include <algorithm>
#include <cmath>

#include "kernel/physics/stance.h"

namespace reprise::kernel {

bool Guide::is_over(std::uint64_t tick, double step) const {
    constexpr double rounding = 1e-9;  // [s]
    return time_of(static_cast<double>(tick), step) > trajectory_.end() + rounding;
}

void Guide::aim(std::uint64_t tick,
                double step,
                const Ground& ground,
                const world::VehicleModel& model,
                const Eigen::Isometry3d& pose_world_vehicle) {
    from_ = pose_world_vehicle;
    to_time_ = time_of(static_cast<double>(tick), step);
    from_time_ = to_time_ - step;
    const world::Trajectory::State state = trajectory_.at(to_time_);
    const Eigen::Vector3d x_ahead = from_.linear().col(0);
    const double heading = state.heading.value_or(std::atan2(x_ahead.y(), x_ahead.x()));
    // On the level that it is on: the trajectory's own height is a guess between far points.
    Eigen::Vector3d p_world = state.position;
    p_world.z() = from_.translation().z();
    to_ = stance(ground, model, p_world, heading);
    const Eigen::Vector3d up = to_.linear().col(2);
    const Eigen::Vector2d& v = state.velocity;
    velocity_ = {v.x(), v.y(), -(up.x() * v.x() + up.y() * v.y()) / up.z()};
    angular_velocity_ = up * state.turn_rate;
}

Eigen::Isometry3d Guide::pose_after(double share) const {
    if (share >= 1)
        return to_;
    const Eigen::Quaterniond from(from_.linear());
    const Eigen::Quaterniond to(to_.linear());
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = from.slerp(share, to).toRotationMatrix();
    const Eigen::Vector3d between =
        from_.translation() + share * (to_.translation() - from_.translation());
    // Before the first point the way leads there from wherever it was.
    const double time = from_time_ + share * (to_time_ - from_time_);
    pose.translation() = between;
    if (from_time_ >= trajectory_.start())
        pose.translation().head<2>() = trajectory_.at(time).position.head<2>();
    return pose;
}

void Guide::add_to(world::Hasher& hasher) const {
    trajectory_.add_to(hasher);
    hasher.add(start_);
}

}  // namespace reprise::kernel
