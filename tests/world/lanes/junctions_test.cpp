#include "world/lanes/junctions.h"

#include <gtest/gtest.h>

#include "tests/support/worlds.h"

namespace reprise::world {
namespace {

LaneT road(const char* name, double from, double to) {
    LaneT lane;
    lane.name = lane.edge = name;
    lane.kind = LaneKind::driving;
    lane.centre = {Vec3(from, 0, 0), Vec3(to, 0, 0)};
    lane.length = to - from;
    return lane;
}

/// Two roads east, one leads on to the other; the second is 10 m long. A stop sign at x.
TownT road_before_a_short_one(double sign_x) {
    TownT town;
    town.lanes = {road("first", 0, 100), road("short", 104, 114)};
    town.lanes[0].links = {Link(1, none, none, Turn::straight, false, 0)};
    Prop sign;
    sign.mutate_kind(PropKind::stop_sign);
    sign.mutable_position() = Vec3(sign_x, -3, 0);
    town.props = {sign};
    return town;
}

}  // namespace

TEST(LanesWithStopSign, ASignAtTheEndOfAShortRoadIsNoneOfTheRoadBeforeIt) {
    EXPECT_EQ(lanes_with_stop_sign(road_before_a_short_one(113)), (std::vector<bool>{false, true}));
    EXPECT_EQ(lanes_with_stop_sign(road_before_a_short_one(101)), (std::vector<bool>{true, false}));
    EXPECT_EQ(lanes_with_stop_sign(road_before_a_short_one(50)), (std::vector<bool>{false, false}));
}

}  // namespace reprise::world
