#include "render/trace/lens.h"

#include <array>
#include <cmath>

#include <gmock/gmock.h>

#include "render/trace/camera.h"
#include "tests/render/frames.h"
#include "world/external/rig.h"

namespace reprise {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using world::SensorKind;

world::SensorSpec told(world::SensorSpec spec, std::vector<world::AttributeValue> attributes) {
    spec.attributes = std::move(attributes);
    return spec;
}

std::vector<world::AttributeValue> brown() {
    return {{"k1", -0.28}, {"k2", 0.07}, {"p1", 0.0008}, {"p2", -0.0005}, {"k3", -0.009}};
}

std::vector<world::AttributeValue> kannala() {
    return {{"lens", 1},
            {"k1", 0.02},
            {"k2", -0.005},
            {"k3", 0.001},
            {"k4", -0.0002},
            {"fx", 60},
            {"fy", 62},
            {"cx", 80},
            {"cy", 58}};
}

/// A camera that stands in the origin; its axes in the world's.
render::Camera at_origin(const world::SensorSpec& spec) {
    return render::Camera(spec, Eigen::Isometry3d::Identity());
}

Vector3d in_world(const Vector3d& p_camera) {
    return {p_camera.z(), -p_camera.x(), -p_camera.y()};
}

struct Known {
    Vector3d p_camera;
    Vector2d seen;
};

/// By the forward formulas of OpenCV's manual, and nothing of ours.
Vector2d by_hand(const Vector3d& p, bool fisheye) {
    const Vector2d flat = p.head<2>() / p.z();
    if (fisheye) {
        const double a = std::atan2(p.head<2>().norm(), p.z());
        const double bent = a + 0.02 * std::pow(a, 3) - 0.005 * std::pow(a, 5) +
                            0.001 * std::pow(a, 7) - 0.0002 * std::pow(a, 9);
        const Vector2d at = p.head<2>() * bent / p.head<2>().norm();
        return {60 * at.x() + 80, 62 * at.y() + 58};
    }
    const double r2 = flat.squaredNorm();
    const double radial = 1 - 0.28 * r2 + 0.07 * r2 * r2 - 0.009 * r2 * r2 * r2;
    const double xy = flat.x() * flat.y();
    return {
        80 * (flat.x() * radial + 2 * 0.0008 * xy - 0.0005 * (r2 + 2 * flat.x() * flat.x())) + 80,
        80 * (flat.y() * radial + 0.0008 * (r2 + 2 * flat.y() * flat.y()) - 2 * 0.0005 * xy) + 60};
}

}  // namespace

TEST(Lens, SeesPointsWhereOpenCVDoes) {
    // cv2.projectPoints and cv2.fisheye.projectPoints of OpenCV 5.0.0 for these coefficients.
    const std::vector<Known> pinhole{{{0.4, -0.2, 2}, {95.771022, 52.116689}},
                                     {{-3, 1, 5}, {36.805888, 74.418304}},
                                     {{1.5, 0.9, 2.2}, {126.26491104250073, 87.8145829891368}},
                                     {{-0.02, 0.01, 1}, {78.4001463720018, 60.7999488139991}},
                                     {{12, -4, 15}, {133.20825362962964, 42.299945086419754}}};
    const std::vector<Known> fisheye{{{0.4, -0.2, 2}, {91.81708355632294, 51.89450682923315}},
                                     {{-3, 1, 5}, {47.71091167791005, 69.12179708871987}},
                                     {{1.5, 0.9, .2}, {156.86602943446292, 105.65693824936702}},
                                     {{-2, 1, .1}, {-4.045741405005032, 101.4236330592526}},
                                     {{12, -4, 1}, {167.11695512119798, 27.993048791587363}}};
    const world::SensorSpec spec = test::camera(SensorKind::rgb, {0, 0, 0});
    for (const bool wide : {false, true}) {
        const render::Camera camera = at_origin(told(spec, wide ? kannala() : brown()));
        for (const Known& known : wide ? fisheye : pinhole) {
            const Vector3d seen = camera.project(in_world(known.p_camera));
            EXPECT_LT((seen.head<2>() - known.seen).norm(), 1e-6) << known.p_camera.transpose();
            // And the ray through that place meets the point.
            const Vector3d ray = camera.ray(known.seen.x(), known.seen.y());
            EXPECT_LT((seen.z() * ray - in_world(known.p_camera)).norm(),
                      1e-6 * known.p_camera.norm());
            EXPECT_LT((by_hand(known.p_camera, wide) - known.seen).norm(), 1e-6);
        }
    }
}

