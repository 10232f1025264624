#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scripting/stage.h"
#include "world/lanes/road_place.h"

namespace reprise::scripting {

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// The east-bound lane is lane -1 of road 12, from its s = 20 on.
world::TownT town_of_a_map() {
    world::TownT town = test::straight_road(400, 2);
    world::set_road_pieces(town.lanes[*world::find_lane(town, "east_1")],
                           {{"12", -1, {{0, 20}, {400, 420}}}});
    return town;
}

/// What a scenario in that town prints, or its mistake.
std::vector<std::string> said(const std::string& body) {
    test::Stage stage(test::running(body), town_of_a_map());
    try {
        return stage.play(3);
    } catch (const world::Error& error) {
        return {error.what()};
    }
}

}  // namespace

TEST(RoadWords, GoFromTheMapsPlacesToLanesAndBack) {
    EXPECT_THAT(said("print(road_lane('12', -1, 50)) print(road_lane(12, -1, 20)) "
                     "print(lane_road('east_1', 30)) print(lane_road('east_2', 30))"),
                ElementsAre("east_1 30.0", "east_1 0.0", "12 -1 50.0", "nil"));
}

TEST(RoadWords, NameWhatThereIs) {
    EXPECT_THAT(said("road_lane('13', -1, 50)"),
                ElementsAre(HasSubstr(
                    "test.lua:1: road_lane: no road '13' in straight_road (did you mean '12'?)")));
    EXPECT_THAT(said("road_lane('12', 1, 50)"),
                ElementsAre(HasSubstr("has no lane 1; there are -1")));
    EXPECT_THAT(said("road_lane('12', -1, 500)"),
                ElementsAre(HasSubstr("there is one from 20.00 to 420.00 m")));
    EXPECT_THAT(said("road_lane('12', 'left', 5)"),
                ElementsAre(HasSubstr("the lane must be a whole number")));
    EXPECT_THAT(said("lane_road('east_9')"), ElementsAre(HasSubstr("no lane 'east_9'")));
    EXPECT_EQ(
        test::mistake("road_lane('12', -1, 50)"),
        "test.lua:1: road_lane: straight_road was no OpenDRIVE map: it has no roads by number");
}

}  // namespace reprise::scripting
