#include <algorithm>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "render/car_parts.h"
#include "render/paint.h"
#include "render/two_wheeler.h"
#include "tests/render/frames.h"
#include "world/catalogue.h"

namespace reprise {
namespace {

using test::camera;
using test::car_at;
using world::SemanticClass;
using world::SensorKind;

/// Sums of red over the pictures from behind and from ahead of a standing model.
struct Glow {
    double behind;
    double ahead;
};

Glow glow_of(render::Sensors& sensors, std::uint16_t model, int lamps, std::uint64_t tick) {
    world::CarState car = car_at(7, 120, -1.75);
    car.mutate_model(model);
    car.mutate_lamps(static_cast<std::uint16_t>(lamps));
    const world::SealedTick sealed = test::tick_with({}, {car}, {}, tick);
    const world::VehicleModel& m = world::vehicle_models()[model];
    const double back = 120 - m.rear_overhang - 4.5;
    const double front = 120 + m.length - m.rear_overhang + 4.5;
    world::SensorSpec behind = camera(SensorKind::rgb, {back, -1.75, 1.1});
    world::SensorSpec ahead = camera(SensorKind::rgb, {front, -1.75, 1.1});
    ahead.yaw = 3.14159265;
    for (world::SensorSpec* spec : {&behind, &ahead})
        spec->fov = 0.9;
    const auto frames = sensors.observe(sealed.view(), {behind, ahead}, test::noon());
    return {test::mean(frames[0], 0, 0, 0, 159, 119), test::mean(frames[1], 0, 0, 0, 159, 119)};
}

TEST(Vehicles, LampsLightWhereTheyBelong) {
    render::Sensors sensors(test::straight_road(400));
    constexpr std::uint64_t lit = 40;  // see flashes_now
    constexpr std::uint64_t dark = 50;
    for (std::uint16_t model = 0; model < world::vehicle_models().size(); ++model) {
        const world::VehicleModel& m = world::vehicle_models()[model];
        SCOPED_TRACE(m.name);
        const bool bicycle = m.body == world::BodyStyle::bicycle;
        const Glow none = glow_of(sensors, model, 0, lit);
        EXPECT_GT(glow_of(sensors, model, world::lamp_brake, lit).behind, none.behind + 0.02);
        EXPECT_GT(glow_of(sensors, model, world::lamp_low_beam, lit).ahead, none.ahead + 0.02);
        if (bicycle)
            continue;  // arms, not lamps
        EXPECT_GT(glow_of(sensors, model, world::lamp_left, lit).ahead, none.ahead + 0.004);
        EXPECT_GT(glow_of(sensors, model, world::lamp_right, lit).behind, none.behind + 0.004);
        EXPECT_EQ(glow_of(sensors, model, world::lamp_right, dark).behind,
                  glow_of(sensors, model, 0, dark).behind);
    }
}

TEST(Vehicles, IndicatorsFlashThreeTimesInTwoSeconds) {
    int starts = 0;
    for (std::uint64_t tick = 1; tick <= 400; ++tick)  // 20 s
        starts += render::flashes_now(tick) && !render::flashes_now(tick - 1) ? 1 : 0;
    EXPECT_EQ(starts, 30);
}

TEST(Vehicles, EachModelHasTheClassOfItsKind) {
    render::Sensors sensors(test::straight_road(400));
    for (const auto& [name, expected, rider] :
         {std::tuple{"motorcycle", SemanticClass::motorcycle, true},
          {"bicycle", SemanticClass::bicycle, true},
          {"ambulance", SemanticClass::car, false},
          {"pickup", SemanticClass::car, false}}) {
        world::CarState car = car_at(7, 110, -1.75);
        car.mutate_model(*world::find_vehicle_model(name));
        const world::SealedTick tick = test::tick_with({}, {car});
        const auto frames = sensors.observe(
            tick.view(), {camera(SensorKind::semantic, {105, -1.75, 1.0})}, test::noon());
        std::set<SemanticClass> seen;
        for (const std::uint8_t pixel : frames[0].data)
            seen.insert(static_cast<SemanticClass>(pixel));
        EXPECT_TRUE(seen.contains(expected)) << name;
        EXPECT_EQ(seen.contains(SemanticClass::rider), rider) << name;
    }
}

TEST(Vehicles, PaintIsThatOfTheLookAndTheKind) {
    const auto models = world::vehicle_models();
    const world::VehicleModel& sedan = models[*world::find_vehicle_model("sedan")];
    const world::VehicleModel& taxi = models[*world::find_vehicle_model("taxi")];
    std::set<std::tuple<float, float, float>> sedans;
    std::set<std::tuple<float, float, float>> taxis;
    const auto note = [](auto& colors, const render::Color& color) {
        colors.emplace(color.x(), color.y(), color.z());
    };
    for (std::uint32_t look = 1; look < 500; ++look) {
        note(sedans, render::paint_of(sedan, look).body);
        note(taxis, render::paint_of(taxi, look).body);
    }
    EXPECT_EQ(sedans.size(), 15U);
    EXPECT_EQ(taxis.size(), 3U);
}

TEST(Vehicles, WheelsTouchTheGroundAndNothingElseDoes) {
    for (const world::VehicleModel& model : world::vehicle_models()) {
        const render::CarShape shape(model);
        const bool thin = world::is_two_wheeler(model.body);
        const render::Mesh wheel = thin ? thin_wheel_mesh(shape) : wheel_mesh(shape);
        const auto radius = static_cast<float>(model.wheel_radius);
        float lowest = 0;
        for (const Eigen::Vector3f& vertex : wheel.vertices)
            lowest = std::min(lowest, vertex.z());
        EXPECT_NEAR(lowest, -radius, 0.004) << model.name;
        const render::Mesh body = thin ? two_wheeler_mesh(shape) : car_body_mesh(shape);
        for (const Eigen::Vector3f& vertex : body.vertices)
            EXPECT_GT(vertex.z(), 0.08) << model.name;
    }
}

}  // namespace
}  // namespace reprise
