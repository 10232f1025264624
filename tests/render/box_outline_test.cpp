#include "render/labels/box_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/render/frames.h"
#include "world/random.h"

namespace reprise {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using world::SensorKind;

/// [-1, 1]
double chance(std::uint64_t round, std::uint64_t item) {
    return 2 * world::draw(1, round, world::Purpose::scenario, item) - 1;
}

struct Scene {
    render::Camera camera;
    Isometry3d pose;
    Vector3d size;
};

/// A car's box anywhere within 8 m of a camera, which looks anywhere: often beside, behind or
/// around it.
Scene scene(std::uint64_t round, const std::vector<world::AttributeValue>& attributes) {
    world::SensorSpec spec = test::camera(SensorKind::instance, {0, 0, 0});
    spec.width = 80 + static_cast<int>(40 * chance(round, 0));
    spec.height = 60 + static_cast<int>(30 * chance(round, 1));
    spec.fov = 1.2 + 0.8 * chance(round, 2);
    spec.yaw = 3 * chance(round, 3);
    spec.pitch = chance(round, 4);
    spec.roll = 3 * chance(round, 5);
    spec.attributes = attributes;
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(3 * chance(round, 6), Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = Vector3d(8 * chance(round, 7), 8 * chance(round, 8), 2 * chance(round, 9));
    return {render::Camera(spec, Isometry3d::Identity()), pose, {4.7, 1.8, 1.5}};
}

/// By asking every pixel's rays, so many along each side: is one ever inside of the box's six
/// planes?
std::optional<render::PixelBox> by_rays(const Scene& scene, int parts) {
    constexpr double most = std::numeric_limits<double>::max();
    render::PixelBox box{most, most, -most, -most};
    const Isometry3d pose_box_world = scene.pose.inverse();
    const Vector3d from = pose_box_world * scene.camera.position();
    for (int row = 0; row < parts * scene.camera.height(); ++row)
        for (int column = 0; column < parts * scene.camera.width(); ++column) {
            const double x = (column + 0.5) / parts;
            const double y = (row + 0.5) / parts;
            const Vector3d way = pose_box_world.linear() * scene.camera.ray(x, y);
            if (way.isZero(0))
                continue;
            double first = 0;
            double last = most;
            for (int side = 0; side < 6; ++side) {
                const int axis = side / 2;
                const double outwards = side % 2 == 0 ? 1 : -1;
                const double beyond = outwards * from[axis] - scene.size[axis] / 2;
                const double speed = outwards * way[axis];  // out of this plane
                if (speed > 0)
                    last = std::min(last, -beyond / speed);
                else if (speed < 0)
                    first = std::max(first, -beyond / speed);
                else if (beyond > 0)
                    last = -1;
            }
            if (first > last)
                continue;
            box = {std::min(box.left, x),
                   std::min(box.top, y),
                   std::max(box.right, x),
                   std::max(box.bottom, y)};
        }
    if (box.left > box.right)
        return std::nullopt;
    return box;
}

/// [px] by which the outlines differ; what is seen of a box between two rays may be missed by them.
double apart(const Scene& scene, const std::optional<render::PixelBox>& expected) {
    const auto found = render::box_in_picture(scene.camera, scene.pose, scene.size);
    if (!found && !expected)
        return 0;
    if (!expected)
        return std::min(found->right - found->left, found->bottom - found->top);
    if (!found)
        return 1e6;
    return std::max({std::abs(found->left - expected->left),
                     std::abs(found->top - expected->top),
                     std::abs(found->right - expected->right),
                     std::abs(found->bottom - expected->bottom)});
}

/// Within two rays: a thin corner of a box may lie between them.
void expect_agreement(const std::vector<world::AttributeValue>& attributes, int rays) {
    constexpr int rounds = 100;
    int seen = 0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
        const Scene one = scene(round, attributes);
        const auto expected = by_rays(one, rays);
        seen += expected ? 1 : 0;
        EXPECT_LT(apart(one, expected), 2.0 / rays + 0.3) << round;
    }
    EXPECT_GT(seen, rounds / 5);
}

}  // namespace

TEST(BoxOutline, IsWhatRaysFindOfABoxThatReachesBehindTheCamera) {
    expect_agreement({}, 3);
}

TEST(BoxOutline, IsWhatRaysFindThroughALensThatDistorts) {
    expect_agreement({{"k1", -0.2}, {"k2", 0.04}, {"p1", 0.0008}}, 1);
}

TEST(BoxOutline, IsWhatRaysFindThroughAFisheye) {
    expect_agreement({{"lens", 1}, {"k1", 0.02}}, 3);
}

TEST(BoxOutline, OfABoxBesideTheCameraEndsWhereItsFrontEnds) {
    // To the right of a camera of 90 degrees, 100 px wide: from 1 to 2 m aside, from 5 m behind to
    // 4 m ahead, from 1 m below to half a metre above.
    world::SensorSpec spec = test::camera(SensorKind::instance, {0, 0, 0});
    spec.width = spec.height = 100;
    spec.fov = std::acos(0.0);
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = Vector3d(-0.5, -1.5, -0.25);
    const auto box =
        render::box_in_picture(render::Camera(spec, Isometry3d::Identity()), pose, {9, 1, 1.5});
    ASSERT_TRUE(box);
    EXPECT_NEAR(box->left, 50 + 50 * 1 / 4.0, 1e-9);
    EXPECT_NEAR(box->right, 100, 1e-9);
    EXPECT_NEAR(box->bottom, 100, 1e-9);             // 1 m below, where its side leaves the picture
    EXPECT_NEAR(box->top, 50 - 50 * 0.5 / 1, 1e-9);  // likewise, half a metre above
}

}  // namespace reprise
