#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "world/external/sensor_attributes.h"
#include "world/story/wording.h"

namespace reprise::test {
namespace {

constexpr const char* external = "spawn{ model = 'sedan', driver = 'external', lane = 'east_1', ";

std::string of_rig(const std::string& rig) {
    return mistake("spawn{ model = 'sedan', lane = 'east_1', s = 20, rig = " + rig + " }");
}

std::string of_sensor(const std::string& keys) {
    return of_rig("{ { name = 'front', " + keys + " } }");
}

const world::CommandT& spawned(Stage& stage) {
    stage.step();
    return stage.commands.front();
}

TEST(RigWords, AreRecordedAsTheyWereSaid) {
    Stage stage(running(std::string(external) + R"(latency = 3, sees = 'sensors', rig = {
        { name = 'front' },
        { name = 'left-2', kind = 'depth', width = 200, height = 88, fov_deg = 60, x = -1.5, y = 0.5, z = 2,
          yaw_deg = 90, pitch_deg = -10, roll_deg = 5, every = 4, attributes = { own_car = 1 } } } })"));
    const world::CommandT& command = spawned(stage);
    EXPECT_TRUE(command.sees_sensors);
    ASSERT_EQ(command.rig.size(), 2U);
    world::SensorT usual;
    usual.name = "front";
    usual.width = 800;
    usual.height = 600;
    usual.fov = std::numbers::pi / 2;
    usual.position = {1, 0, 1.4};
    usual.every = 1;
    EXPECT_TRUE(*command.rig[0] == usual);
    world::SensorT said;
    said.name = "left-2";
    said.kind = world::SensorKind::depth;
    said.width = 200;
    said.height = 88;
    said.fov = std::numbers::pi / 3;
    said.position = {-1.5, 0.5, 2};
    said.yaw = std::numbers::pi / 2;
    said.pitch = -std::numbers::pi / 18;
    said.every = 4;
    said.roll = std::numbers::pi / 36;
    auto own_car = std::make_unique<world::SensorAttributeT>();
    own_car->name = "own_car";
    own_car->value = 1;
    said.attributes.push_back(std::move(own_car));
    EXPECT_NEAR(command.rig[1]->fov, said.fov, 1e-15);
    EXPECT_NEAR(command.rig[1]->pitch, said.pitch, 1e-15);
    said.fov = command.rig[1]->fov;
    said.pitch = command.rig[1]->pitch;
    EXPECT_NEAR(command.rig[1]->roll, said.roll, 1e-15);
    said.roll = command.rig[1]->roll;
    EXPECT_TRUE(*command.rig[1] == said);
}

TEST(RigWords, AreAbsentWhereNobodySaysThem) {
    Stage stage(running(std::string(external) + "sees = 'everything' }"));
    EXPECT_TRUE(spawned(stage).rig.empty());
    EXPECT_FALSE(spawned(stage).sees_sensors);
}

TEST(RigWords, MistakesAreOneLineThatNamesTheSensor) {
    const std::string list =
        "test.lua:1: spawn: 'rig' must be a list of sensors { { name = "
        "'front', ... }, ... }";
    const std::string first = "test.lua:1: spawn: sensor 1 of 'rig': ";
    EXPECT_EQ(of_rig("'rgb'"), list + ", got string");
    EXPECT_EQ(of_rig("{}"), list);
    EXPECT_EQ(of_rig("{ name = 'front' }"), list);
    EXPECT_EQ(of_rig("{ { name = 'a' }, 7 }"),
              "test.lua:1: spawn: sensor 2 of 'rig': the argument must be a table { key = value }, "
              "got 7");
    EXPECT_EQ(of_rig("{ {} }"), first + "'name' is missing");
    EXPECT_EQ(of_rig("{ { name = '../x' } }"),
              first +
                  "'name' must be 1 to 40 letters, digits, '_' or '-', as it names a folder, "
                  "got '../x'");
    EXPECT_EQ(of_rig("{ { name = 'a' }, { name = 'b' }, { name = 'a' } }"),
              "test.lua:1: spawn: sensors 1 and 3 of 'rig' are both named 'a'");
    EXPECT_EQ(of_sensor("kind = 'detph'"),
              first +
                  "no kind 'detph' (did you mean 'depth'?); there are rgb, depth, semantic, "
                  "instance, flow, normals, dvs, lidar, semantic_lidar, radar, gnss, imu, "
                  "collision, lane_invasion, obstacle");
    EXPECT_EQ(of_sensor("kind = 'lidar', attributes = { chanels = 3 }"),
              first + "'attributes': unknown key 'chanels' (did you mean 'channels'?)");
    EXPECT_EQ(of_sensor("kind = 'radar', attributes = { range = 0 }"),
              first + "'attributes': 'range' must be in [1, 1000], got 0.0");
    EXPECT_EQ(of_sensor("wdth = 3"), first + "unknown key 'wdth' (did you mean 'width'?)");
    EXPECT_EQ(of_sensor("width = 0"), first + "'width' must be in [1, 4096], got 0");
    EXPECT_EQ(of_sensor("height = 4097"), first + "'height' must be in [1, 4096], got 4097");
    EXPECT_EQ(of_sensor("width = 84.5"), first + "'width' must be a whole number, got 84.5");
    EXPECT_EQ(of_sensor("fov_deg = 201"), first + "'fov_deg' must be in [1, 200], got 201.0");
    EXPECT_EQ(of_sensor("fov_deg = 171"),
              first + "a field of view beyond 170 degrees needs lens fisheye");
    EXPECT_EQ(of_sensor("attributes = { lens = 'fishey' }"),
              first +
                  "'attributes': 'lens' must be pinhole or fisheye, got 'fishey' (did you mean "
                  "'fisheye'?)");
    EXPECT_EQ(of_sensor("attributes = { lens = 'fisheye', p1 = 0.1 }"),
              first + "a fisheye has k1, k2, k3 and k4, and no p1 and p2");
    EXPECT_EQ(of_sensor("x = 0/0"), first + "'x' must be a finite number, got nan");
    EXPECT_EQ(of_sensor("z = 51"), first + "'z' must be in [-50, 50], got 51.0");
    EXPECT_EQ(of_sensor("pitch_deg = 91"), first + "'pitch_deg' must be in [-90, 90], got 91.0");
    EXPECT_EQ(of_sensor("attributes = { own_cat = 1 }"),
              first + "'attributes': unknown key 'own_cat' (did you mean 'own_car'?)");
    EXPECT_EQ(of_sensor("attributes = { own_car = 2 }"),
              first + "'attributes': 'own_car' must be in [0, 1], got 2.0");
    EXPECT_EQ(of_sensor("every = 0"), first + "'every' must be in [1, 100000], got 0");
    EXPECT_EQ(mistake("local r = {} for i = 1, 17 do r[i] = { name = 's' .. i } end spawn{ model = "
                      "'sedan', rig = r }"),
              "test.lua:1: spawn: 'rig' has 17 sensors, where 16 is the most");
    EXPECT_EQ(mistake("spawn{ name = 'v', model = 'van', driver = 'traffic', rig = { { name = 'a' "
                      "} } }"),
              "test.lua:1: spawn: 'rig' is for the drivers 'autopilot', 'manual' and 'external', "
              "'v' has another one");
    EXPECT_EQ(mistake("spawn{ name = 'v', model = 'van', driver = 'external', latency = 100, rig = "
                      "{ { name = 'a', width = 4096, height = 4096 } } }"),
              "test.lua:1: spawn: the frames of 'rig' need 5.1 GB of memory, where 2.1 are the "
              "most: smaller or fewer ones, or a smaller 'latency'");
    EXPECT_EQ(mistake(std::string(external) + "every = 2, rig = { { name = 'a', every = 3 } } }"),
              "test.lua:1: spawn: sensor 1 of 'rig': 'every' must be a multiple of the vehicle's, "
              "2, or its driver would not be shown every frame, got 3");
    EXPECT_EQ(mistake(std::string(external) + "every = 101 }"),
              "test.lua:1: spawn: 'every' must be in [1, 100] ticks, got 101");
    EXPECT_EQ(mistake("spawn{ name = 'v', model = 'van', every = 2 }"),
              "test.lua:1: spawn: 'every' is for driver = 'external', 'v' is driven by Reprise");
    EXPECT_EQ(mistake("spawn{ name = 'v', model = 'van', sees = 'sensors' }"),
              "test.lua:1: spawn: 'sees' is for driver = 'external', 'v' is driven by Reprise");
    EXPECT_EQ(mistake(std::string(external) + "sees = 'sensor' }"),
              "test.lua:1: spawn: 'sees' must be 'everything' or 'sensors', got 'sensor' (did you "
              "mean 'sensors'?)");
}

TEST(RigWords, SensorsLookAsOftenAsTheirDriverDoesUnlessTheySayOtherwise) {
    Stage stage(running(std::string(external) + R"(every = 2, rig = {
        { name = 'a' }, { name = 'b', every = 6 }, { name = 'c', kind = 'collision', every = 1 } } })"));
    const world::CommandT& command = spawned(stage);
    EXPECT_DOUBLE_EQ(command.duration, 0.1) << "[s] from one tick that it is shown to the next";
    ASSERT_EQ(command.rig.size(), 3U);
    EXPECT_EQ(command.rig[0]->every, 2U);
    EXPECT_EQ(command.rig[1]->every, 6U);
    EXPECT_EQ(command.rig[2]->every, 1U) << "it tells what happens, whenever that is";
    Stage each(running(std::string(external) + "every = 1 }"));
    EXPECT_EQ(spawned(each).duration, 0) << "as if it had said nothing";
}

