#include "world/weather/air.h"

#include <cmath>

#include <gtest/gtest.h>

#include "world/weather/weather_text.h"

namespace reprise::world {
namespace {

TEST(Air, RainTakesWhatItsDropsCover) {
    // Twice the section of each drop of Marshall and Palmer's, summed over their sizes.
    for (const double rain : {1.0, 10.0, 50.0, 100.0}) {
        const double slope = 4.1 * std::pow(rain, -0.21);  // [1/mm]
        double sum = 0;
        constexpr double step = 0.001;  // [mm]
        for (double size = step / 2; size < 30; size += step)
            sum += 2 * M_PI / 4 * size * size * 1e-6 * 8000 * std::exp(-slope * size) * step;
        EXPECT_NEAR(rain_extinction(rain) / sum, 1, 0.01) << rain << " mm/h";
    }
}

TEST(Air, MeanOfFogBetweenTwoHeightsIsThatOfManySteps) {
    const Weather weather = read_weather("fog=100,fog_base=5,fog_falloff=0.1").weather;
    for (const double from : {-3.0, 0.0, 4.0, 30.0})
        for (const double to : {0.5, 1.0, 5.0, 12.0, 80.0}) {
            double sum = 0;
            constexpr int steps = 20'000;
            for (int i = 0; i < steps; ++i)
                sum += fog_extinction_at(weather, from + (to - from) * (i + 0.5) / steps) / steps;
            EXPECT_NEAR(mean_fog_extinction(weather, from, to) / sum, 1, 1e-4)
                << from << " to " << to;
            EXPECT_EQ(mean_fog_extinction(weather, from, to),
                      mean_fog_extinction(weather, to, from));
        }
}

TEST(Air, FogWithoutFalloffHasNoTop) {
    const Weather weather = read_weather("fog=100").weather;
    EXPECT_NEAR(fog_extinction_at(weather, 500), 0.03, 1e-6);
    EXPECT_NEAR(mean_fog_extinction(weather, 0, 500), 0.03, 1e-6);
}

}  // namespace
}  // namespace reprise::world
