#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "render/scene/twist.h"
#include "world/external/sensor.h"

namespace reprise::render {

/// Where a sensor is, and how it moves. Frame of sensors: x ahead, y left, z up.
class Mount {
  public:
    /// `origin`: of the scene, in the world. Throws world::Error when its actor is not there.
    Mount(const world::TickView& tick,
          const world::SensorSpec& spec,
          const Eigen::Vector3d& origin);

    /// Takes the sensor's frame to the scene's, so many seconds before the tick.
    Eigen::Isometry3d pose(double ago = 0) const;

    /// [m/s] of the sensor at the tick.
    Eigen::Vector3d velocity() const;

    /// Who is out of its sight: the actor that it is fixed to. 0: nobody.
    std::uint32_t hidden() const { return hidden_; }

  private:
    Eigen::Vector3d origin_;
    Twist twist_;
    Eigen::Isometry3d pose_world_sensor_;
    std::uint32_t hidden_ = 0;
};

}  // namespace reprise::render
