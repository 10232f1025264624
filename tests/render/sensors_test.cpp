#include "render/sensors.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "render/trace/camera.h"
#include "tests/render/frames.h"
#include "world/check.h"
#include "world/models/catalogue.h"

namespace reprise {

namespace {

using test::camera;
using test::car_at;
using test::class_at;
using test::depth_at;
using test::tick_with;
using world::SemanticClass;
using world::SensorKind;

/// A street with a car ahead, one oncoming, and somebody on the sidewalk.
world::SealedTick busy_tick() {
    world::TickDraft draft;
    draft.tick.index = 40;
    draft.tick.vehicles = {test::vehicle_at(1, 40, -1.75)};
    draft.traffic.cars = {car_at(10, 55, -1.75), car_at(11, 60, 1.75, 3.14159)};
    draft.traffic.walkers = {
        {world::Vec3(50, -4.5, 0.15), 0, 1.2F, 0.3F, 20, 0, false, std::uint8_t{0}, 0U}};
    return world::seal(draft, {});
}

}  // namespace

TEST(Sensors, DepthOfTheRoadIsThatOfThePlane) {
    render::Sensors sensors(test::straight_road(400));
    const world::SensorSpec spec = camera(SensorKind::depth, {100, -1.75, 1.4});
    const world::SealedTick tick = tick_with({});
    const world::SensorFrame frame = sensors.observe(tick.view(), {spec}, test::noon())[0];
    const double focal = 80 / std::tan(spec.fov / 2);
    for (int v = 70; v < 120; ++v) {
        // A plane h below the camera: z = h f / (v + 0.5 - height / 2). Ten pixels stay in the
        // lane.
        const double depth = 1.4 * focal / (v + 0.5 - 60);
        for (int u = 75; u < 85; ++u)
            EXPECT_NEAR(static_cast<double>(depth_at(frame, u, v)), depth, 1e-7 * depth)
                << u << ' ' << v;
    }
    EXPECT_TRUE(std::isinf(depth_at(frame, 80, 20))) << "sky has no depth";
}

TEST(Sensors, SeesACarWhereItIsAndSaysSo) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = tick_with({}, {car_at(7, 120, -1.75)});
    const world::SensorSpec depth = camera(SensorKind::depth, {100, -1.75, 0.9});
    world::SensorSpec classes = depth;
    classes.kind = SensorKind::semantic;
    const auto frames = sensors.observe(tick.view(), {depth, classes}, test::noon());
    // The rear bumper stands one rear overhang behind the car's origin; it is a little rounded.
    const double bumper = 20 - world::vehicle_models()[0].rear_overhang;
    EXPECT_NEAR(static_cast<double>(depth_at(frames[0], 80, 61)), bumper, 0.15);
    EXPECT_EQ(class_at(frames[1], 80, 61), SemanticClass::car);
    EXPECT_EQ(class_at(frames[1], 80, 110), SemanticClass::road);
    EXPECT_EQ(class_at(frames[1], 80, 5), SemanticClass::sky);
}

TEST(Sensors, BusesAndLorriesHaveClassesOfTheirOwn) {
    render::Sensors sensors(test::straight_road(400));
    for (const auto& [name, expected] :
         {std::pair{"bus", SemanticClass::bus}, {"lorry", SemanticClass::truck}}) {
        world::CarState car = car_at(7, 120, -1.75);
        car.mutate_model(*world::find_vehicle_model(name));
        const world::SealedTick tick = tick_with({}, {car});
        const auto frames = sensors.observe(
            tick.view(), {camera(SensorKind::semantic, {100, -1.75, 1.4})}, test::noon());
        EXPECT_EQ(class_at(frames[0], 80, 60), expected);
    }
}

TEST(Sensors, PutsAKnownPointOnThePredictedPixel) {
    // The walker's head, from a camera on a turned car: projected by hand and found in the picture.
    const world::SealedTick tick = busy_tick();
    render::Sensors sensors(test::straight_road(400));
    world::SensorSpec spec = camera(SensorKind::semantic, {1, 0, 1.4});
    spec.actor = 1;
    spec.yaw = -0.2;
    const auto frames = sensors.observe(tick.view(), {spec}, test::noon());
    const Eigen::Vector3d away =
        Eigen::Vector3d(50, -4.5, 0.15 + 0.92 * 1.74) - Eigen::Vector3d(41, -1.75, 1.4);
    const double ahead = std::cos(-0.2) * away.x() + std::sin(-0.2) * away.y();
    const double left = -std::sin(-0.2) * away.x() + std::cos(-0.2) * away.y();
    const int u = static_cast<int>(80 - 80 * left / ahead);
    const int v = static_cast<int>(60 - 80 * away.z() / ahead);
    EXPECT_EQ(class_at(frames[0], u, v), SemanticClass::pedestrian);
    EXPECT_NE(class_at(frames[0], u, v - 6), SemanticClass::pedestrian) << "0.6 m above the head";
}

