// What holds for every weather there is.
#include <cmath>

#include <gmock/gmock.h>

#include "tests/render/street.h"
#include "tests/support/places.h"
#include "world/weather/weather_field.h"
#include "world/weather/weather_text.h"

namespace reprise {

namespace {

using world::SensorFrame;
using world::Weather;
using world::WeatherField;

Weather weather(const std::string& text) {
    return world::read_weather(text).weather;
}

/// Mean difference of two pictures. [steps of 255]
double difference(const SensorFrame& one, const SensorFrame& other) {
    double sum = 0;
    for (std::size_t i = 0; i < one.data.size(); ++i)
        sum += std::abs(static_cast<int>(one.data[i]) - static_cast<int>(other.data[i]));
    return sum / static_cast<double>(one.data.size());
}

double brightness(const SensorFrame& frame) {
    return (test::mean(frame, 0, 0, 0, frame.width - 1, frame.height - 1) +
            test::mean(frame, 1, 0, 0, frame.width - 1, frame.height - 1) +
            test::mean(frame, 2, 0, 0, frame.width - 1, frame.height - 1)) /
           3;
}

world::SensorRig rgb_rig(int width, int height) {
    world::SensorRig rig = test::street_rig(width, height);
    rig.resize(1);
    return rig;
}

}  // namespace

TEST(AllWeathers, LeaveDepthsAndClassesAsTheyAre) {
    render::Sensors sensors(test::street());
    render::Sensors alone(test::street(), {.threads = 1, .portable = false});
    render::Sensors two(test::street(), {.threads = 2, .portable = false});
    const world::SealedTick tick = test::street_tick();
    const world::SensorRig rig = test::street_rig(80, 60);
    const auto clear = sensors.observe(tick.view(), rig, test::noon());
    for (const world::WeatherPreset& preset : world::weather_presets()) {
        if (std::string(preset.source) == "CARLA")
            continue;  // the same numbers over again
        const auto one = alone.observe(tick.view(), rig, preset.weather);
        const auto both = two.observe(tick.view(), rig, preset.weather);
        EXPECT_TRUE(one[1].data == clear[1].data) << preset.name << ": depths";
        EXPECT_TRUE(one[2].data == clear[2].data) << preset.name << ": classes";
        EXPECT_TRUE(one[3].data == clear[3].data) << preset.name << ": instances";
        EXPECT_TRUE(one[4].data == clear[4].data) << preset.name << ": normals";
        EXPECT_TRUE(one[0].data == both[0].data) << preset.name << ": with two threads";
        const double light = brightness(one[0]);
        EXPECT_GT(light, 3) << preset.name << " shows nothing";
        EXPECT_LT(light, 235) << preset.name << " is blown out";
    }
}

/// A frame alone is that of a sequence: nothing of the weather goes on from picture to picture.
TEST(AllWeathers, FramesStandAlone) {
    const world::SensorRig rig = rgb_rig(96, 72);
    for (const char* said : {"hard_rain_sunset", "cloudy_noon,wind=20,snow=4", "dust_storm"}) {
        render::Sensors walked(test::street());
        for (std::uint64_t index : {7U, 1000U}) {
            world::TickDraft draft;
            draft.tick.index = index;
            draft.tick.vehicles = {test::vehicle_at(1, 40, -1.75)};
            draft.tick.signals = {world::SignalColor::red};
            const world::SealedTick tick = world::seal(draft, {});
            render::Sensors fresh(test::street());
            EXPECT_TRUE(walked.observe(tick.view(), rig, weather(said))[0].data ==
                        fresh.observe(tick.view(), rig, weather(said))[0].data)
                << said << ", tick " << index;
        }
    }
}

/// No number switches anything: a very small step changes a picture very little, wherever
/// one begins, at nothing as well.
TEST(AllWeathers, NothingSwitchesAtAThreshold) {
    render::Sensors sensors(test::street());
    const world::SealedTick tick = test::street_tick();
    const world::SensorRig rig = rgb_rig(48, 36);
    const auto picture = [&](const Weather& said) {
        return sensors.observe(tick.view(), rig, said)[0];
    };
    for (const char* base : {"cloudy_noon", "mid_rain_sunset"})
        for (const WeatherField& field : world::weather_fields()) {
            // The sun's altitude is the exposure's matter as well, see its own tests.
            if (std::string(field.key) == "sun_altitude_deg" || *field.unit == '/')
                continue;
            for (const double start : {0.0, 0.003, 0.4}) {
                const auto at = [&](double share) {
                    Weather said = weather(base);
                    const double value =
                        field.is_range ? field.low * std::pow(field.high / field.low, 1 - share)
                                       : field.low + share * (field.high - field.low);
                    (said.*field.set)(field.kept(value));
                    return said;
                };
                const double step = difference(picture(at(start)), picture(at(start + 2e-5)));
                EXPECT_LT(step, 0.4) << base << ": " << field.key << " from " << start
                                     << " of its range on, in steps of 255";
            }
        }
}

TEST(Snow, WhitensTheGroundByItsCover) {
    render::Sensors sensors(test::straight_road(400));
    const world::SealedTick tick = test::tick_with({});
    double first = 0;
    double last = 0;
    for (const char* cover : {"0", "0.3", "0.6", "1"}) {
        const auto frame =
            sensors.observe(tick.view(),
                            {test::camera(world::SensorKind::rgb, {100, -1.75, 1.4})},
                            weather(std::string("overcast_noon,wetness=0,snow_cover=") + cover))[0];
        const double ground = test::mean(frame, 1, 0, 80, 159, 119);
        EXPECT_GT(ground, last) << cover;
        first = first > 0 ? first : ground;
        last = ground;
    }
    EXPECT_GT(last, 1.6 * first);
}

TEST(Snow, LiesInPatchesOnTheRoofOfACarAndGoesWithIt) {
    render::Sensors sensors(test::straight_road(400));
    const auto roof = [&](double x, const char* said) {
        const world::SealedTick tick = test::tick_with({test::vehicle_at(1, x, -1.75)});
        world::SensorSpec spec = test::camera(world::SensorKind::rgb, {x + 0.9, -1.75, 4});
        spec.pitch = -1.5;
        spec.fov = 0.5;  // within its roof
        return sensors.observe(tick.view(), {spec}, weather(said))[0];
    };
    const char* snowy = "overcast_noon,wetness=0,wind=0,snow_cover=0.7";
    const auto bare = roof(100, "overcast_noon,wetness=0,wind=0");
    const auto white = roof(100, snowy);
    EXPECT_GT(difference(bare, white), 6);
    EXPECT_LT(difference(white, roof(103.7, snowy)), 0.3 * difference(bare, white));
}

TEST(Shelter, KeepsTheRoadBelowABridgeDryAndFreeOfSnow) {
    render::Sensors sensors(test::bridge());
    const world::SealedTick tick = test::tick_with({});
    const auto under = [&](const std::string& said) {
        // Straight down from below the deck, which is 8 m wide or less, and beside it.
        world::SensorSpec spec = test::camera(world::SensorKind::rgb, {0, 0.6, 2});
        spec.pitch = -1.5;
        spec.fov = 0.6;
        return sensors.observe(tick.view(), {spec}, weather(said))[0];
    };
    EXPECT_LT(
        difference(under("overcast_noon,snow_cover=0"), under("overcast_noon,snow_cover=0.001")),
        0.6);
    // Only the light from around it changes: snow beside it is bright.
    const double bare = test::mean(under("overcast_noon"), 1, 40, 30, 119, 89);
    const double snowy = test::mean(under("overcast_noon,snow_cover=1"), 1, 40, 30, 119, 89);
    EXPECT_LT(snowy, 1.6 * bare) << "no snow lies there";
}

TEST(Clouds, DriftWithTheWindAndOnlyWithIt) {
    render::Sensors sensors(test::straight_road(400));
    const auto sky = [&](std::uint64_t index, const char* said) {
        world::TickDraft draft;
        draft.tick.index = index;
        world::SensorSpec spec = test::camera(world::SensorKind::rgb, {100, -1.75, 1.4});
        spec.pitch = 0.6;
        return sensors.observe(world::seal(draft, {}).view(), {spec}, weather(said))[0];
    };
    EXPECT_GT(difference(sky(0, "cloudy_noon,wind=10"), sky(1200, "cloudy_noon,wind=10")), 5);
    EXPECT_LT(difference(sky(0, "cloudy_noon,wind=0"), sky(1200, "cloudy_noon,wind=0")), 0.5);
}

TEST(Clouds, CastShadowsThatMove) {
    render::Sensors sensors(test::straight_road(400));
    double low = 255;
    double high = 0;
    for (std::uint64_t index = 0; index < 24'000; index += 1200) {
        world::TickDraft draft;
        draft.tick.index = index;
        const auto frame =
            sensors.observe(world::seal(draft, {}).view(),
                            {test::camera(world::SensorKind::rgb, {100, -1.75, 1.4})},
                            weather("clear_noon,clouds=0.5,wind=10"))[0];
        const double road = test::mean(frame, 1, 60, 80, 99, 110);
        low = std::min(low, road);
        high = std::max(high, road);
    }
    EXPECT_GT(high, low + 15) << "of 255, within 20 minutes";
}

}  // namespace reprise
