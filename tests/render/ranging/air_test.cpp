#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>

#include "render/ranging/fog_return.h"
#include "render/ranging/precipitation.h"
#include "render/ranging/radar_link.h"
#include "render/ranging/reflectance.h"
#include "world/external/sensor_noise.h"

namespace reprise {

namespace {

constexpr int beams = 20'000;

struct Statistics {
    int noticed = 0;
    int bright = 0;  ///< four times what is noticed
    double sum = 0;  ///< of ranges
    double squares = 0;

    double share() const { return static_cast<double>(noticed) / beams; }

    double mean() const { return sum / noticed; }

    double spread() const { return std::sqrt(squares / noticed - mean() * mean()); }

    void add(double range, double power, const render::Pulse& pulse) {
        ++noticed;
        bright += static_cast<int>(power > 4 * pulse.least_power);
        sum += range;
        squares += range * range;
    }
};

/// LISA as its paper has it: every drop in the cone of the beam, with a place and a diameter.
Statistics by_all_drops(const render::Hydrometeors& drops, const render::Pulse& pulse) {
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    constexpr double least = 0.05;  // [mm]
    const double end = pulse.divergence * pulse.range / 2;
    const double volume = std::numbers::pi / 3 * pulse.range * end * end;
    const double count = drops.intercept / drops.slope * std::exp(-drops.slope * least) * volume;
    std::poisson_distribution<int> number(count);
    Statistics found;
    for (int beam = 0; beam < beams; ++beam) {
        double best = 0;
        double place = 0;
        for (int drop = number(engine); drop > 0; --drop) {
            const double range = pulse.range * std::cbrt(uniform(engine));
            const double diameter = least - std::log(1 - uniform(engine)) / drops.slope;
            const double share = std::min(diameter / (1000 * pulse.divergence * range), 1.0);
            const double power = drops.reflectivity * render::overlap(range) * share * share *
                                 std::exp(-2 * pulse.extinction * range) / (range * range);
            if (power > best) {
                best = power;
                place = range;
            }
        }
        if (best >= pulse.least_power)
            found.add(place, best, pulse);
    }
    return found;
}

Statistics by_noticed_drops(const render::Hydrometeors& drops, const render::Pulse& pulse) {
    const render::Precipitation precipitation(drops, pulse);
    const world::SensorNoise noise(3, "lidar", 1);
    Statistics found;
    for (int beam = 0; beam < beams; ++beam)
        if (const auto drop =
                precipitation.strongest(pulse.range, noise, static_cast<std::uint64_t>(beam), 16))
            found.add(drop->range, drop->power, pulse);
    return found;
}

}  // namespace

TEST(LidarRain, NoticedDropsAreThoseOfAllDropsInTheBeam) {
    for (const bool snows : {false, true}) {
        const render::Hydrometeors drops = snows ? render::snow_flakes(4) : render::rain_drops(50);
        const render::Pulse pulse{3e-3, 0.9 / (200.0 * 200.0), drops.extinction, 15};
        const Statistics all = by_all_drops(drops, pulse);
        const Statistics noticed = by_noticed_drops(drops, pulse);
        ASSERT_GT(all.noticed, 1000);
        // Four standard deviations of the difference of two counts, and of two means.
        const double of_shares = 4 * std::sqrt(2 * all.share() * (1 - all.share()) / beams);
        EXPECT_NEAR(noticed.share(), all.share(), of_shares) << snows;
        const double of_means = 4 * all.spread() * std::sqrt(2.0 / all.noticed);
        EXPECT_NEAR(noticed.mean(), all.mean(), of_means) << snows;
        EXPECT_NEAR(noticed.spread(), all.spread(), 0.1 * all.spread()) << snows;
        ASSERT_GT(all.bright, 200);
        EXPECT_NEAR(noticed.bright, all.bright, 6 * std::sqrt(all.bright)) << snows;
    }
}

TEST(LidarRain, ExtinctionIsThatOfTheDropsDiscs) {
    // Marshall and Palmer's drops, each taking twice its disc: 3.65e-4 R^0.63; the two agree
    // within 17 % from 1 to 100 mm/h.
    for (const double rate : {1.0, 10.0, 50.0, 100.0}) {
        const render::Hydrometeors drops = render::rain_drops(rate);
        const double discs =
            std::numbers::pi / 2 * drops.intercept * 2 / std::pow(drops.slope, 3) * 1e-6;
        EXPECT_NEAR(drops.extinction, discs, 0.17 * discs) << rate;
    }
}

TEST(LidarFog, PeakIsThatOfTheIntegralOverThePulse) {
    const double extinction = 0.06;  // 50 m of visibility
    const render::FogReturn fog(extinction);
    EXPECT_NEAR(render::visibility_of(extinction), 49.9, 0.1);
    for (const double surface : {2.0, 4.0, 8.0, 1000.0}) {
        // Hahner's, by the midpoint rule over time: (beta / beta0) * int sin^2 e^(-2 a r) / r^2 dt.
        constexpr double c = 299'792'458;
        constexpr double half = 20e-9;
        double best = 0;
        double at = 0;
        for (double range = 0.9; range < 12; range += 0.01) {
            double sum = 0;
            constexpr int steps = 2000;
            for (int i = 0; i < steps; ++i) {
                const double t = 2 * half * (i + 0.5) / steps;
                const double r = range - c * t / 2;
                if (r <= 0.9 || r > surface)
                    continue;
                const double wave = std::sin(std::numbers::pi * t / (2 * half));
                sum += wave * wave * std::min((r - 0.9) / 0.1, 1.0) *
                       std::exp(-2 * extinction * r) / (r * r) * 2 * half / steps;
            }
            if (sum > best) {
                best = sum;
                at = range;
            }
        }
        best *= 0.046 * extinction / std::log(20.0) / (1e-6 / std::numbers::pi);
        const render::FogReturn::Peak peak = fog.before(surface);
        EXPECT_NEAR(peak.power, best, 0.01 * best) << surface;
        EXPECT_NEAR(peak.range, at, 0.1) << surface;
    }
    EXPECT_EQ(render::FogReturn(0).before(50).power, 0);
}

TEST(LidarReflectance, GrazingRoadIsSeenDryAndMirrorsAwayWet) {
    const render::Reflectance road{0.17F, 0.5F, true};
    const render::Reflectance mirror{0.17F, 0, true};
    EXPECT_FLOAT_EQ(render::returned_share(mirror, 0.5F, 0), 0.085F) << "Lambert's law";
    EXPECT_GT(render::returned_share(road, 0.03F, 0), 0.04F);
    EXPECT_LT(render::returned_share(road, 0.03F, 1),
              0.2F * render::returned_share(road, 0.03F, 0));
    EXPECT_GT(render::returned_share(road, 1, 1), 0.4F * render::returned_share(road, 1, 0));
}

TEST(RadarLink, RainTakesWhatTheRecommendationSays) {
    // ITU-R P.838-3 at 77 GHz.
    EXPECT_NEAR(render::rain_loss(25), 11.4, 0.05);
    EXPECT_NEAR(render::rain_loss(50), 18.8, 0.05);
    const double clear = render::signal_to_noise(10, 100, 1, 0);
    const double rainy = render::signal_to_noise(10, 100, 1, render::rain_loss(25));
    EXPECT_NEAR(10 * std::log10(clear / rainy), 2 * 0.1 * 11.4, 0.02);
    EXPECT_NEAR(clear / render::signal_to_noise(10, 200, 1, 0), 16, 1e-9) << "the fourth power";
    EXPECT_NEAR(render::antenna_gain(0.1, 0.2), 0.5, 1e-12);
}

TEST(SensorNoise, IsNormalAndAFunctionOfWhatItIsFor) {
    const world::SensorNoise noise(1, "roof", 7);
    double sum = 0;
    double squares = 0;
    double fourth = 0;
    constexpr int count = 200'000;
    for (int i = 0; i < count; ++i) {
        const double x = noise.normal(static_cast<std::uint64_t>(i), 2);
        sum += x;
        squares += x * x;
        fourth += x * x * x * x;
    }
    EXPECT_NEAR(sum / count, 0, 0.01);
    EXPECT_NEAR(squares / count, 1, 0.015);
    EXPECT_NEAR(fourth / count, 3, 0.12);
    EXPECT_NEAR(world::normal_quantile(0.975), 1.959963985, 1e-8);
    EXPECT_NEAR(world::normal_quantile(0.001), -3.090232306, 1e-8);
    EXPECT_EQ(noise.uniform(5, 1), world::SensorNoise(1, "roof", 7).uniform(5, 1));
    EXPECT_NE(noise.uniform(5, 1), world::SensorNoise(2, "roof", 7).uniform(5, 1));
    EXPECT_NE(noise.uniform(5, 1), world::SensorNoise(1, "front", 7).uniform(5, 1));
    EXPECT_NE(noise.uniform(5, 1), world::SensorNoise(1, "roof", 8).uniform(5, 1));
}

}  // namespace reprise
