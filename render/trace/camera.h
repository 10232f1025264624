#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "render/trace/lens.h"
#include "world/external/sensor.h"

namespace reprise::render {

/// A camera in the scene's frame; optical axes: x right, y down, z ahead. Pixel (u, v) is seen
/// through (u + 0.5, v + 0.5). A pinhole with square pixels and the axis in the middle, unless the
/// sensor's attributes say otherwise: a lens that distorts, other focal lengths, another middle.
class Camera {
  public:
    /// `pose_scene_mount` takes the frame that the sensor is mounted in to the scene's.
    Camera(const world::SensorSpec& spec, const Eigen::Isometry3d& pose_scene_mount);

    int width() const { return width_; }

    int height() const { return height_; }

    const Eigen::Vector3d& position() const { return position_; }

    /// Through the picture at (x, y), in pixels from its upper left corner. Its part along the
    /// optical axis is 1, so that what lies t rays away has depth t; of a fisheye it is a unit
    /// vector, and t the distance. Zero where the lens sees nothing.
    [[gnu::always_inline]] Eigen::Vector3d ray(double x, double y) const {
        return plain_ ? Eigen::Vector3d(corner_ + x * right_ + y * down_) : bent_ray(x, y);
    }

    /// Where a point is seen, with its depth (in rays) as z; only ahead of the camera (z > 0) does
    /// it make sense.
    Eigen::Vector3d project(const Eigen::Vector3d& p_scene) const;

    /// Its columns are where the optical axes point.
    const Eigen::Matrix3d& rotation_scene_camera() const { return rotation_scene_camera_; }

    /// [px] from the middle of the picture to what lies 45 degrees aside; of a fisheye [px/rad].
    double focal() const { return focal_; }

    double focal_y() const { return focal_y_; }

    /// [px] where the optical axis meets the picture.
    const Eigen::Vector2d& middle() const { return middle_; }

    const Lens& lens() const { return lens_; }

    /// Size of a pixel one metre ahead. [m]
    double pixel() const { return 1 / focal_; }

    /// The same camera on a share of its way to where another one is, in [0, 1].
    Camera towards(const Camera& other, double share) const;

    /// The same camera, of whose picture there are only so many rows.
    Camera cropped(int first_row, int rows) const;

    /// Through another place of the lens's opening, `aside` to the right and down of its middle
    /// [m]: all such see in the same pixel what is `sharp` rays away. For rays alone: project()
    /// knows nothing of it.
    Camera through(const Eigen::Vector2d& aside, double sharp) const;

    /// Do both see the same through every pixel?
    friend bool operator==(const Camera& left, const Camera& right);

  private:
    Eigen::Vector3d bent_ray(double x, double y) const;
    void lay_out();

    int width_;
    int height_;
    double focal_;    // [px] of columns
    double focal_y_;  // [px] of rows
    Eigen::Vector2d middle_;
    Lens lens_;
    bool plain_ = true;
    double sharp_ = 0;                                 // [rays] 0: everything is
    Eigen::Vector3d aside_ = Eigen::Vector3d::Zero();  // scene
    Eigen::Vector3d position_;
    Eigen::Matrix3d rotation_scene_camera_;
    Eigen::Vector3d right_;   // one pixel to the right
    Eigen::Vector3d down_;    // one pixel downwards
    Eigen::Vector3d corner_;  // the ray through the upper left corner
};

}  // namespace reprise::render
