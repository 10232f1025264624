#include <array>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "render/labels/boxes.h"
#include "render/sensors.h"
#include "tests/render/street.h"
#include "world/external/instance_id.h"

namespace reprise {

namespace {

using test::camera;
using test::car_at;
using world::SensorKind;

template <typename Value>
Value value_at(const world::SensorFrame& frame, int u, int v, int channel = 0) {
    Value value{};
    const int index = (v * frame.width + u) * frame.channels + channel;
    std::memcpy(
        &value, frame.data.data() + static_cast<std::size_t>(index) * sizeof(Value), sizeof(Value));
    return value;
}

double flow_at(const world::SensorFrame& frame, int u, int v, int channel) {
    return static_cast<double>(value_at<float>(frame, u, v, channel));
}

/// Five metres on, a car that carries a camera and one ahead of it that goes one metre.
world::SealedTick before() {
    return test::tick_with({test::vehicle_at(1, 35, -1.75)}, {car_at(10, 54, -1.75)});
}

world::SealedTick after() {
    return test::tick_with({test::vehicle_at(1, 40, -1.75)}, {car_at(10, 55, -1.75)});
}

world::SensorSpec carried(SensorKind kind) {
    world::SensorSpec spec = camera(kind, {1, 0, 1.4});
    spec.actor = 1;
    return spec;
}

/// Somebody on a road, who crosses it: walks, stands, runs or lies.
world::SealedTick person(std::uint32_t number) {
    world::TickDraft draft;
    draft.tick.index = 40;
    const auto models = static_cast<std::uint16_t>(world::walker_models().size());
    draft.traffic.walkers.emplace_back(world::Vec3(200, 0, 0),
                                       number % 2 == 0 ? 1.5708F : -1.5708F,
                                       std::array{1.4F, 0.0F, 3.0F}.at(number % 3),
                                       0.17F * static_cast<float>(number),
                                       20,
                                       static_cast<std::uint16_t>(11 * number % models),
                                       number == 4,
                                       std::uint8_t{0},
                                       77 * number);
    return world::seal(draft, {});
}

}  // namespace

/// From so far away, so narrowly, that what is near is hardly larger than what is behind it.
TEST(Labels, ABoxInSpaceEndsWhereSomebodyOnFootEnds) {
    render::Sensors sensors(test::straight_road_with_signal(400));
    world::SensorSpec spec = camera(SensorKind::instance, {50, 0, 1.1});
    spec.fov = 2.8 / 150;  // [m] of the picture there
    spec.width = spec.height = 280;
    world::SensorSpec classes = spec;
    classes.kind = SensorKind::semantic;
    for (std::uint32_t number = 0; number < 12; ++number) {
        const world::SealedTick tick = person(number);
        const auto frames = sensors.observe(tick.view(), {spec, classes}, test::noon());
        const auto boxes = render::boxes_of(tick.view(),
                                            {},
                                            render::Camera(spec, Eigen::Isometry3d::Identity()),
                                            frames[0],
                                            frames[1]);
        ASSERT_EQ(boxes.size(), 1U) << number;
        constexpr double rounding = 2;  // [px] of a centimetre each
        EXPECT_NEAR(boxes[0].whole.left, boxes[0].seen.left, rounding) << number;
        EXPECT_NEAR(boxes[0].whole.right, boxes[0].seen.right, rounding) << number;
        EXPECT_NEAR(boxes[0].whole.top, boxes[0].seen.top, rounding) << number;
        EXPECT_NEAR(boxes[0].whole.bottom, boxes[0].seen.bottom, rounding) << number;
    }
}

/// Its body with mass stands upright, or rolls outwards: what is seen leans into the bend.
TEST(Labels, ABoxInSpaceEndsWhereATwoWheelerEndsThatLeansIntoABend) {
    for (const char* name : {"bicycle", "motorcycle"}) {
        const std::uint16_t model = world::find_vehicle_model(name).value();
        for (const double yaw_rate : {-0.6, 0.0, 0.6}) {
            world::VehicleState rider = test::vehicle_at(1, 200, -1.75, 0, 7);
            rider.mutate_model(model);
            rider.mutable_angular_velocity().mutate_z(yaw_rate);
            const world::SealedTick tick = test::tick_with({rider});
            render::Sensors sensors(test::straight_road(400));
            world::SensorSpec spec = camera(SensorKind::instance, {100, -1.75, 0.9});
            spec.fov = 2.8 / 100;  // [m] of the picture there
            spec.width = spec.height = 280;
            world::SensorSpec classes = spec;
            classes.kind = SensorKind::semantic;
            const auto frames = sensors.observe(tick.view(), {spec, classes}, test::noon());
            const auto boxes = render::boxes_of(tick.view(),
                                                {},
                                                render::Camera(spec, Eigen::Isometry3d::Identity()),
                                                frames[0],
                                                frames[1]);
            ASSERT_EQ(boxes.size(), 1U) << name;
            constexpr double rounding = 3;  // [px] of a centimetre each
            EXPECT_LT(boxes[0].whole.left, boxes[0].seen.left + rounding) << name << yaw_rate;
            EXPECT_GT(boxes[0].whole.right, boxes[0].seen.right - rounding) << name << yaw_rate;
            EXPECT_LT(boxes[0].whole.top, boxes[0].seen.top + rounding) << name << yaw_rate;
            EXPECT_GT(boxes[0].whole.bottom, boxes[0].seen.bottom - rounding) << name << yaw_rate;
            const world::VehicleModel& catalogue = world::vehicle_models()[model];
            EXPECT_LT(boxes[0].size.y(), catalogue.width + 0.25) << name;
            EXPECT_LT(boxes[0].size.z(), catalogue.height + 0.12) << name;
        }
    }
}

TEST(Labels, ACarThatStandsInTheTownHasABox) {
    world::TownT town = test::street();
    const auto prop = [](double x, world::PropKind kind, std::uint16_t value) {
        return world::Prop(world::Vec3(x, -5, 0.1), 0, 4, 1.8, 1.4, 5, value, kind, 0);
    };
    town.props = {prop(40, world::PropKind::bench, 0),
                  prop(48, world::PropKind::parked_vehicle, 1)};
    const auto parked = render::parked_vehicles(town);
    ASSERT_EQ(parked.size(), 1U);
    EXPECT_EQ(parked[0].thing, world::TownThings(town).props + 1);
    EXPECT_EQ(parked[0].model, 1);
    render::Sensors sensors(town);
    const world::SealedTick tick = test::tick_with({}, {});
    const world::SensorSpec spec = camera(SensorKind::instance, {40, 0, 1.4});
    world::SensorSpec classes = spec;
    classes.kind = SensorKind::semantic;
    const auto frames = sensors.observe(tick.view(), {spec, classes}, test::noon());
    const auto boxes = render::boxes_of(tick.view(),
                                        parked,
                                        render::Camera(spec, Eigen::Isometry3d::Identity()),
                                        frames[0],
                                        frames[1]);
    ASSERT_EQ(boxes.size(), 1U);
    EXPECT_EQ(boxes[0].thing, parked[0].thing);
    EXPECT_EQ(boxes[0].actor, 0U);
    EXPECT_EQ(boxes[0].what, world::SemanticClass::car);
    EXPECT_GT(boxes[0].pixels, 100U);
    EXPECT_GE(boxes[0].seen.left, boxes[0].whole.left - 1);
    EXPECT_LE(boxes[0].seen.right, boxes[0].whole.right + 1);
    EXPECT_LE(boxes[0].seen.bottom, boxes[0].whole.bottom + 1);
}

TEST(Labels, InstancesAreThoseOfActorsAndOfTheTownsThings) {
    const world::TownT town = test::street();
    render::Sensors sensors(town);
    const world::SealedTick tick = test::street_tick();
    const world::SensorSpec spec = carried(SensorKind::instance);
    const world::SensorFrame frame = sensors.observe(tick.view(), {spec}, test::noon())[0];
    std::set<std::uint16_t> found;
    for (int v = 0; v < frame.height; ++v)
        for (int u = 0; u < frame.width; ++u)
            found.insert(value_at<std::uint16_t>(frame, u, v));
    const world::TownThings things(town);
    EXPECT_TRUE(found.count(0)) << "road and sky";
    for (const std::uint32_t actor : {10U, 11U, 20U})
        EXPECT_TRUE(found.count(world::instance_of_actor(actor)) == 1 || actor == 20) << actor;
    EXPECT_TRUE(found.count(world::instance_of_thing(0))) << "the first building";
    EXPECT_TRUE(found.count(world::instance_of_thing(things.trees + 1))) << "the second tree";
    EXPECT_FALSE(found.count(world::instance_of_actor(1))) << "who carries the camera";
}

/// Numbers of instances and classes come from two ways through the scene.
TEST(Labels, WhatHasTheInstanceOfACarHasTheClassOfACar) {
    render::Sensors sensors(test::street());
    const auto frames =
        sensors.observe(test::street_tick().view(),
                        {carried(SensorKind::instance), carried(SensorKind::semantic)},
                        test::noon());
    int cars = 0;
    for (int v = 0; v < 120; ++v)
        for (int u = 0; u < 160; ++u) {
            const bool is_car = test::class_at(frames[1], u, v) == world::SemanticClass::car;
            const std::uint16_t instance = value_at<std::uint16_t>(frames[0], u, v);
            EXPECT_EQ(is_car, instance >= 10 && instance <= 13) << u << ' ' << v;
            cars += is_car ? 1 : 0;
        }
    EXPECT_GT(cars, 100);
}

TEST(Labels, TheNormalOfARoadPointsUp) {
    render::Sensors sensors(test::straight_road(400));
    const world::SensorFrame frame =
        sensors.observe(test::tick_with({}).view(),
                        {camera(SensorKind::normals, {100, -1.75, 1.4})},
                        test::noon())[0];
    EXPECT_NEAR(static_cast<double>(value_at<float>(frame, 80, 100, 0)), 0, 1e-6);
    EXPECT_NEAR(static_cast<double>(value_at<float>(frame, 80, 100, 1)), -1, 1e-6) << "y is down";
    EXPECT_NEAR(static_cast<double>(value_at<float>(frame, 80, 100, 2)), 0, 1e-6);
    for (const int channel : {0, 1, 2})
        EXPECT_EQ(value_at<float>(frame, 80, 5, channel), 0) << "the sky has none";
}

/// The road is a plane: a pixel that sees it z metres ahead saw it z + 5 metres ahead when the
/// camera was five metres behind.
TEST(Labels, TheRoadFlowsAsTheCameraDrives) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick last = before();
    const world::SealedTick tick = after();
    const auto frames = sensors.observe(tick.view(),
                                        {carried(SensorKind::flow), carried(SensorKind::depth)},
                                        test::noon(),
                                        {.last = render::Neighbour{last.view(), {}}, .next = {}});
    for (int v = 100; v < 120; ++v)
        for (const int u : {20, 80, 140}) {
            const auto z = static_cast<double>(test::depth_at(frames[1], u, v));
            const double share = 1 - z / (z + 5);
            EXPECT_NEAR(flow_at(frames[0], u, v, 0), (u + 0.5 - 80) * share, 1e-4);
            EXPECT_NEAR(flow_at(frames[0], u, v, 1), (v + 0.5 - 60) * share, 1e-4);
        }
    EXPECT_NEAR(flow_at(frames[0], 80, 5, 0), 0, 1e-4) << "the sky stays";
}