std::string said(const world::AttributeRow& row) {
    return row.words.empty() ? std::to_string(row.usual) : "'" + world::words_of(row).front() + "'";
}

TEST(RigWords, EveryKindOfSensorHasItsOwnKeysAndNoOthers) {
    const std::string first = "test.lua:1: spawn: sensor 1 of 'rig': ";
    for (const std::string& kind : world::sensor_kinds()) {
        const std::string of_kind = "kind = '" + kind + "', ";
        const std::vector<std::string> cameras = world::camera_kinds();
        const bool camera = std::find(cameras.begin(), cameras.end(), kind) != cameras.end();
        for (const std::string key : {"width", "height", "fov_deg"})
            EXPECT_EQ(of_sensor(of_kind + key + " = 5"),
                      camera ? ""
                             : first + "'" + key + "' is of cameras; what " +
                                   world::with_article(kind) + " measures, its 'attributes' say");
        for (const std::string key : {"x", "y", "z", "yaw_deg", "pitch_deg", "roll_deg", "every"})
            EXPECT_EQ(of_sensor(of_kind + key + " = 5"), "") << kind;
        for (const world::AttributeRow& row : world::attribute_rows()) {
            const std::string name(row.name);
            const auto* own = world::find_attribute(*world::find_sensor_kind(kind), name);
            const std::string why = of_sensor(of_kind + "attributes = { " + name + " = " +
                                              said(own != nullptr ? *own : row) + " }");
            if (own != nullptr)
                EXPECT_EQ(why, "") << kind;
            else
                EXPECT_TRUE(why.starts_with(first + "'attributes': unknown key '" + name + "'"))
                    << kind << ": " << why;
        }
    }
}

}  // namespace
}  // namespace reprise::test
