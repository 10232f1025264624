#include "render/views/preset_camera.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "render/trace/camera.h"
#include "tests/support/worlds.h"
#include "world/frames.h"
#include "world/models/viewpoint.h"

namespace reprise {

namespace {

using Eigen::Vector3d;
using render::Preset;
using render::PresetCamera;
using render::PresetWish;

constexpr double pi = std::numbers::pi;

const world::VehicleModel& sedan() {
    return world::vehicle_models()[*world::find_vehicle_model("sedan")];
}

render::Track empty_track() {
    render::Track track;
    track.actor = 1;
    track.extent = world::extent_of(sedan());
    track.eye = world::drivers_eye(sedan());
    track.first = 1;
    return track;
}

Eigen::Isometry3d pose_at(double x, double y, double yaw) {
    return world::pose(world::Vec3(x, y, 0), yaw, 0);
}

/// East along y = 0 at 10 m/s for 5 s, a quarter to the left on a radius of 12 m, then north.
render::Track bend() {
    constexpr double radius = 12;
    constexpr double speed = 10;
    render::Track track = empty_track();
    for (int i = 0; i < 300; ++i) {
        const double s = i * 0.05 * speed;
        const double turned = std::clamp((s - 50) / radius, 0.0, pi / 2);
        const double before = std::min(s, 50.0);
        const double behind = std::max(0.0, s - 50 - radius * pi / 2);
        track.poses.push_back(pose_at(
            before + radius * std::sin(turned), radius * (1 - std::cos(turned)) + behind, turned));
    }
    return track;
}

world::SensorSpec small() {
    world::SensorSpec spec;
    spec.width = 160;
    spec.height = 120;
    return spec;
}

/// Where a point of the world is in the picture: [0, 1] from the left and from the top.
Eigen::Vector2d share(const world::SensorSpec& spec, const Vector3d& p_world) {
    EXPECT_EQ(spec.actor, 0U);
    const Vector3d seen = render::Camera(spec, Eigen::Isometry3d::Identity()).project(p_world);
    EXPECT_GT(seen.z(), 0);
    return {seen.x() / spec.width, seen.y() / spec.height};
}

Vector3d middle_of(const render::Track& track, std::uint64_t tick) {
    return track.poses[tick - track.first] * Vector3d(track.extent.middle(), 0, 0.7);
}

}  // namespace

TEST(PresetCamera, ChaseKeepsTheActorInTheLowerMiddleOverABend) {
    const PresetCamera camera({.preset = Preset::chase}, bend(), test::straight_road());
    for (std::uint64_t tick = 1; tick <= 300; ++tick) {
        const Eigen::Vector2d at = share(camera.at(tick, small()), middle_of(bend(), tick));
        EXPECT_NEAR(at.x(), 0.5, 0.2) << tick;
        EXPECT_GT(at.y(), 0.5) << tick;
        EXPECT_LT(at.y(), 0.75) << tick;
    }
    const world::SensorSpec end = camera.at(280, small());
    EXPECT_NEAR(end.yaw, pi / 2, 1e-6) << "on the straight road behind the bend it looks ahead";
    EXPECT_LT(end.position.y(), middle_of(bend(), 280).y() - 6);
}

TEST(PresetCamera, ChaseDoesNotJerkWhereTheActorDoes) {
    // Thrown round by half a radian in one tick, and half a metre aside.
    render::Track track = empty_track();
    for (int i = 0; i < 200; ++i)
        track.poses.push_back(pose_at(0.5 * i, i < 100 ? 0 : 0.5, i < 100 ? 0 : 0.5));
    const PresetCamera camera({.preset = Preset::chase}, track, test::straight_road());
    for (std::uint64_t tick = 2; tick <= 200; ++tick) {
        const world::SensorSpec last = camera.at(tick - 1, small());
        const world::SensorSpec next = camera.at(tick, small());
        EXPECT_LT(std::abs(next.yaw - last.yaw), 0.03) << tick;
        EXPECT_LT((next.position - last.position).norm(), 0.8) << tick << ": 0.5 m are driven";
    }
}

TEST(PresetCamera, WhatIsSeenAtATickDoesNotDependOnWhichTicksAreShown) {
    const PresetCamera whole({.preset = Preset::chase}, bend(), test::straight_road());
    render::Track part = bend();
    part.poses = {part.poses.begin() + 70, part.poses.begin() + 231};
    part.first = 71;
    const PresetCamera cut({.preset = Preset::chase}, part, test::straight_road());
    for (std::uint64_t tick = 151; tick <= 151; ++tick) {
        EXPECT_EQ(whole.at(tick, small()).position, cut.at(tick, small()).position);
        EXPECT_EQ(whole.at(tick, small()).yaw, cut.at(tick, small()).yaw);
    }
}

TEST(PresetCamera, StaysWithAnActorThatIsPutSomewhereElse) {
    render::Track track = empty_track();
    for (int i = 0; i < 100; ++i)
        track.poses.push_back(pose_at(i < 50 ? 0.5 * i : 200 + 0.5 * i, 0, 0));
    for (const Preset preset : {Preset::chase, Preset::top, Preset::orbit}) {
        const PresetCamera camera({.preset = preset}, track, test::straight_road());
        for (std::uint64_t tick = 1; tick <= 100; ++tick) {
            const Vector3d away = camera.at(tick, small()).position - middle_of(track, tick);
            EXPECT_LT(away.head<2>().norm(), 15) << tick;
        }
    }
}

TEST(PresetCamera, IsNeverInABuildingAndComesNearItGently) {
    // Where a camera behind would swing out of the bend, in the bend, and beside the road behind
    // it.
    world::TownT town = test::straight_road();
    town.buildings = {{world::Vec3(53, -5.2, 0), 0, 9, 7, 12, 3, 0},
                      {world::Vec3(56.5, 19, 0), 0, 7, 8, 12, 3, 0},
                      {world::Vec3(68, 6, 0), 0.1, 4, 30, 9, 3, 0}};
    for (const Preset preset : {Preset::chase, Preset::orbit}) {
        const PresetCamera camera({.preset = preset}, bend(), town);
        const PresetCamera free({.preset = preset}, bend(), test::straight_road());
        bool gave_way = false;
        std::optional<Vector3d> last;
        for (std::uint64_t tick = 80; tick <= 220; ++tick) {
            const world::SensorSpec spec = camera.at(tick, small());
            for (const world::Building& house : town.buildings) {
                const Vector3d inside =
                    world::pose(house.centre(), house.yaw(), 0).inverse() * spec.position;
                EXPECT_FALSE(std::abs(inside.x()) < house.length() / 2 + 0.3 &&
                             std::abs(inside.y()) < house.width() / 2 + 0.3 &&
                             inside.z() < house.height())
                    << tick;
            }
            const double away = (spec.position - middle_of(bend(), tick)).norm();
            const double aside = (spec.position - free.at(tick, small()).position).norm();
            gave_way = gave_way || aside > 0.5;
            EXPECT_GT(away, 1.5) << tick << ": in the car itself";
            if (last) {
                EXPECT_LT((spec.position - *last).norm(), 1.5) << tick;
            }
            last = spec.position;
        }
        EXPECT_TRUE(gave_way) << "nothing was in the way of " << int(preset);
    }
}

TEST(PresetCamera, IsNeverBelowTheGround) {
    // The road comes down a hill to the level where the car stands.
    world::TownT town = test::straight_road(200);
    for (world::LaneT& lane : town.lanes) {
        const double y = lane.centre.front().y();
        const bool east = lane.edge == "east";
        lane.centre = {world::Vec3(0, y, 40), world::Vec3(100, y, 0), world::Vec3(200, y, 0)};
        if (!east)
            std::reverse(lane.centre.begin(), lane.centre.end());
    }
    render::Track track = empty_track();
    track.poses.assign(50, pose_at(110, -1.75, 0));
    const PresetCamera camera({.preset = Preset::chase, .distance = 40}, track, town);
    const world::SensorSpec spec = camera.at(25, small());
    ASSERT_LT(spec.position.x(), 80);
    EXPECT_GE(spec.position.z(), (100 - spec.position.x()) * 0.4 + 0.9);
    EXPECT_NEAR(share(spec, Vector3d(115, -1.75, 0)).y(), 0.5, 0.1) << "it still looks at the car";
}

TEST(PresetCamera, TopLooksStraightDownWithNorthOrTheHeadingUp) {
    const std::uint64_t tick = 250;  // northwards, behind the bend
    render::Track west = empty_track();
    west.poses.assign(50, pose_at(20, 5, pi));
    for (const bool heading_up : {false, true}) {
        const PresetCamera camera(
            {.preset = Preset::top, .heading_up = heading_up}, west, test::straight_road());
        const world::SensorSpec spec = camera.at(tick, small());
        const Vector3d car = middle_of(west, 1);
        EXPECT_NEAR(share(spec, car).x(), 0.5, 1e-6);
        EXPECT_NEAR(share(spec, car).y(), 0.5, 1e-6);
        const Eigen::Vector2d north = share(spec, car + Vector3d(0, 5, 0));
        const Eigen::Vector2d ahead = share(spec, car + Vector3d(-5, 0, 0));
        const Eigen::Vector2d& up = heading_up ? ahead : north;
        EXPECT_NEAR(up.x(), 0.5, 1e-6);
        EXPECT_LT(up.y(), 0.45);
        EXPECT_GT(heading_up ? north.x() : -ahead.x(), heading_up ? 0.55 : -0.45);
    }
}

TEST(PresetCamera, OrbitGoesAroundTheActorAndLooksAtIt) {
    render::Track track = empty_track();
    track.poses.assign(600, pose_at(50, -1.75, 0.3));
    const PresetCamera camera(
        {.preset = Preset::orbit, .distance = 9}, track, test::straight_road());
    const Vector3d car = middle_of(track, 1);
    double turned = 0;
    for (std::uint64_t tick = 2; tick <= 481; ++tick) {
        const Vector3d last = camera.at(tick - 1, small()).position - car;
        const Vector3d next = camera.at(tick, small()).position - car;
        EXPECT_NEAR(next.head<2>().norm(), 9, 1e-6);
        turned += std::atan2(last.x() * next.y() - last.y() * next.x(),
                             last.head<2>().dot(next.head<2>()));
        const Eigen::Vector2d at = share(camera.at(tick, small()), car);
        EXPECT_NEAR(at.x(), 0.5, 0.01);
        EXPECT_NEAR(at.y(), 0.5, 0.02);
    }
    EXPECT_NEAR(turned, 2 * pi, 1e-9) << "in 24 s";
}

TEST(PresetCamera, DriverIsCarriedAndSeesNothingOfItsCar) {
    const PresetCamera camera({.preset = Preset::driver}, bend(), test::straight_road());
    const world::SensorSpec spec = camera.at(20, small());
    EXPECT_EQ(spec.actor, 1U);
    EXPECT_TRUE(world::is_carried_at(bend().extent, spec.position));
    EXPECT_EQ(camera.at(20, small()).width, 160);
}

TEST(PresetCamera, FieldOfViewAndDistanceAreAsWished) {
    const render::Track track = bend();
    const PresetCamera camera(
        {.preset = Preset::chase, .fov = 0.5, .distance = 20}, track, test::straight_road());
    const world::SensorSpec spec = camera.at(40, small());
    EXPECT_EQ(spec.fov, 0.5);
    const Vector3d rear = track.poses[39] * Vector3d(track.extent.rear, 0, 0);
    EXPECT_NEAR((rear - spec.position).x(), 20, 0.7);
}

}  // namespace reprise