TEST(Sensors, DoesNotSeeTheCarThatCarriesIt) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = busy_tick();
    world::SensorSpec inside = camera(SensorKind::semantic, {1, 0, 0.9});
    inside.actor = 1;
    world::SensorSpec behind = camera(SensorKind::semantic, {32, -1.75, 1.4});
    const auto frames = sensors.observe(tick.view(), {inside, behind}, test::noon());
    EXPECT_EQ(class_at(frames[0], 80, 118), SemanticClass::road)
        << "the floor and hood are in the way";
    EXPECT_EQ(class_at(frames[1], 80, 70), SemanticClass::car) << "others still see the car";
}

TEST(Sensors, SeesTheCarThatItIsMountedOnFromOutsideOfIt) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = tick_with({test::vehicle_at(1, 100, -1.75)});
    // Where the middle of the car is in the picture: 4 m up, looking ahead; a sedan's is 0.7 m up.
    const auto seen_from = [&](double ahead, double up) {
        world::SensorSpec spec = camera(SensorKind::semantic, {ahead, 0, up});
        spec.actor = 1;
        const auto frames = sensors.observe(tick.view(), {spec}, test::noon());
        const double away = 1.35 - ahead;
        const int row = 60 + static_cast<int>(80 * (up - 0.7) / away);
        return class_at(frames[0], 80, std::min(row, 119));
    };
    EXPECT_EQ(seen_from(-8, 4), SemanticClass::car) << "behind and above";
    EXPECT_EQ(seen_from(-12, 2), SemanticClass::car);
    for (const double ahead : {-0.5, 0.0, 1.0})
        for (const double up : {1.0, 1.4, 1.8})
            EXPECT_NE(seen_from(ahead, up), SemanticClass::car)
                << "in it, or on its roof: " << ahead << ' ' << up;
}

TEST(Sensors, OneThatIsCarriedDoesNotHideTheCarFromOneThatLooksOn) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = tick_with({test::vehicle_at(1, 100, -1.75)});
    world::SensorRig rig{camera(SensorKind::semantic, {1, 0, 1.4}),
                         camera(SensorKind::semantic, {-8, 0, 4})};
    for (world::SensorSpec& spec : rig)
        spec.actor = 1;
    const auto frames = sensors.observe(tick.view(), rig, test::noon());
    for (std::size_t i = 0; i < rig.size(); ++i) {
        const auto alone = sensors.observe(tick.view(), {rig[i]}, test::noon());
        EXPECT_TRUE(alone[0].data == frames[i].data) << i;
        const auto cars = std::count(frames[i].data.begin(),
                                     frames[i].data.end(),
                                     static_cast<std::uint8_t>(SemanticClass::car));
        EXPECT_EQ(cars > 0, i == 1) << cars;
    }
}

TEST(Sensors, DepthAndClassesAreTheSameUnderEveryWeather) {
    render::Sensors sensors(test::straight_road_with_signal(400));
    const world::SealedTick tick = busy_tick();
    world::SensorRig rig{camera(SensorKind::depth, {1, 0, 1.4}),
                         camera(SensorKind::semantic, {1, 0, 1.4}),
                         camera(SensorKind::rgb, {1, 0, 1.4})};
    for (world::SensorSpec& spec : rig)
        spec.actor = 1;
    const auto dry = sensors.observe(tick.view(), rig, test::noon());
    const auto wet = sensors.observe(tick.view(), rig, test::rain());
    EXPECT_EQ(dry[0].data, wet[0].data);
    EXPECT_EQ(dry[1].data, wet[1].data);
    EXPECT_NE(dry[2].data, wet[2].data);
}

TEST(Sensors, SharedAndSingleLooksAgree) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = busy_tick();
    const world::SensorRig rig{camera(SensorKind::rgb, {45, 0, 1.4}),
                               camera(SensorKind::depth, {45, 0, 1.4})};
    const auto together = sensors.observe(tick.view(), rig, test::noon());
    for (std::size_t i = 0; i < rig.size(); ++i)
        EXPECT_EQ(sensors.observe(tick.view(), {rig[i]}, test::noon())[0].data, together[i].data);
}

TEST(Sensors, FramesSayWhatTheyAre) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = tick_with({}, {}, {}, 17);
    world::SensorSpec spec = camera(SensorKind::rgb);
    spec.width = 37;  // no multiple of anything
    spec.height = 19;
    world::SensorSpec depth = spec;
    depth.kind = SensorKind::depth;
    const auto frames = sensors.observe(tick.view(), {spec, depth}, test::noon());
    EXPECT_EQ(frames[0].name, "camera");
    EXPECT_EQ(frames[0].tick, 17U);
    EXPECT_EQ(frames[0].data.size(), 37U * 19U * 3U);
    EXPECT_EQ(frames[1].type, world::PixelType::f32);
    EXPECT_EQ(frames[1].data.size(), 37U * 19U * sizeof(float));
}

TEST(Sensors, NamesTheActorThatIsNotThere) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = tick_with({}, {}, {}, 12);
    world::SensorSpec spec = camera(SensorKind::rgb);
    spec.name = "front";
    spec.actor = 99;
    try {
        sensors.observe(tick.view(), {spec}, test::noon());
        FAIL() << "no error";
    } catch (const world::Error& error) {
        EXPECT_STREQ(error.what(), "sensor 'front': there is no actor 99 at tick 12");
    }
}

}  // namespace reprise
