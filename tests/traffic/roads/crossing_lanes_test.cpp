#include "traffic/roads/crossing_lanes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include <gtest/gtest.h>

#include "process/program.h"
#include "tests/support/street_motion.h"
#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"

namespace reprise::traffic {
namespace {

/// From south to north, with one lane; its index.
std::size_t add_road(world::TownT& town, const char* edge, double x, double height) {
    world::LaneT road = town.lanes[1];  // east_1
    road.edge = edge;
    road.left = road.right = world::none;
    road.centre = {world::Vec3(x, -60, height), world::Vec3(x, 60, height)};
    town.lanes.push_back(road);
    return town.lanes.size() - 1;
}

TEST(CrossingLanes, AreThoseOnOneLevel) {
    world::TownT town = test::straight_road();
    const std::size_t bridge = add_road(town, "bridge", 100, 6);
    const std::size_t beside = add_road(town, "beside", 500, 0);
    const std::vector<bool> none_cross = lanes_that_cross(town);
    EXPECT_EQ(std::count(none_cross.begin(), none_cross.end(), true), 0);
    const std::size_t across = add_road(town, "across", 200, 1);
    const std::vector<bool> cross = lanes_that_cross(town);
    EXPECT_TRUE(cross[1] && cross[across]);
    EXPECT_FALSE(cross[bridge] || cross[beside]);
}

/// Two roads that cross where the network has no junction: SUMO's cars drove through each other.
test::Loaded roads_without_a_junction() {
    const auto folder = std::filesystem::path(testing::TempDir()) / "crossing_lanes";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "nodes.xml")
        << R"(<nodes> <node id="w" x="-150" y="0"/> <node id="e" x="150" y="0"/>
        <node id="s" x="-60" y="-150"/> <node id="n" x="60" y="150"/> </nodes>)";
    std::ofstream(folder / "edges.xml")
        << R"(<edges> <edge id="we" from="w" to="e"/> <edge id="ew" from="e" to="w"/>
        <edge id="sn" from="s" to="n"/> <edge id="ns" from="n" to="s"/> </edges>)";
    const process::ProgramResult made = process::run_program(
        {.name = "netconvert",
         .words = {"-X", "never", "-n", "nodes.xml", "-e", "edges.xml", "-o", "crossing.net.xml"},
         .folder = folder});
    EXPECT_EQ(made.code, 0) << made.said;
    return test::load(folder / "crossing.net.xml");
}

TEST(CrossingLanes, NobodyDrivesThroughAnybody) {
    const test::Loaded loaded = roads_without_a_junction();
    test::Stage stage(loaded, 16, 5);
    test::StreetMotion motion(loaded.town, 0.05);
    for (int i = 0; i < 2400; ++i) {
        stage.step();
        motion.see(stage.view());
    }
    EXPECT_GT(motion.driven, 2000) << "[m]";
    EXPECT_LT(motion.overlaps.worst.value, 0.2) << motion.text();
}

}  // namespace
}  // namespace reprise::traffic
