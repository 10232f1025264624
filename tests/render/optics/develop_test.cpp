#include "render/optics/develop.h"

#include <cmath>

#include <gmock/gmock.h>

#include "render/optics/pixel_noise.h"
#include "tests/render/frames.h"

namespace reprise {

namespace {

using world::SensorKind;

world::SensorSpec sky_camera(std::vector<world::AttributeValue> attributes) {
    world::SensorSpec spec = test::camera(SensorKind::rgb, {100, -1.75, 1.4});
    spec.width = 48;
    spec.height = 32;
    spec.attributes = std::move(attributes);
    return spec;
}

world::SensorFrame taken(render::Sensors& sensors, const world::SensorSpec& spec) {
    const world::SealedTick tick = test::tick_with({});
    return sensors.observe(tick.view(), {spec}, test::noon())[0];
}

}  // namespace

TEST(Develop, NoiseHasTheMeanAndVarianceOfEmva1288OnGreyCards) {
    const double full = 2500;
    const double read = 12;
    world::SensorSpec spec = sky_camera({{"noise", 1},
                                         {"full_well", 10000},
                                         {"iso", 400},
                                         {"read_noise", read},
                                         {"dsnu", 0},
                                         {"prnu", 0},
                                         {"bit_depth", 10}});
    for (const double light : {0.01, 0.02, 0.18, 0.5, 0.8}) {
        double sum = 0;
        double squares = 0;
        constexpr int pixels = 100'000;
        const render::PixelNoise noise(spec, 9, 1);
        for (int i = 0; i < pixels; ++i) {
            const double steps =
                1023 * static_cast<double>(noise.measured(static_cast<float>(light),
                                                          static_cast<std::uint64_t>(i)));
            sum += steps;
            squares += steps * steps;
        }
        const double mean = sum / pixels;
        const double gain = 1023 / full;  // [steps an electron]
        const double expected = gain * gain * (light * full + read * read) + 1 / 12.0;
        EXPECT_NEAR(mean, 1023 * light, 5 * std::sqrt(expected / pixels) + (light < 0.02 ? 0.5 : 0))
            << light;
        // The darkest card loses what would be below nothing.
        EXPECT_NEAR((squares / pixels - mean * mean) / expected, 1, light < 0.02 ? 0.1 : 0.02)
            << light;
    }
}

TEST(Develop, APictureIsAsNoisyAsItsLightSays) {
    render::Sensors sensors(test::straight_road(400));
    const std::vector<world::AttributeValue> straight{
        {"tone", 1}, {"gamma", 1}, {"exposure_compensation", -1}};
    const world::SensorFrame clean = taken(sensors, sky_camera(straight));
    constexpr int pictures = 200;
    std::vector<double> sum(clean.data.size());
    std::vector<double> squares(clean.data.size());
    for (int seed = 0; seed < pictures; ++seed) {
        std::vector<world::AttributeValue> noisy = straight;
        noisy.push_back({"noise", 1});
        noisy.push_back({"full_well", 1000});
        noisy.push_back({"read_noise", 5});
        noisy.push_back({"prnu", 0});
        noisy.push_back({"dsnu", 0});
        noisy.push_back({"bit_depth", 8});
        noisy.push_back({"noise_seed", static_cast<double>(seed)});
        const world::SensorFrame frame = taken(sensors, sky_camera(noisy));
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += frame.data[i];
            squares[i] += static_cast<double>(frame.data[i]) * frame.data[i];
        }
    }
    double ratio = 0;
    int count = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        const double mean = sum[i] / pictures;
        if (mean < 30 || mean > 180)
            continue;
        const double variance = squares[i] / pictures - mean * mean;
        const double gain = 255 / 1000.0;
        ratio += variance / (gain * gain * (mean / gain + 25) + 1 / 12.0);
        EXPECT_NEAR(mean, clean.data[i], 6) << i;
        ++count;
    }
    ASSERT_GT(count, 1000);
    EXPECT_NEAR(ratio / count * pictures / (pictures - 1), 1, 0.02);
}

TEST(Develop, SunnySixteenIsWhatTheWeatherChoosesAtNoon) {
    render::Sensors sensors(test::straight_road(400));
    const auto ground = [&](std::vector<world::AttributeValue> attributes) {
        return test::mean(taken(sensors, sky_camera(std::move(attributes))), 1, 4, 22, 44, 31);
    };
    const double chosen = ground({{"tone", 1}, {"gamma", 1}});
    const double by_hand = ground({{"tone", 1},
                                   {"gamma", 1},
                                   {"exposure_mode", 1},
                                   {"fstop", 16},
                                   {"shutter_speed", 100},
                                   {"iso", 100}});
    EXPECT_NEAR(by_hand / chosen, 1, 0.35) << "photographers' rule and ours are half a stop apart";
    const double less = ground({{"tone", 1}, {"gamma", 1}, {"exposure_compensation", -1}});
    EXPECT_NEAR(less, chosen / 2, 1);
    const double longer = ground({{"tone", 1},
                                  {"gamma", 1},
                                  {"exposure_mode", 1},
                                  {"fstop", 16},
                                  {"shutter_speed", 200},
                                  {"iso", 200}});
    EXPECT_NEAR(longer, by_hand, 0.1) << "half as long, twice as sensitive";
}

TEST(Develop, NoiseIsOfTheTickAndTheSensorAlone) {
    render::Sensors sensors(test::straight_road(400));
    render::Sensors alone(test::straight_road(400), {.threads = 1});
    const world::SensorSpec spec = sky_camera({{"noise", 1}});
    world::SensorSpec other = spec;
    other.name = "other";
    const world::SensorFrame frame = taken(sensors, spec);
    EXPECT_EQ(taken(alone, spec).data, frame.data);
    EXPECT_NE(taken(sensors, other).data, frame.data);
}

}  // namespace reprise
