#include "render/trace/camera.h"

#include <gmock/gmock.h>

#include "tests/render/frames.h"

namespace reprise {

namespace {

Eigen::Isometry3d mount() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(30, -4, 2);
    pose.linear() = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return pose;
}

}  // namespace

TEST(Camera, LooksAlongTheMountsXAxisWithRightAndDownAsPicturesHaveThem) {
    const world::SensorSpec spec = test::camera(world::SensorKind::rgb, {1, 0, 1.4});
    const render::Camera camera(spec, mount());
    const auto seen = [&](double x, double y, double z) {
        return camera.project(mount() * Eigen::Vector3d(x, y, z));
    };
    EXPECT_THAT(seen(11, 0, 1.4).x(), testing::DoubleNear(80, 1e-9));
    EXPECT_THAT(seen(11, 0, 1.4).y(), testing::DoubleNear(60, 1e-9));
    EXPECT_THAT(seen(11, 0, 1.4).z(), testing::DoubleNear(10, 1e-9));
    EXPECT_GT(seen(11, -1, 1.4).x(), 80) << "what is right of the car is right in the picture";
    EXPECT_GT(seen(11, 0, 0.4).y(), 60) << "what is low is low in the picture";
}

TEST(Camera, FieldOfViewReachesFromEdgeToEdge) {
    world::SensorSpec spec = test::camera(world::SensorKind::rgb, {0, 0, 0});
    spec.fov = 1.2;
    const render::Camera camera(spec, Eigen::Isometry3d::Identity());
    // A point half the field of view to the left is on the left edge; pixels are square.
    const double side = std::tan(0.6);
    EXPECT_THAT(camera.project({1, side, 0}).x(), testing::DoubleNear(0, 1e-9));
    EXPECT_THAT(camera.project({1, 0, side}).y() - 60, testing::DoubleNear(-80, 1e-9));
}

TEST(Camera, RayAndProjectionAreInverse) {
    world::SensorSpec spec = test::camera(world::SensorKind::rgb, {1, 0.5, 1.4});
    spec.yaw = 0.3;
    spec.pitch = -0.2;
    const render::Camera camera(spec, mount());
    for (const double u : {0.5, 33.0, 159.5}) {
        const Eigen::Vector3d point = camera.position() + 7.5 * camera.ray(u, 41.25);
        EXPECT_TRUE(camera.project(point).isApprox(Eigen::Vector3d(u, 41.25, 7.5), 1e-12));
    }
}

TEST(Camera, PitchesUpAndYawsLeft) {
    world::SensorSpec spec = test::camera(world::SensorKind::rgb, {0, 0, 0});
    spec.yaw = 0.3;
    spec.pitch = 0.2;
    const render::Camera camera(spec, Eigen::Isometry3d::Identity());
    const Eigen::Vector3d ahead = camera.ray(80, 60);
    EXPECT_THAT(std::atan2(ahead.y(), ahead.x()), testing::DoubleNear(0.3, 1e-12));
    EXPECT_THAT(std::asin(ahead.z()), testing::DoubleNear(0.2, 1e-12));
}

}  // namespace reprise