/// What moved into a pixel from the last tick moves out of its old place until the next one.
TEST(Labels, FlowThereIsFlowBack) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick last = before();
    const world::SealedTick tick = after();
    world::SensorSpec forward = carried(SensorKind::flow);
    forward.attributes = {{"forward", 1}};
    const auto now = sensors.observe(tick.view(),
                                     {carried(SensorKind::flow), carried(SensorKind::instance)},
                                     test::noon(),
                                     {.last = render::Neighbour{last.view(), {}}, .next = {}});
    const auto then = sensors.observe(last.view(),
                                      {forward, carried(SensorKind::instance)},
                                      test::noon(),
                                      {.last = {}, .next = render::Neighbour{tick.view(), {}}});
    int compared = 0;
    for (int v = 0; v < 120; ++v)
        for (int u = 0; u < 160; ++u) {
            if (value_at<std::uint16_t>(now[1], u, v) != 10)
                continue;
            const double x = u - flow_at(now[0], u, v, 0);
            const double y = v - flow_at(now[0], u, v, 1);
            const auto near_u = static_cast<int>(std::lround(x));
            const auto near_v = static_cast<int>(std::lround(y));
            if (value_at<std::uint16_t>(then[1], near_u, near_v) != 10)
                continue;
            EXPECT_NEAR(flow_at(then[0], near_u, near_v, 0), flow_at(now[0], u, v, 0), 0.5);
            EXPECT_NEAR(flow_at(then[0], near_u, near_v, 1), flow_at(now[0], u, v, 1), 0.5);
            ++compared;
        }
    EXPECT_GT(compared, 50);
}

