#include "world/lanes/road_place.h"

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::world {

namespace {

/// The east-bound lane of 400 m as 100 m of road 12, then road 7, which runs the other way.
TownT town_of_two_roads() {
    TownT town = test::straight_road(400, 1);
    LaneT& lane = town.lanes[*find_lane(town, "east_1")];
    set_road_pieces(lane, {{"12", -1, {{0, 20}, {100, 120}}}, {"7", 2, {{100, 310}, {400, 10}}}});
    LaneT& back = town.lanes[*find_lane(town, "west_1")];
    set_road_pieces(back, {{"7", -2, {{0, 10}, {400, 410}}}});
    return town;
}

}  // namespace

TEST(RoadPlace, GoesBothWays) {
    const TownT town = town_of_two_roads();
    const LaneT& lane = town.lanes[*find_lane(town, "east_1")];
    for (const double s : {0.0, 50.0, 99.0, 101.0, 250.0, 400.0}) {
        const auto place = road_place(lane, s);
        ASSERT_TRUE(place);
        EXPECT_EQ(place->road, s < 100 ? "12" : "7");
        EXPECT_EQ(place->lane, s < 100 ? -1 : 2);
        EXPECT_NEAR(place->s, s < 100 ? 20 + s : 410 - s, 1e-9);
        const auto found = find_road_place(town, *place);
        ASSERT_TRUE(found);
        EXPECT_EQ(town.lanes[found->lane].name, "east_1");
        EXPECT_NEAR(found->s, s, 1e-9);
    }
}

TEST(RoadPlace, SaysAPlainRoadInTwoNumbers) {
    const TownT town = town_of_two_roads();
    const LaneT& lane = town.lanes[*find_lane(town, "west_1")];
    EXPECT_EQ(lane.road, "7");
    EXPECT_EQ(lane.road_lane, -2);
    EXPECT_EQ(lane.road_s, 10);
    EXPECT_EQ(lane.road_s_end, 410);
    EXPECT_NEAR(road_place(lane, 30)->s, 40, 1e-9);
}

TEST(RoadPlace, IsNothingWhereThereIsNoRoad) {
    const TownT town = test::straight_road(400, 1);
    EXPECT_FALSE(road_place(town.lanes.front(), 3));
    EXPECT_FALSE(find_road_place(town, {"12", -1, 3}));
    EXPECT_FALSE(find_road_place(town_of_two_roads(), {"12", -1, 3}));
    EXPECT_FALSE(find_road_place(town_of_two_roads(), {"12", 1, 30}));
    EXPECT_FALSE(find_road_place(town_of_two_roads(), {"1", -1, 30})) << "a part of a name";
}

TEST(RoadPlace, IsReadFromTextAndLeavesOutWhatIsNone) {
    const std::string text = "12 -1 0.00:20.00 100.00:120.00;7 2 100.00:310.00 400.00:10.00";
    EXPECT_EQ(road_pieces_text(read_road_pieces(text)), text);
    for (const char* none : {"",
                             ";",
                             "12",
                             "12 -1",
                             "12 -1 0:1",
                             "12 x 0:1 2:3",
                             "12 -1 5:1 2:3",
                             "12 -1 0:1 2:",
                             "12 -1 0:1 2:3x"})
        EXPECT_TRUE(read_road_pieces(none).empty()) << none;
}

}  // namespace reprise::world