TEST(Lens, RaysAndPlacesAreInverse) {
    const world::SensorSpec spec = test::camera(SensorKind::rgb, {1, 2, 3});
    for (const auto& attributes : {brown(), kannala()}) {
        const render::Camera camera = at_origin(told(spec, attributes));
        for (double y = 20.5; y < 100; y += 7)
            for (double x = 20.5; x < 140; x += 7) {
                const Vector3d ray = camera.ray(x, y);
                ASSERT_FALSE(ray.isZero(0)) << x << ' ' << y;
                const Vector3d seen = camera.project(camera.position() + 30 * ray);
                EXPECT_LT((seen - Vector3d(x, y, 30)).norm(), 1e-8) << x << ' ' << y;
            }
    }
}

TEST(Lens, AFisheyesFieldOfViewReachesFromEdgeToEdgeBehindItsOwnPlane) {
    world::SensorSpec spec = test::camera(SensorKind::rgb, {0, 0, 0});
    spec.fov = 200 * M_PI / 180;
    const render::Camera camera = at_origin(told(spec, {{"lens", 1}}));
    const Vector3d ray = camera.ray(0, 60);
    EXPECT_NEAR(ray.norm(), 1, 1e-12);
    EXPECT_NEAR(std::atan2(ray.y(), ray.x()) * 180 / M_PI, 100, 1e-9);
    EXPECT_TRUE(world::contradiction(told(spec, {})).find("fisheye") != std::string::npos);
}

TEST(Lens, DepthsOfABentPictureLieOnTheRoad) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = test::tick_with({});
    for (const bool wide : {false, true}) {
        world::SensorSpec spec = test::camera(SensorKind::depth, {100, -1.75, 1.4});
        spec.attributes = wide ? kannala() : brown();
        const world::SensorFrame frame = sensors.observe(tick.view(), {spec}, test::noon())[0];
        // The road's plane gives the point for each column and depth; OpenCV's formulas its place.
        int seen = 0;
        for (int v = 75; v < 120; v += 5)
            for (int u = 62; u < 99; u += 4) {
                const auto depth = static_cast<double>(test::depth_at(frame, u, v));
                Vector3d ray = at_origin(spec).ray(u + 0.5, v + 0.5);
                const Vector3d p_world = depth * ray;
                EXPECT_NEAR(p_world.z(), -1.4, 1e-4) << u << ' ' << v;
                const Vector3d p_camera(-p_world.y(), -p_world.z(), p_world.x());
                EXPECT_LT((by_hand(p_camera, wide) - Vector2d(u + 0.5, v + 0.5)).norm(), 0.05);
                ++seen;
            }
        EXPECT_GT(seen, 80);
    }
}

TEST(Lens, WhatItDoesNotSeeIsBlackAndNothing) {
    // So strong a barrel that its picture ends before the corners.
    world::SensorSpec spec = test::camera(SensorKind::rgb, {100, -1.75, 1.4});
    spec.attributes = {{"k1", -0.5}};
    world::SensorSpec classes = spec;
    classes.kind = SensorKind::semantic;
    world::SensorSpec depth = spec;
    depth.kind = SensorKind::depth;
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = test::tick_with({});
    const auto frames = sensors.observe(tick.view(), {spec, classes, depth}, test::noon());
    EXPECT_EQ(test::mean(frames[0], 1, 0, 0, 3, 3), 0);
    EXPECT_EQ(test::class_at(frames[1], 0, 0), world::SemanticClass::unlabeled);
    EXPECT_TRUE(std::isinf(test::depth_at(frames[2], 0, 0)));
    EXPECT_EQ(test::class_at(frames[1], 80, 30), world::SemanticClass::sky);
    EXPECT_GT(test::mean(frames[0], 1, 78, 28, 82, 32), 50);
}

}  // namespace reprise
