#include "render/look/sky.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "world/weather/weather_text.h"

namespace reprise::render {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Relative to the zenith. Kasten and Young, Applied Optics 28 (1989).
double air_mass(double altitude_deg) {
    return 1 /
           (std::sin(altitude_deg * degree) + 0.50572 * std::pow(altitude_deg + 6.07995, -1.6364));
}

/// [relative] what a surface that faces the sun gets, as eyes weigh it (Rec. 709).
double illuminance(double altitude_deg) {
    const Sky sky(
        world::read_weather("clear_noon,clouds=0,sun_altitude=" + std::to_string(altitude_deg))
            .weather);
    return 0.2126 * static_cast<double>(sky.sun().x()) +
           0.7152 * static_cast<double>(sky.sun().y()) +
           0.0722 * static_cast<double>(sky.sun().z());
}

/// Direct light falls by e^(-c m). c of air alone is 0.10 (molecules, Bodhaine et al., 1999: 0.097
/// at 550 nm), 0.21 of the usual clear sky with its haze (IES RP-21, 1984): ours is a very clear
/// one.
TEST(Sun, IlluminanceFallsByTheAirMass) {
    const double high = illuminance(60);
    const auto per_mass = [&](double altitude) {
        return std::log(high / illuminance(altitude)) / (air_mass(altitude) - air_mass(60));
    };
    EXPECT_GT(per_mass(30), 0.10);
    EXPECT_LT(per_mass(30), 0.21);
    for (const double altitude : {45.0, 20.0, 12.0})
        EXPECT_NEAR(per_mass(altitude), per_mass(30), 0.03 * per_mass(30)) << altitude;
}

/// Sun and sky together, as a camera set to daylight has it: three wavelengths as red, green and
/// blue would make it cyan by a sixth.
TEST(Sun, MakesAWhiteCardWhiteAtAClearNoon) {
    const Sky sky(world::read_weather("clear_noon").weather);
    const Color card = sky.sun() * (sky.to_sun().z() / pi) + sky.ambient(Eigen::Vector3f::UnitZ());
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(card[channel] / luminance(card), 1, 0.025F) << channel;
}

/// As the eye has it: red at the horizon, and blue opposite high up.
TEST(Sun, TurnsRedWhenItSinks) {
    float last = 0;
    for (const float altitude : {55.0F, 20.0F, 9.0F, 4.0F, 1.0F}) {
        const Sky sky(
            world::read_weather("clear_noon,sun_altitude=" + std::to_string(altitude)).weather);
        const float red = sky.sun().x() / sky.sun().z();
        EXPECT_GT(red, last) << altitude;
        last = red;
        const Color above = sky.radiance(Eigen::Vector3f::UnitZ(), false);
        EXPECT_GT(above.z(), 1.8F * above.x()) << altitude;
        EXPECT_GT(above.z(), above.y()) << altitude;
        EXPECT_GT(above.y(), above.x()) << altitude;
    }
}

/// Where a high sun's sky, of which the altitude says all, meets a low one's, which is worked out
/// for each direction.
TEST(Sky, IsTheSameJustAboveAndJustBelowWhereTheSunCountsAsLow) {
    const auto sky = [](const char* altitude) {
        return Sky(world::read_weather("clear_noon,clouds=0,sun_altitude=" + std::string(altitude))
                       .weather);
    };
    const Sky above = sky("2.87");
    const Sky below = sky("2.86");
    for (const float z : {0.0F, 0.01F, 0.05F, 0.2F, 0.6F, 0.95F, 1.0F}) {
        for (float azimuth = 0; azimuth < 6.2F; azimuth += 0.7F) {
            const float wide = std::sqrt(1 - z * z);
            const Eigen::Vector3f way(wide * std::cos(azimuth), wide * std::sin(azimuth), z);
            const Color high = above.radiance(way, false) * above.exposure();
            const Color low = below.radiance(way, false) * below.exposure();
            for (int channel = 0; channel < 3; ++channel)
                EXPECT_NEAR(low[channel] / high[channel], 1, 0.006) << z << ", " << azimuth;
        }
    }
}

}  // namespace
}  // namespace reprise::render
