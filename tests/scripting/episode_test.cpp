#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scripting/scenario.h"
#include "tests/support/worlds.h"
#include "world/check.h"
#include "world/lanes/density.h"
#include "world/weather/weather.h"

namespace reprise::scripting {

namespace {

class EpisodeFile : public testing::Test {
  protected:
    void SetUp() override {
        const auto* info = testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::temp_directory_path() /
                 ("reprise_episode_" + std::string(info->name()) + std::to_string(getpid()));
        std::filesystem::create_directories(folder);
    }

    void TearDown() override { std::filesystem::remove_all(folder); }

    world::EpisodeT load(const std::string& source, const Overrides& overrides = {}) {
        std::ofstream(folder / "story.lua") << source;
        return load_episode(folder / "story.lua", overrides);
    }

    std::string mistake(const std::string& source, const Overrides& overrides = {}) {
        try {
            load(source, overrides);
        } catch (const world::Error& error) {
            return error.what();
        }
        return "";
    }

    std::string mistake_in_path(const std::string& name) {
        try {
            load_episode(folder / name, {});
        } catch (const world::Error& error) {
            std::string text = error.what();
            const std::string prefix = folder.string() + "/";
            if (const auto at = text.find(prefix); at != std::string::npos)
                text.erase(at, prefix.size());
            return text;
        }
        return "";
    }

    static std::vector<std::string> parameters(const world::EpisodeT& episode) {
        std::vector<std::string> list;
        for (const auto& parameter : episode.parameters)
            list.push_back(parameter.key + " = " + parameter.value);
        return list;
    }

    std::filesystem::path folder;
};

constexpr const char* full = R"(return scenario 'story' {
    town = 'town2', duration = 12.34, seed = 9, cars = 5, weather = 'hard_rain_sunset',
    params = { gap = 12, speed = 2.5, rain = true, name = "it's" },
    run = function(p) end,
})";

}  // namespace

using testing::ElementsAre;

TEST_F(EpisodeFile, HoldsWhatTheHeaderSays) {
    const world::EpisodeT episode = load(full);
    EXPECT_EQ(episode.name, "story");
    EXPECT_EQ(episode.scenario_path, "story.lua");
    EXPECT_EQ(episode.scenario, full);
    EXPECT_EQ(episode.town, "town2");
    EXPECT_EQ(episode.seed, 9U);
    EXPECT_EQ(episode.step_ns, 50'000'000U);
    EXPECT_EQ(episode.substeps, 10U);
    EXPECT_EQ(episode.max_ticks, 247U);  // 246.8 rounded up
    EXPECT_EQ(episode.cars, 5U);
    EXPECT_EQ(episode.weather_name, "hard_rain_sunset");
    EXPECT_EQ(episode.weather, world::find_weather("hard_rain_sunset")->weather);
    EXPECT_EQ(episode.road_friction, world::find_weather("hard_rain_sunset")->road_friction);
    EXPECT_THAT(parameters(episode),
                ElementsAre("gap = 12", "name = 'it\\'s'", "rain = true", "speed = 2.5"));
}

TEST_F(EpisodeFile, HasDefaultsForAllButTheStory) {
    const world::EpisodeT episode = load("return scenario 'short' { run = function() end }");
    EXPECT_EQ(episode.town, "town1");
    EXPECT_EQ(episode.max_ticks, 1200U);
    EXPECT_EQ(episode.seed, 0U);
    EXPECT_EQ(episode.cars, 0U);
    EXPECT_EQ(episode.weather_name, "clear_noon");
    EXPECT_TRUE(episode.parameters.empty());
}

TEST_F(EpisodeFile, TheCommandLineHasTheLastWord) {
    Overrides overrides;
    overrides.town = "maps/other.net.xml";
    overrides.seed = 11;
    overrides.duration = 1;
    overrides.parameters = {
        {"gap", "20.0"}, {"speed", "3"}, {"rain", "false"}, {"name", "a b"}, {"gap", "21"}};
    const world::EpisodeT episode = load(full, overrides);
    EXPECT_EQ(episode.town, "maps/other.net.xml");
    EXPECT_EQ(episode.seed, 11U);
    EXPECT_EQ(episode.max_ticks, 20U);
    EXPECT_THAT(parameters(episode),
                ElementsAre("gap = 21", "name = 'a b'", "rain = false", "speed = 3.0"));
}

