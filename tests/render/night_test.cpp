#include <gmock/gmock.h>

#include "render/look/sky.h"
#include "tests/render/street.h"
#include "world/models/catalogue.h"

namespace reprise {

namespace {

using test::camera;
using test::car_at;
using test::mean;
using world::SensorKind;

constexpr float degree = 0.0174532925F;

world::Weather with_sun(world::Weather weather, float altitude_deg) {
    weather.mutate_sun_altitude(altitude_deg * degree);
    return weather;
}

/// Finer where the sky changes fast.
std::vector<float> altitudes_deg() {
    std::vector<float> all;
    for (float deg = -90; deg <= 90; deg += deg >= -9 && deg < 6 ? 0.5F : 4.5F)
        all.push_back(deg);
    return all;
}

bool is_light(const render::Color& color) {
    return color.is_finite() && color.minCoeff() >= 0 && color.maxCoeff() < 1e4F;
}

world::SensorFrame look(const world::TownT& town,
                        const world::SealedTick& tick,
                        const world::SensorSpec& spec,
                        const world::Weather& weather) {
    render::Sensors sensors(town);
    return sensors.observe(tick.view(), {spec}, weather)[0];
}

world::Weather clear_night() {
    return with_sun(test::noon(), -20);
}

/// Straight down from 40 m over the world's origin: 2 px a metre, east up, north to the left.
world::SensorSpec from_above(Eigen::Vector3d position) {
    world::SensorSpec spec = camera(SensorKind::rgb, std::move(position));
    spec.pitch = -1.5707963;
    return spec;
}

world::TownT street_with_light(bool wall) {
    world::TownT town = test::straight_road(400);
    // The arm reaches over the road; a wall of 4 m stands across the road, 6 m farther on.
    town.props = {world::Prop(
        world::Vec3(100, -5, 0), 1.5708, 2, 0.2, 7.5, 0, 0, world::PropKind::street_light, 0)};
    if (wall)
        town.props.emplace_back(
            world::Vec3(106, -1, 0), 1.5708, 9, 0.3, 4, 0, 0, world::PropKind::wall, 0);
    return town;
}

}  // namespace

TEST(Night, LightAndExposureAreFiniteAndMonotoneForEverySun) {
    for (const test::NamedWeather& weather : test::weathers()) {
        if (weather.weather == test::rain())
            continue;  // between the other two
        float last_exposure = 0;
        float last_light = 0;
        for (const float deg : altitudes_deg()) {
            const render::Sky sky(with_sun(weather.weather, deg));
            SCOPED_TRACE(std::string(weather.name) + ", sun at " + std::to_string(deg));
            const float exposure = sky.exposure();
            ASSERT_TRUE(std::isfinite(exposure) && exposure > 0) << exposure;
            for (const Eigen::Vector3f& way : {Eigen::Vector3f(0, 0, 1),
                                               Eigen::Vector3f(0.8F, 0, 0.6F),
                                               Eigen::Vector3f(-0.6F, 0.79F, 0.1F),
                                               sky.to_sun(),
                                               sky.moon().to_moon}) {
                EXPECT_TRUE(is_light(sky.radiance(way.normalized(), true)));
                EXPECT_TRUE(is_light(sky.radiance(way.normalized(), false)));
                EXPECT_TRUE(is_light(sky.ambient(way.normalized())));
                EXPECT_TRUE(is_light(sky.haze(way.normalized())));
            }
            const float light = render::luminance(sky.ambient(Eigen::Vector3f::UnitZ()));
            if (last_exposure > 0) {
                // A part in a thousand: the sum over the sky is made of a few hundred places.
                EXPECT_LE(exposure, last_exposure * 1.001F) << "the more light, the shorter";
                // Twilight itself doubles every degree.
                if (deg > -9 && deg <= 6) {
                    EXPECT_GT(exposure, last_exposure * 0.53F) << "a step";
                    EXPECT_GE(light, last_light * 0.98F) << "the higher the sun, the lighter";
                    EXPECT_LE(light, last_light * 1.95F + 1e-9F) << "a step";
                }
            }
            last_exposure = exposure;
            last_light = light;
        }
    }
}

TEST(Night, LampsComeOnWithoutAStepAndShineByNightAlone) {
    EXPECT_EQ(render::Sky(test::noon()).lamplight(), 0);
    EXPECT_EQ(render::Sky(test::noon()).headlamps(), 0);
    EXPECT_EQ(render::Sky(clear_night()).lamplight(), 1);
    EXPECT_EQ(render::Sky(clear_night()).headlamps(), 1);
    float last = 1;
    for (float deg = -9; deg < 12; deg += 0.25F) {
        const render::Sky sky(with_sun(test::noon(), deg));
        EXPECT_LE(sky.lamplight(), last);
        EXPECT_GT(sky.lamplight(), last - 0.25F) << "at " << deg;
        EXPECT_GE(sky.headlamps(), sky.lamplight()) << "drivers are earlier than towns";
        last = sky.lamplight();
    }
}

TEST(Night, LitLampsKeepTheirColourByDayAndNight) {
    const world::TownT town = test::straight_road_with_signal(400);
    render::Sensors sensors(town);
    world::SensorSpec spec = camera(SensorKind::rgb, {town.signals[0].position.x() - 3, -4.1, 3});
    const auto brightest =
        [&](world::SignalColor color, const world::Weather& weather, int channel) {
            const world::SealedTick tick = test::tick_with({}, {}, {color});
            const auto lit = sensors.observe(tick.view(), {spec}, weather)[0];
            const auto off = sensors.observe(
                test::tick_with({}, {}, {world::SignalColor::off}).view(), {spec}, weather)[0];
            std::array<int, 3> best{};
            int most = 0;
            for (std::size_t i = 0; i < lit.data.size(); i += 3) {
                const int gain = lit.data[i + static_cast<std::size_t>(channel)] -
                                 off.data[i + static_cast<std::size_t>(channel)];
                if (gain > most) {
                    most = gain;
                    best = {lit.data[i], lit.data[i + 1], lit.data[i + 2]};
                }
            }
            return best;
        };
    for (const float deg : {55.0F, 5.0F, -3.0F, -20.0F}) {
        SCOPED_TRACE(deg);
        const world::Weather weather = with_sun(test::noon(), deg);
        const auto red = brightest(world::SignalColor::red, weather, 0);
        EXPECT_GT(red[0], 200);
        EXPECT_LT(red[1], 60);
        EXPECT_LT(red[2], 60);
        const auto yellow = brightest(world::SignalColor::yellow, weather, 0);
        EXPECT_GT(yellow[0], 200);
        EXPECT_LT(yellow[2], 60);
        EXPECT_GT(yellow[1], 100);
        EXPECT_LT(yellow[1], 215);
        const auto green = brightest(world::SignalColor::green, weather, 1);
        EXPECT_GT(green[1], 200);
        EXPECT_LT(green[0], 60);
        EXPECT_LT(green[2], 160);
    }
}

/// The sun stands low behind the driver, where flat lenses and cases would mirror it to him.
TEST(Night, LitLampsKeepTheirColourInALowSunThatTheyFace) {
    const world::TownT town = test::straight_road_with_signal(400);
    render::Sensors sensors(town);
    const world::SensorSpec spec =
        camera(SensorKind::rgb, {town.signals[0].position.x() - 3, -4.1, 3});
    const auto picture = [&](world::SignalColor color, const world::Weather& weather) {
        const world::SealedTick tick = test::tick_with({}, {}, {color});
        return sensors.observe(tick.view(), {spec}, weather)[0].data;
    };
    const auto lit = picture(world::SignalColor::red, test::noon());
    const auto off = picture(world::SignalColor::off, test::noon());
    std::vector<std::size_t> lens;
    for (std::size_t i = 0; i < lit.size(); i += 3)
        if (lit[i] > off[i] + 150)
            lens.push_back(i);
    ASSERT_GT(lens.size(), 20U);
    for (const float deg : {2.0F, 4.0F, 8.0F, 14.0F}) {
        world::Weather weather = with_sun(test::noon(), deg);
        weather.mutate_sun_azimuth(180 * degree);
        const auto low = picture(world::SignalColor::red, weather);
        const auto red = std::count_if(lens.begin(), lens.end(), [&](std::size_t i) {
            return low[i] > 200 && low[i + 1] < 90 && low[i + 2] < 90;
        });
        EXPECT_GT(static_cast<double>(red), 0.9 * static_cast<double>(lens.size())) << deg;
    }
}

TEST(Night, StreetLightsLightTheRoadAndThingsThrowShadows) {
    const world::SealedTick tick = test::tick_with({});
    const world::SensorSpec spec = from_above({100, -1.75, 40});
    const auto dark = look(test::straight_road(400), tick, spec, clear_night());
    const auto open = look(street_with_light(false), tick, spec, clear_night());
    const auto shaded = look(street_with_light(true), tick, spec, clear_night());
    // Rows of 0.5 m: 10 m ahead is row 40. The road's middle is at column 80.
    const auto at = [](const world::SensorFrame& frame, int row) {
        return mean(frame, 1, 77, row, 82, row + 2);
    };
    EXPECT_GT(at(open, 55), at(dark, 55) + 40) << "below the lamp";
    EXPECT_GT(at(open, 36), at(dark, 36) + 20) << "11 m on";
    EXPECT_LT(at(shaded, 36), at(dark, 36) + 10) << "behind the wall";
    EXPECT_NEAR(at(shaded, 70), at(open, 70), 4) << "on the lamp's side nothing changes";
}

/// A lamp behind a wall would throw a long highlight onto the wet road before it. What another lamp
/// gives there is seen as if the first one was not there, without spots of that highlight.
TEST(Night, WhatHidesALampHidesItsHighlightOnWetRoadAsWell) {
    world::Weather weather = clear_night();
    weather.mutate_wetness(0.9F);
    weather.mutate_puddles(0.5F);
    const auto road = [&](bool hidden_lamp) {
        world::TownT town = street_with_light(false);
        const world::Prop light = town.props[0];
        town.props = {
            world::Prop(world::Vec3(94, -1, 0), 1.5708, 24, 0.3, 4, 0, 0, world::PropKind::wall, 0),
            world::Prop(world::Vec3(68, -5, 0), 1.5708, 2, 0.2, 7.5, 0, 0, light.kind(), 0)};
        if (hidden_lamp)
            town.props.push_back(light);
        world::SensorSpec spec = camera(SensorKind::rgb, {80, -1.75, 2});
        spec.fov = 0.6;
        return look(town, test::tick_with({}), spec, weather);
    };
    const auto with = road(true);
    const auto without = road(false);
    // The wall's foot is at row 97, and at row 112 the road is 2.5 m before it.
    double sum = 0;
    double squares = 0;
    constexpr int count = 12 * 80;
    for (int row = 100; row < 112; ++row)
        for (int column = 20; column < 100; ++column) {
            const double more = mean(with, 1, column, row, column, row) -
                                mean(without, 1, column, row, column, row);
            sum += more;
            squares += more * more;
        }
    // Walls send some of the lamp's light back; what that leaves is even.
    const double even = sum / count;
    EXPECT_LT(even, 2);
    EXPECT_LT(std::sqrt(squares / count - even * even), 0.75);
}

TEST(Night, LowBeamsLightTheRoadAheadButNotAbove) {
    world::TownT town = test::straight_road(400);
    // A wall of 10 m across the road, 30 m before the car.
    town.props = {
        world::Prop(world::Vec3(135, 0, 0), 1.5708, 20, 0.3, 10, 0, 0, world::PropKind::wall, 0)};
    const world::SensorSpec spec = camera(SensorKind::rgb, {105, -1.75, 3});
    const auto with = look(town, test::tick_with({}, {car_at(6, 100, -1.75)}), spec, clear_night());
    const auto without = look(town, test::tick_with({}), spec, clear_night());
    // The wall stands 30 m before the camera, 2.7 px a metre: its foot is at row 68, 0.6 m up the
    // line, at row 66, 8 m up row 47.
    const double low = mean(with, 1, 77, 67, 82, 67) - mean(without, 1, 77, 67, 82, 67);
    const double high = mean(with, 1, 70, 45, 90, 52) - mean(without, 1, 70, 45, 90, 52);
    EXPECT_GT(low, 25);
    EXPECT_LT(high, low / 3);
    EXPECT_GT(mean(with, 1, 70, 80, 90, 100), mean(without, 1, 70, 80, 90, 100) + 15) << "road";
}

/// Two head lamps give a wall 6 m before them 100 times what a street has between its lamps.
TEST(Night, LampsNearByLeaveMoreThanWhite) {
    world::TownT town = test::straight_road(400);
    town.props = {
        world::Prop(world::Vec3(112, 0, 0), 1.5708, 20, 0.3, 10, 0, 0, world::PropKind::wall, 0)};
    for (const float wet : {0.0F, 1.0F}) {
        SCOPED_TRACE(wet);
        world::Weather weather = clear_night();
        weather.mutate_wetness(wet);
        weather.mutate_puddles(0.5F * wet);
        const auto frame = look(town,
                                test::tick_with({}, {car_at(6, 100, -1.75)}),
                                camera(SensorKind::rgb, {104, -1.75, 1.6}),
                                weather);
        // The wall stands 8 m before the camera, 10 px a metre: its foot is at row 76.
        int most = 0;
        for (int row = 64; row < 119; ++row)
            for (int column = 0; column < 159; ++column)
                most = std::max(most, static_cast<int>(mean(frame, 1, column, row, column, row)));
        EXPECT_LT(most, 250) << "walls and road keep their texture";
        EXPECT_GT(most, 150) << "and are bright";
    }
}

TEST(Night, PicturesAreNotBlackUnderAnySun) {
    const world::TownT town = test::street();
    render::Sensors sensors(town);
    const world::SealedTick tick = test::street_tick();
    for (const float deg : {-90.0F, -30.0F, -12.0F, -6.0F, -4.9F}) {
        const auto frame =
            sensors.observe(tick.view(), {test::street_rig()[0]}, with_sun(test::noon(), deg))[0];
        EXPECT_GT(mean(frame, 1, 0, 0, 159, 119), 12) << "sun at " << deg;
    }
}

}  // namespace reprise
