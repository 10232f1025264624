#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "world/digest.h"
#include "world/models/car_model.h"
#include "world/trajectory.h"

namespace reprise::kernel {

class Ground;

/// Where a vehicle that follows a trajectory is: exactly there in plan, on the wheels' ground in
/// height, pitch and roll. Frame: the vehicle's. Times are ticks, and shares of them.
class Guide {
  public:
    /// `start`: the tick of the trajectory's time 0.
    Guide(world::Trajectory trajectory, std::uint64_t start)
        : trajectory_(std::move(trajectory)),
          start_(start) {}

    /// No tick of the trajectory is left at or after this one.
    bool is_over(std::uint64_t tick, double step) const;

    /// For the tick that ends at `tick`, from where the vehicle is; `step` [s].
    void aim(std::uint64_t tick,
             double step,
             const Ground& ground,
             const world::VehicleModel& model,
             const Eigen::Isometry3d& pose_world_vehicle);

    /// After a share of that tick.
    Eigen::Isometry3d pose_after(double share) const;

    /// At its end.
    const Eigen::Vector3d& velocity() const { return velocity_; }

    const Eigen::Vector3d& angular_velocity() const { return angular_velocity_; }

    void add_to(world::Hasher& hasher) const;

  private:
    double time_of(double tick, double step) const {
        return (tick - static_cast<double>(start_)) * step;
    }

    world::Trajectory trajectory_;
    std::uint64_t start_ = 0;
    Eigen::Isometry3d from_ = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d to_ = Eigen::Isometry3d::Identity();
    double from_time_ = 0;
    double to_time_ = 0;
    Eigen::Vector3d velocity_{0, 0, 0};
    Eigen::Vector3d angular_velocity_{0, 0, 0};
};

}  // namespace reprise::kernel