TEST_F(EpisodeFile, EqualNumbersGiveEqualEpisodes) {
    const auto with = [&](const char* gap, const char* speed) {
        Overrides overrides;
        overrides.parameters = {{"gap", gap}, {"speed", speed}};
        return parameters(load(full, overrides));
    };
    EXPECT_EQ(with("20", "3"), with("2e1", "3.00"));
}

TEST_F(EpisodeFile, NamesTheParameterThatWasMeant) {
    const auto set = [&](const char* key, const char* value) {
        Overrides overrides;
        overrides.parameters = {{key, value}};
        return mistake(full, overrides);
    };
    EXPECT_EQ(set("gpa", "3"),
              "story.lua:1: --set gpa=3: no parameter 'gpa' (did you mean 'gap'?); there are gap, "
              "name, rain, speed");
    EXPECT_EQ(set("gap", "far"), "story.lua:1: --set gap=far: must be a number");
    EXPECT_EQ(set("gap", "nan"), "story.lua:1: --set gap=nan: must be a number");
    EXPECT_EQ(set("rain", "1"), "story.lua:1: --set rain=1: must be true or false");
    Overrides overrides;
    overrides.parameters = {{"x", "1"}};
    EXPECT_EQ(mistake("return scenario 'x' { run = function() end }", overrides),
              "story.lua:1: --set x=1: the scenario has no parameters");
}

TEST_F(EpisodeFile, AutoCarsAreAsManyAsItsTownCarries) {
    const std::string story = "return scenario 'x' { cars = 'auto', run = function() end }";
    world::EpisodeT episode = load(story);
    EXPECT_EQ(episode.cars, world::auto_cars);
    // Two lanes of a kilometre each; the sidewalks beside them carry none.
    const world::TownT road = test::straight_road(1000, 1);
    world::settle_cars(episode, road);
    EXPECT_EQ(episode.cars, world::cars_carried(road));
    EXPECT_EQ(episode.cars, 70U);
    // A number stays what it is, and the command line's counts.
    Overrides overrides;
    overrides.cars = 12;
    episode = load(story, overrides);
    world::settle_cars(episode, road);
    EXPECT_EQ(episode.cars, 12U);
}

