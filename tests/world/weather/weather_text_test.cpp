#include "world/weather/weather_text.h"

#include <gtest/gtest.h>

#include "world/check.h"
#include "world/weather/weather_field.h"

namespace reprise::world {
namespace {

std::string mistake(const std::string& text) {
    try {
        read_weather(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

TEST(WeatherText, IsAPresetANumberOrBoth) {
    EXPECT_EQ(read_weather("hard_rain_sunset").weather, find_weather("hard_rain_sunset")->weather);
    const WeatherPreset mix = read_weather("rain=30,fog=200,sun_altitude=8");
    EXPECT_EQ(mix.weather.rain(), 30);
    EXPECT_NEAR(static_cast<double>(mix.weather.fog_extinction()), 0.015, 1e-8);
    EXPECT_NEAR(static_cast<double>(mix.weather.sun_altitude()), 0.13962634, 1e-6);
    EXPECT_EQ(mix.weather.turbidity(), find_weather("clear_noon")->weather.turbidity());
    EXPECT_EQ(mix.name, "rain=30,fog=200,sun_altitude=8");
    const WeatherPreset changed = read_weather("cloudy_noon,fog=300");
    EXPECT_EQ(changed.weather.cloud_cover(), 0.6F);
}

TEST(WeatherText, RainWetsTheRoadUnlessItIsSaid) {
    EXPECT_GT(read_weather("rain=30").weather.wetness(), 0.9F);
    EXPECT_GT(read_weather("rain=30").weather.cloud_cover(), 0.8F);
    EXPECT_LT(read_weather("rain=30").road_friction, 0.75);
    EXPECT_EQ(read_weather("rain=30,wetness=0").weather.wetness(), 0);
    EXPECT_EQ(read_weather("rain=30,film=0").weather.wetness(), 0);
    EXPECT_EQ(read_weather("overcast_noon,rain=1").weather.cloud_cover(), 1);
    EXPECT_LT(read_weather("snow_cover=1").road_friction, 0.34);
}

TEST(WeatherText, EveryNumberCanBeSaidByItsKeyAndItsAlias) {
    for (const WeatherField& field : weather_fields())
        for (const double said : {field.low, field.high, (field.low + field.high) / 2}) {
            const std::string value = std::to_string(said);
            const Weather weather = read_weather(std::string(field.key) + "=" + value).weather;
            EXPECT_NEAR(field.said(weather), said, 1e-4 * (1 + std::abs(said))) << field.key;
            if (*field.alias != 0) {
                EXPECT_EQ(read_weather(std::string(field.alias) + "=" + value).weather, weather);
            }
        }
}

TEST(WeatherText, SpeaksCarlasDialectBehindItsNames) {
    EXPECT_EQ(read_weather("carla").weather, find_weather("Default")->weather);
    EXPECT_EQ(
        read_weather("ClearNoon,sun_altitude_angle=15,sun_azimuth_angle=90").weather.sun_azimuth(),
        read_weather("sun_azimuth=-90").weather.sun_azimuth());
    EXPECT_EQ(read_weather("carla,precipitation=100").weather.rain(), 50);
    EXPECT_EQ(mistake("carla,rain=3").substr(0, 19), "no number 'rain'; t");
    EXPECT_EQ(mistake("carla,fog_density=101"), "'fog_density' must be in [0, 100], got 101");
}

TEST(WeatherText, MistakesAreOneLineThatHelps) {
    EXPECT_EQ(mistake("claer_noon"),
              "no weather 'claer_noon' (did you mean 'clear_noon'?); reprise list weathers shows "
              "them all");
    EXPECT_EQ(mistake("hard_rain"),
              "no weather 'hard_rain' (did you mean 'hard_rain_noon'?); reprise list weathers "
              "shows them all");
    EXPECT_EQ(mistake("rain"),
              "no weather 'rain' (did you mean 'rain=8'?); reprise list weathers shows them all");
    for (const WeatherField& field : weather_fields()) {
        const std::string hint = mistake(field.key);
        const std::size_t begin = hint.find("mean '") + 6;
        EXPECT_NO_THROW(read_weather(hint.substr(begin, hint.find("'?") - begin))) << hint;
    }
    EXPECT_EQ(mistake("hardrain").substr(0, 58),
              "no weather 'hardrain' (did you mean 'hard_rain_noon'?); re")
        << "names are written together or apart";
    EXPECT_EQ(mistake("rian=3").substr(0, 41), "no number 'rian' (did you mean 'rain'?); ");
    EXPECT_EQ(mistake("rain=-1"), "'rain' must be in [0, 200] mm/h, got -1");
    EXPECT_EQ(mistake("fog=5"), "'fog' must be in [10, 100000] m, got 5");
    for (const char* value : {"nan", "inf", "", "3x", "0x10", "1e999"})
        EXPECT_EQ(mistake(std::string("rain=") + value),
                  std::string("'rain': expected a number such as 8 or 0.5, got '") + value + "'");
    EXPECT_EQ(mistake("rain=3,rain_mm_h=4"), "'rain_mm_h' says a number that was said already");
    EXPECT_EQ(mistake("okta=3,clouds=1"), "'clouds' says a number that was said already");
    EXPECT_EQ(mistake("clear_noon,"), "expected KEY=VALUE such as rain=8, got ''");
    EXPECT_EQ(mistake("clear_noon,cloudy_noon"),
              "expected KEY=VALUE such as rain=8, got 'cloudy_noon'");
    EXPECT_EQ(mistake(""), "no weather ''; reprise list weathers shows them all");
}

}  // namespace
}  // namespace reprise::world