TEST(Labels, FlowIsUnknownWithoutAnotherTickAndOfWhoWasNotThere) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = after();
    const world::SensorRig rig{carried(SensorKind::flow), carried(SensorKind::instance)};
    const auto alone = sensors.observe(tick.view(), rig, test::noon());
    EXPECT_TRUE(std::isnan(flow_at(alone[0], 80, 110, 0)));
    const world::SealedTick empty = test::tick_with({test::vehicle_at(1, 35, -1.75)});
    const auto frames = sensors.observe(
        tick.view(), rig, test::noon(), {.last = render::Neighbour{empty.view(), {}}, .next = {}});
    for (int v = 0; v < 120; ++v)
        for (int u = 0; u < 160; ++u)
            EXPECT_EQ(std::isnan(flow_at(frames[0], u, v, 0)),
                      value_at<std::uint16_t>(frames[1], u, v) == 10)
                << u << ' ' << v;
}

TEST(Labels, TheCarrierIsSeenWhereItIsWished) {
    render::Sensors sensors(test::straight_road(400));
    world::SensorSpec spec = camera(SensorKind::semantic, {0.2, 0, 1.75});
    spec.actor = 1;
    spec.pitch = -0.5;
    world::SensorSpec own = spec;
    own.attributes = {{"own_car", 1}};
    const auto frames = sensors.observe(
        test::tick_with({test::vehicle_at(1, 40, -1.75)}).view(), {spec, own}, test::noon());
    const auto cars = [](const world::SensorFrame& frame) {
        return std::count(frame.data.begin(),
                          frame.data.end(),
                          static_cast<std::uint8_t>(world::SemanticClass::car));
    };
    EXPECT_EQ(cars(frames[0]), 0);
    EXPECT_GT(cars(frames[1]), 1000);
}

