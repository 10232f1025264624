#include <gmock/gmock.h>

#include "tests/render/frames.h"
#include "world/models/catalogue.h"

namespace reprise {

namespace {

using test::camera;
using test::car_at;
using test::mean;
using world::SensorKind;

/// Red less green of the road between the camera and a car that brakes or does not.
double red_on_the_road(const world::Weather& weather, bool brakes) {
    render::Sensors sensors(test::straight_road(400));
    world::CarState car = car_at(6, 112, -1.75);
    if (brakes)
        car.mutate_lamps(world::lamp_brake);
    const world::SealedTick tick = test::tick_with({}, {car});
    const auto frames =
        sensors.observe(tick.view(), {camera(SensorKind::rgb, {100, -1.75, 1.4})}, weather);
    // The lamps, 0.8 m high, 0.7 m to both sides and 11 m away, stand 0.8 m below the road in the
    // mirror: at rows 60 + 80 * (1.4 + 0.8) / 11 and columns 80 +- 80 * 0.7 / 11.
    return mean(frames[0], 0, 73, 74, 87, 80) - mean(frames[0], 1, 73, 74, 87, 80);
}

}  // namespace

TEST(Weather, WetRoadMirrorsBrakeLamps) {
    const double wet = red_on_the_road(test::rain(), true) - red_on_the_road(test::rain(), false);
    const double dry = red_on_the_road(test::noon(), true) - red_on_the_road(test::noon(), false);
    EXPECT_GT(wet, 2) << "of 255";
    EXPECT_NEAR(dry, 0, 0.5);
}

TEST(Weather, SignalsShowTheTicksColour) {
    world::TownT town = test::straight_road_with_signal(400);
    render::Sensors sensors(town);
    const auto picture = [&](world::SignalColor color) {
        const world::SealedTick tick = test::tick_with({}, {}, {color});
        // Three metres before the head, which stands at the right kerb.
        world::SensorSpec spec =
            camera(SensorKind::rgb, {town.signals[0].position.x() - 3, -4.1, 3});
        return sensors.observe(tick.view(), {spec}, test::noon())[0];
    };
    const auto red = picture(world::SignalColor::red);
    const auto green = picture(world::SignalColor::green);
    int redder = 0;
    int greener = 0;
    for (std::size_t i = 0; i < red.data.size(); i += 3) {
        redder += red.data[i] > red.data[i + 1] + 80 && green.data[i] < 80 ? 1 : 0;
        greener += green.data[i + 1] > green.data[i] + 80 && red.data[i + 1] < 80 ? 1 : 0;
    }
    EXPECT_GT(redder, 5);
    EXPECT_GT(greener, 5);
}

TEST(Weather, FogHidesWhatIsFar) {
    render::Sensors sensors(test::straight_road(400));
    world::CarState dark = car_at(2, 160, -1.75);
    const auto contrast = [&](const world::Weather& weather) {
        const auto with = sensors.observe(test::tick_with({}, {dark}).view(),
                                          {camera(SensorKind::rgb, {100, -1.75, 1.4})},
                                          weather)[0];
        const auto without = sensors.observe(
            test::tick_with({}).view(), {camera(SensorKind::rgb, {100, -1.75, 1.4})}, weather)[0];
        return std::abs(mean(with, 1, 79, 59, 81, 61) - mean(without, 1, 79, 59, 81, 61));
    };
    world::Weather foggy = test::noon();
    foggy.mutate_fog_extinction(0.1F);
    EXPECT_LT(contrast(foggy), 0.1 * contrast(test::noon()));
}

TEST(Weather, ClearSkiesAreBlueAndOvercastOnesGrey) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = test::tick_with({});
    const auto sky = [&](const world::Weather& weather) {
        const auto frame =
            sensors.observe(tick.view(), {camera(SensorKind::rgb, {100, -1.75, 1.4})}, weather)[0];
        return mean(frame, 2, 0, 0, 159, 30) - mean(frame, 0, 0, 0, 159, 30);
    };
    EXPECT_GT(sky(test::noon()), 30) << "a clear sky is blue";
    EXPECT_LT(sky(test::rain()), 20) << "an overcast one is grey";
}

}  // namespace reprise
