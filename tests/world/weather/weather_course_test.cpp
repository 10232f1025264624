#include "world/weather/weather_course.h"

#include <cmath>

#include <gtest/gtest.h>

#include "world/check.h"
#include "world/weather/weather_field.h"
#include "world/weather/weather_text.h"

namespace reprise::world {
namespace {

TEST(WeatherCourse, GoesEvenlyInEachNumberBetweenItsStops) {
    const WeatherCourse course("0s:clear_noon,30s:hard_rain_sunset,fog=300,40s:cloudy_noon");
    const Weather first = find_weather("clear_noon")->weather;
    const Weather second = read_weather("hard_rain_sunset,fog=300").weather;
    EXPECT_EQ(course.at(0), first);
    EXPECT_EQ(course.at(30), second);
    EXPECT_EQ(course.at(40), find_weather("cloudy_noon")->weather);
    EXPECT_EQ(course.at(9999), find_weather("cloudy_noon")->weather);
    for (const WeatherField& field : weather_fields()) {
        const auto from = static_cast<double>((first.*field.get)());
        const auto to = static_cast<double>((second.*field.get)());
        EXPECT_NEAR(static_cast<double>((course.at(7.5).*field.get)()),
                    from + (to - from) / 4,
                    1e-5 * (1 + std::abs(to - from)))
            << field.key;
    }
}

TEST(WeatherCourse, NumbersAloneChangeTheWeatherOfTheStopBefore) {
    const WeatherCourse course("cloudy_sunset,10s:rain=20,20s:rain=0");
    const Weather sunset = find_weather("cloudy_sunset")->weather;
    EXPECT_EQ(course.at(0), sunset) << "a first one without a time is at the start";
    EXPECT_EQ(course.at(10).rain(), 20);
    EXPECT_EQ(course.at(10).sun_altitude(), sunset.sun_altitude());
    EXPECT_EQ(course.at(20).rain(), 0);
    EXPECT_GT(course.at(20).wetness(), 0.9F) << "what has rained lies there";
}

TEST(WeatherCourse, BeforeItsFirstStopItIsAsThere) {
    const WeatherCourse course("5s:clear_night,6s:clear_noon");
    EXPECT_EQ(course.at(0), find_weather("clear_night")->weather);
    EXPECT_EQ(WeatherCourse("foggy_noon").at(3), find_weather("foggy_noon")->weather);
}

TEST(WeatherCourse, MistakesAreOneLine) {
    for (const char* text : {"",
                             "0s:",
                             "0s:clear_noon,0s:wet_noon",
                             "-1s:clear_noon",
                             "nans:clear_noon",
                             "1:clear_noon",
                             "1s:clear_noon,",
                             "1s:rain=-2",
                             "infs:clear_noon"})
        EXPECT_THROW(WeatherCourse{text}, Error) << text;
}

}  // namespace
}  // namespace reprise::world
