#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripting/scenario.h"
#include "tests/scripting/stage.h"
#include "world/models/catalogue.h"
#include "world/weather/weather_text.h"

// The weather and the signals: what a scenario says to nobody's car.
namespace reprise::scripting {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using world::CommandKind;
using world::SignalColor;

world::EpisodeT with_header(const std::string& keys) {
    return episode_of_text(
        "test.lua", "return scenario 'test' { " + keys + ", run = function() end }", {});
}

std::vector<world::CommandT> weathers(const std::vector<world::CommandT>& commands) {
    std::vector<world::CommandT> found;
    std::copy_if(commands.begin(), commands.end(), std::back_inserter(found), [](const auto& each) {
        return each.kind == CommandKind::set_weather;
    });
    return found;
}

TEST(Weather, IsSaidByNumbersOnTopOfAPreset) {
    const world::EpisodeT episode = with_header(
        "weather = { preset = 'hard_rain_sunset', rain_mm_h = 7, visibility = 300, "
        "sun_altitude_deg = 30, friction = 0.5 }");
    const world::Weather preset = world::find_weather("hard_rain_sunset")->weather;
    EXPECT_EQ(episode.weather.rain(), 7.0F);
    EXPECT_NEAR(static_cast<double>(episode.weather.fog_extinction()), 0.01, 1e-9);
    EXPECT_NEAR(static_cast<double>(episode.weather.sun_altitude()), M_PI / 6, 1e-6);
    EXPECT_EQ(episode.weather.wetness(), preset.wetness());
    EXPECT_EQ(episode.weather.wind_speed(), preset.wind_speed());
    EXPECT_EQ(episode.road_friction, 0.5);
    EXPECT_EQ(episode.weather_name, "hard_rain_sunset, changed");
}

TEST(Weather, IsSaidAsOnTheCommandLine) {
    const world::EpisodeT episode = with_header("weather = 'cloudy_noon,rain=8,fog=300'");
    const world::WeatherPreset said = world::read_weather("cloudy_noon,rain=8,fog=300");
    EXPECT_EQ(episode.weather, said.weather);
    EXPECT_EQ(episode.road_friction, said.road_friction);
    EXPECT_EQ(episode.weather_name, said.name);
}

TEST(Weather, OfThePresetAloneIsThePreset) {
    const world::EpisodeT by_table = with_header("weather = { preset = 'hard_rain_sunset' }");
    const world::EpisodeT by_name = with_header("weather = 'hard_rain_sunset'");
    EXPECT_EQ(by_table.weather, by_name.weather);
    EXPECT_EQ(by_table.weather_name, by_name.weather_name);
    EXPECT_EQ(by_table.road_friction, by_name.road_friction);
}

TEST(Friction, OfTheHeaderHoldsWhateverTheWeatherBecomes) {
    EXPECT_EQ(with_header("friction = 0.9").road_friction, 0.9);
    EXPECT_EQ(with_header("friction = 0.9, weather = 'hard_rain_sunset'").road_friction, 0.9);
    test::Stage stage(
        "return scenario 'test' { friction = 0.9, run = function() "
        "set_weather 'hard_rain_sunset' wait_ticks(1) set_weather{ friction = 0.4 } end }");
    stage.play(4);
    const auto said = weathers(stage.commands);
    ASSERT_EQ(said.size(), 2U);
    EXPECT_EQ(said[0].road_friction, 0) << "of the stage's ticks, which the weather leaves alone";
    EXPECT_EQ(said[1].road_friction, 0.4) << "named in so many words";
}

TEST(Weather, ChangesEvenlyOverItsTime) {
    test::Stage stage(
        test::running("set_weather({ rain_mm_h = 10, cloud_cover = 1 }, { over = 0.5 }) wait(2)"));
    stage.play(30);
    const auto said = weathers(stage.commands);
    ASSERT_EQ(said.size(), 10U) << "a command in each tick of half a second";
    for (std::size_t i = 0; i < said.size(); ++i)
        EXPECT_NEAR(static_cast<double>(said[i].weather.rain()), static_cast<double>(i + 1), 1e-6);
    EXPECT_EQ(said.back().weather.cloud_cover(), 1.0F);
    EXPECT_EQ(said.back().line, 1U);
}

TEST(Weather, GoesTheShorterWayRoundWithTheSun) {
    test::Stage stage(
        test::running("set_weather{ sun_azimuth_deg = 170 } wait_ticks(1) "
                      "set_weather({ sun_azimuth_deg = -170 }, { over = 0.1 }) wait(1)"));
    stage.play(6);
    const auto said = weathers(stage.commands);
    ASSERT_EQ(said.size(), 3U);
    // The stage's ticks keep their own weather, so the change starts from there: from 170 it would
    // be half-way at 180.
    EXPECT_NEAR(
        std::remainder(static_cast<double>(said[2].weather.sun_azimuth()) + 170 * M_PI / 180,
                       2 * M_PI),
        0,
        1e-6);
}

TEST(Weather, FollowsTheHeadersTimeline) {
    test::Stage stage(
        "return scenario 'test' { weather = { { at = 0, preset = 'clear_noon' }, "
        "{ at = 0.5, over = 0.2, rain_mm_h = 6 }, { at = 1, preset = 'hard_rain_sunset' } }, "
        "run = function() wait(3) end }");
    std::vector<std::uint64_t> ticks;
    for (std::uint64_t tick = 1; tick <= 40; ++tick) {
        const std::size_t before = weathers(stage.commands).size();
        stage.step();
        if (weathers(stage.commands).size() > before)
            ticks.push_back(tick);
    }
    EXPECT_THAT(ticks, ElementsAre(11, 12, 13, 14, 21)) << "behind 0.5 s are tick 11 and on";
    const auto said = weathers(stage.commands);
    EXPECT_EQ(said[3].weather.rain(), 6.0F);
    EXPECT_EQ(said[4].weather, world::find_weather("hard_rain_sunset")->weather);
    EXPECT_EQ(said[4].road_friction, world::find_weather("hard_rain_sunset")->road_friction);
}

TEST(Weather, OfTheCommandLineHasNoTimeline) {
    // The stage's episode is clear noon, as `run --weather clear_noon` would make it of this
    // header.
    test::Stage stage(
        "return scenario 'test' { weather = { { at = 0, rain_mm_h = 2 }, { at = 0.5, rain_mm_h = 6 "
        "} },"
        " run = function() wait(3) end }");
    stage.play(40);
    EXPECT_TRUE(weathers(stage.commands).empty());
}

TEST(Weather, MistakesNameTheKeyAndTheRange) {
    const auto mistake = [](const std::string& keys) {
        try {
            with_header(keys);
        } catch (const world::Error& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    EXPECT_EQ(mistake("weather = { rain = 5 }"),
              "test.lua:1: scenario: weather: unknown key 'rain' (did you mean 'rain_mm_h'?)");
    EXPECT_EQ(mistake("weather = { cloud_cover = 1, okta = 3 }"),
              "test.lua:1: scenario: weather: 'cloud_cover' and 'okta' say the same");
    EXPECT_EQ(mistake("weather = 'clear_noon,rain=nan'"),
              "test.lua:1: scenario: 'rain': expected a number such as 8 or 0.5, got 'nan'");
    EXPECT_EQ(mistake("weather = { rain_mm_h = -1 }"),
              "test.lua:1: scenario: weather: 'rain_mm_h' must be in [0.0, 200.0], got -1.0");
    EXPECT_EQ(mistake("friction = 0"),
              "test.lua:1: scenario: 'friction' must be in (0, 2], as a factor on dry asphalt's "
              "grip, got 0.0");
    EXPECT_EQ(mistake("weather = { preset = 'clear_non' }"),
              "test.lua:1: scenario: weather: no weather 'clear_non' (did you mean 'clear_noon'?); "
              "reprise list weathers shows them all");
    EXPECT_EQ(mistake("weather = { { at = 3 } }"),
              "test.lua:1: scenario: weather, entry 1: the first one is the weather at the start: "
              "at = 0, without 'over'");
    EXPECT_EQ(mistake("weather = { { at = 0 }, { at = 5 }, { at = 5 } }"),
              "test.lua:1: scenario: weather, entry 3: comes before the one above it: entries are "
              "in the order of 'at'");
    EXPECT_EQ(test::mistake("set_weather{ puddles = 2 }"),
              "test.lua:1: set_weather: 'puddles' must be in [0.0, 1.0], got 2.0");
    EXPECT_EQ(test::mistake("set_weather()"),
              "test.lua:1: set_weather: needs a name or a table: set_weather 'hard_rain_sunset', "
              "set_weather({ rain_mm_h = 8, wetness = 0.6 }, { over = 10 })");
}

TEST(Signals, AreNamedByTheirLaneAndTold) {
    test::Stage stage(test::running("print(signal('east_1'), signal('west_1')) "
                                    "set_signal('east_1', 'green', { duration = 2.5 }) "
                                    "set_signal({ 'east_1', 'east_1' }, 'program') wait(1)"),
                      test::straight_road_with_signal());
    EXPECT_THAT(stage.play(3), ElementsAre("off nil"));
    ASSERT_GE(stage.commands.size(), 2U);
    EXPECT_EQ(stage.commands[0].kind, CommandKind::set_signal);
    EXPECT_THAT(stage.commands[0].signals, ElementsAre(0U));
    EXPECT_EQ(stage.commands[0].color, SignalColor::green);
    EXPECT_EQ(stage.commands[0].duration, 2.5);
    EXPECT_THAT(stage.commands[1].signals, ElementsAre(0U)) << "named twice, said once";
    EXPECT_EQ(stage.commands[1].color, SignalColor::off);
}

TEST(Lamps, AreSaidByNameAndTheOthersAreLeftToTheDriver) {
    test::Stage stage(
        test::running("local ego = spawn{ model = 'sedan', lane = 'east_1', s = 20 } "
                      "ego:set_lamps{ hazard = true, brake = false } ego:set_lamps() wait(1)"));
    stage.play(4);
    std::vector<world::CommandT> said;
    for (const world::CommandT& command : stage.commands)
        if (command.kind == CommandKind::set_lamps)
            said.push_back(command);
    ASSERT_EQ(said.size(), 2U);
    EXPECT_EQ(said[0].lamps, world::lamp_left | world::lamp_right);
    EXPECT_EQ(said[0].lamps_mask, world::lamp_left | world::lamp_right | world::lamp_brake);
    EXPECT_EQ(said[1].lamps_mask, 0);
}

TEST(Lamps, MistakesNameTheActor) {
    const std::string ego =
        "local ego = spawn{ name = 'ego', model = 'sedan', lane = 'east_1', s = 20 } ";
    EXPECT_EQ(test::mistake(ego + "ego:set_lamps{}"),
              "test.lua:1: set_lamps: names no lamp: ego:set_lamps{ hazard = true }, or "
              "ego:set_lamps() to leave them all to the driver");
    EXPECT_EQ(test::mistake(ego + "ego:set_lamps{ hazrad = true }"),
              "test.lua:1: set_lamps: unknown key 'hazrad' (did you mean 'hazard'?)");
    EXPECT_EQ(test::mistake(ego + "ego:set_lamps{ hazard = true, left = false }"),
              "test.lua:1: set_lamps: 'hazard' is both indicators: give it, or 'left' and 'right'");
    EXPECT_EQ(test::mistake(ego + "ego:set_lamps{ beacon = true }"),
              "test.lua:1: set_lamps: a sedan has no beacon: 'police' and 'ambulance' have");
    EXPECT_EQ(test::mistake("spawn{ model = 'child', lane = 'east_0', s = 20 }:set_lamps()"),
              "test.lua:1: set_lamps: 'child' is a walker");
}

TEST(Signals, MistakesSayWhatThereIs) {
    EXPECT_EQ(test::mistake("set_signal('east_1', 'red')"),
              "test.lua:1: set_signal: no signal stands at the end of 'east_1'");
    EXPECT_EQ(test::mistake("set_signal('nowhere', 'red')"),
              "test.lua:1: set_signal: no lane, junction or traffic light 'nowhere' in "
              "straight_road (straight_road has none)");
    EXPECT_THAT(test::mistake("set_signal('east_1', 'blue')"), HasSubstr("no colour 'blue'"));
    EXPECT_EQ(test::mistake("set_signal('east_1', 'red', { duration = 0 })"),
              "test.lua:1: set_signal: 'duration' must be in (0, 86400] s");
    EXPECT_EQ(test::mistake("wait_until_green('east_1')"),
              "test.lua:1: wait_until_green: no signal stands at the end of 'east_1'");
    EXPECT_THAT(test::mistake("signal('east_1', 'leftish')"), HasSubstr("no turn 'leftish'"));
    EXPECT_EQ(test::mistake("check.never('x', function() set_signal('east_1', 'red') end) wait(1)"),
              "test.lua:1: a check may look, but not act or wait");
}

}  // namespace
}  // namespace reprise::scripting