TEST_F(EpisodeFile, MistakesInTheHeaderNameTheirLine) {
    const auto header = [](const std::string& keys) {
        return "\nreturn scenario 'x' { " + keys + ", run = function() end }";
    };
    const std::vector<std::pair<std::string, std::string>> table{
        {header("duratoin = 3"),
         "story.lua:2: scenario: unknown key 'duratoin' (did you mean 'duration'?)"},
        {header("zz = 1, aa = 2"),
         "story.lua:2: scenario: unknown key 'aa' (known: town, duration, seed, cars, walkers, "
         "walker_seed, jaywalkers, weather, friction, "
         "params, run)"},
        {header("1"), "story.lua:2: scenario: every value needs its key: { key = value }"},
        {header("town = 3"), "story.lua:2: scenario: 'town' must be a string, got 3"},
        {header("duration = '3'"), "story.lua:2: scenario: 'duration' must be a number, got '3'"},
        {header("duration = 0"), "story.lua:2: scenario: 'duration' must be in (0, 86400] s"},
        {header("duration = 0/0"),
         "story.lua:2: scenario: 'duration' must be a finite number, got nan"},
        {header("seed = 1.5"), "story.lua:2: scenario: 'seed' must be a whole number, got 1.5"},
        {header("seed = -1"), "story.lua:2: scenario: 'seed' must not be below 0"},
        {header("cars = -1"), "story.lua:2: scenario: 'cars' must be in [0, 10000]"},
        {header("cars = 'many'"),
         "story.lua:2: scenario: 'cars' must be a whole number or 'auto', got 'many'"},
        {header("cars = 1.5"), "story.lua:2: scenario: 'cars' must be a whole number, got 1.5"},
        {header("walkers = -1"), "story.lua:2: scenario: 'walkers' must be in [0, 2000]"},
        {header("walkers = 2001"), "story.lua:2: scenario: 'walkers' must be in [0, 2000]"},
        {header("walkers = 2.5"),
         "story.lua:2: scenario: 'walkers' must be a whole number, got 2.5"},
        {header("walkers = 'auto'"),
         "story.lua:2: scenario: 'walkers' must be a whole number, got 'auto'"},
        {header("walker_seed = -3"), "story.lua:2: scenario: 'walker_seed' must not be below 0"},
        {header("walker_seed = 0.5"),
         "story.lua:2: scenario: 'walker_seed' must be a whole number, got 0.5"},
        {header("walker_sed = 3"),
         "story.lua:2: scenario: unknown key 'walker_sed' (did you mean 'walker_seed'?)"},
        {header("jaywalkers = -0.1"),
         "story.lua:2: scenario: 'jaywalkers' must be in [0, 1]: a share of the walkers"},
        {header("jaywalkers = 10"),
         "story.lua:2: scenario: 'jaywalkers' must be in [0, 1]: a share of the walkers"},
        {header("jaywalkers = 0/0"),
         "story.lua:2: scenario: 'jaywalkers' must be a finite number, got nan"},
        {header("jaywalkers = 'few'"),
         "story.lua:2: scenario: 'jaywalkers' must be a number, got 'few'"},
        {header("weather = 'claer_noon'"),
         "story.lua:2: scenario: no weather 'claer_noon' (did you mean 'clear_noon'?); reprise "
         "list weathers shows them all"},
        {header("params = 3"),
         "story.lua:2: scenario: 'params' must be a table: params = { gap = 12 }"},
        {header("params = { 3 }"),
         "story.lua:2: scenario: params: every parameter needs a name: params = { gap = 12 }"},
        {header("params = { f = print }"),
         "story.lua:2: scenario: params: 'f' must be a finite number, a string, true or false"},
        {header("params = { f = 1/0 }"),
         "story.lua:2: scenario: params: 'f' must be a finite number, a string, true or false"},
        {"return scenario 'x' {}", "story.lua:1: scenario: 'run' must be a function, got nil"},
        {"return scenario 'x y' { run = print }",
         "story.lua:1: scenario: the name 'x y' must be made of letters, digits and _"},
        {"return scenario(3)", "story.lua:1: scenario: the name must be a string, got 3"},
        {"scenario 'x' { run = print }",
         "story.lua: a scenario file ends with: return scenario 'name' { ... }"},
        {"return 3", "story.lua: a scenario file ends with: return scenario 'name' { ... }"},
        {"scenario 'x' { run = print }\nreturn scenario 'x' { run = print }",
         "story.lua:2: scenario: a file holds one scenario"},
        {"\nspawn{}", "story.lua:2: only the scenario's run function can do this"},
        {"return scenario 'x' {\nrun = function( end }",
         "story.lua:2: <name> or '...' expected near 'end'"},
        {"\n\nlocal x = nil + 1", "story.lua:3: attempt to perform arithmetic on a nil value"},
        {"error('mine')", "story.lua:1: mine"},
        {"error({})", "story.lua:1: error with a table instead of a message"},
    };
    for (const auto& [source, message] : table)
        EXPECT_EQ(mistake(source), message) << source;
}

TEST_F(EpisodeFile, FilesThatAreNoScenarioAreNamed) {
    std::ofstream(folder / "cut_in.lua") << full;
    std::ofstream(folder / "empty.lua") << " \n\t\n";
    std::ofstream(folder / "compiled.lua") << "\x1bLua";
    std::ofstream(folder / "huge.lua") << std::string((1U << 20U) + 1, ' ');
    std::filesystem::create_directory(folder / "folder");
    EXPECT_EQ(mistake_in_path("cut_on.lua"),
              "no scenario file 'cut_on.lua' (did you mean 'cut_in.lua'?)");
    EXPECT_EQ(mistake_in_path("empty.lua"),
              "'empty.lua' is empty: a scenario file ends with: return scenario 'name' { ... }");
    EXPECT_EQ(mistake_in_path("compiled.lua"),
              "'compiled.lua' is compiled Lua: a scenario is Lua source");
    EXPECT_EQ(mistake_in_path("huge.lua"), "'huge.lua' is larger than 1 MB: not a scenario");
    EXPECT_EQ(mistake_in_path("folder"),
              "'folder' is not a file: name a scenario, such as cut_in.lua");
}

TEST_F(EpisodeFile, IsReadableWithAByteOrderMark) {
    EXPECT_EQ(load(std::string("\xef\xbb\xbf") + full).name, "story");
}

}  // namespace reprise::scripting
