#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "world/external/sensor.h"

namespace reprise::render {

/// A pinhole camera in the scene's frame; optical axes: x right, y down, z ahead. Pixel (u, v) is
/// seen through (u + 0.5, v + 0.5); pixels are square.
class Camera {
  public:
    /// `pose_scene_mount` takes the frame that the sensor is mounted in to the scene's.
    Camera(const world::SensorSpec& spec, const Eigen::Isometry3d& pose_scene_mount);

    int width() const { return width_; }

    int height() const { return height_; }

    const Eigen::Vector3d& position() const { return position_; }

    /// Through the picture at (x, y), in pixels from its upper left corner. Not a unit vector: its
    /// part along the optical axis is 1, so that what lies t rays away has depth t.
    Eigen::Vector3d ray(double x, double y) const { return corner_ + x * right_ + y * down_; }

    /// Where a point is seen, with its depth as z; only ahead of the camera (z > 0) does it make
    /// sense.
    Eigen::Vector3d project(const Eigen::Vector3d& p_scene) const;

    /// Its columns are where the optical axes point.
    const Eigen::Matrix3d& rotation_scene_camera() const { return rotation_scene_camera_; }

    /// [px] from the middle of the picture to what lies 45 degrees aside.
    double focal() const { return focal_; }

    /// Size of a pixel one metre ahead. [m]
    double pixel() const { return 1 / focal_; }

    /// Do both see the same through every pixel?
    friend bool operator==(const Camera& left, const Camera& right);

  private:
    int width_;
    int height_;
    double focal_;  // [px]
    Eigen::Vector3d position_;
    Eigen::Matrix3d rotation_scene_camera_;
    Eigen::Vector3d right_;   // one pixel to the right
    Eigen::Vector3d down_;    // one pixel downwards
    Eigen::Vector3d corner_;  // the ray through the upper left corner
};

}  // namespace reprise::render