TEST(Labels, ARolledCameraTurnsThePicture) {
    render::Sensors sensors(test::straight_road(400));
    world::SensorSpec spec = camera(SensorKind::semantic, {100, -1.75, 1.4});
    spec.roll = 1.5707963267948966;  // its right side is down: the sky is on its left
    const auto frame = sensors.observe(test::tick_with({}).view(), {spec}, test::noon())[0];
    EXPECT_EQ(test::class_at(frame, 10, 60), world::SemanticClass::sky);
    EXPECT_NE(test::class_at(frame, 150, 60), world::SemanticClass::sky);
}

/// Behind the meadows of a town's border.
TEST(Labels, OfLandFarOffStayTerrainThoughFieldsAndWoodsAreSeen) {
    render::Sensors sensors(test::straight_road(400));
    world::SensorSpec eye = camera(SensorKind::rgb, {200, 0, 60});
    eye.yaw = 1.5707963;
    eye.pitch = -0.15;
    world::SensorSpec classes = eye;
    classes.kind = SensorKind::semantic;
    const auto frames = sensors.observe(test::tick_with({}).view(), {eye, classes}, test::noon());
    int seen = 0;
    int ripe = 0;   // or ploughed: more red than green
    int woods = 0;  // dark
    for (int row = 55; row < 100; ++row) {
        for (int column = 0; column < 160; ++column) {
            EXPECT_EQ(test::class_at(frames[1], column, row), world::SemanticClass::terrain);
            const double red = test::mean(frames[0], 0, column, row, column, row);
            const double green = test::mean(frames[0], 1, column, row, column, row);
            ++seen;
            ripe += red > green ? 1 : 0;
            woods += green < 95 ? 1 : 0;
        }
    }
    EXPECT_GT(ripe, seen / 12);
    EXPECT_LT(ripe, seen / 2);
    EXPECT_GT(woods, seen / 50);
    EXPECT_LT(woods, seen / 2);
}

}  // namespace reprise
