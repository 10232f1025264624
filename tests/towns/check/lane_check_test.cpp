#include "towns/check/lane_check.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/support/places.h"
#include "tests/support/worlds.h"
#include "towns/check/ends_check.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

using world::LaneKind;
using world::TownT;

Criterion find(const TownT& town, const std::string& name) {
    for (const Criterion& criterion : check_lanes(town))
        if (criterion.name == name)
            return criterion;
    ADD_FAILURE() << "no criterion " << name;
    return {};
}

TEST(LaneCheck, PassesSoundTowns) {
    for (const TownT& town : {test::t_junction(),
                              test::t_junction(0.03),
                              test::bridge(),
                              test::bend(),
                              test::straight_road(100, 2)}) {
        for (const Criterion& criterion : check_lanes(town))
            EXPECT_TRUE(criterion.passed())
                << town.name << ": " << criterion.name << ' ' << criterion.figure;
        const Criterion ends = check_ends(town, ground::build_ground(town));
        EXPECT_TRUE(ends.passed()) << town.name << ": " << ends.figure;
    }
}

/// A road of 100 m, and one across its middle, `above` it.
TownT cross_roads(double above, double angle = 0.5) {
    TownT town;
    town.name = "cross";
    const double x = 50 * std::cos(angle), y = 50 * std::sin(angle);
    town.lanes = {test::lane("over_0", LaneKind::driving, {{-x, -y, above}, {x, y, above}}),
                  test::lane("under_0", LaneKind::driving, {{-50, 0, 0}, {50, 0, 0}})};
    town.lanes[0].edge = "over";
    town.lanes[1].edge = "under";
    return town;
}

TEST(LaneCheck, FindsRoadsThatLieOnEachOther) {
    // Each is under the other where it is within 1.75 - 0.5 m of its middle: 1.25 / sin(angle).
    const Criterion covered = find(cross_roads(0), "lanes under other roads");
    EXPECT_FALSE(covered.passed());
    EXPECT_NEAR(covered.figure, 2 * 1.25 / std::sin(0.5), 2.1) << "in per cent, of 100 m each";
    ASSERT_EQ(covered.worst.size(), 2U);
    EXPECT_NEAR(covered.worst[0].position.norm(), 1.25 / std::sin(0.5), 2.1);
    EXPECT_TRUE(find(cross_roads(6), "lanes under other roads").passed()) << "a bridge";
}

TEST(LaneCheck, RoadsMayPartAtASharpAngleBehindTheirJunction) {
    TownT town = cross_roads(0, 0.05);
    for (world::LaneT& lane : town.lanes)
        lane.centre.front() = {0, 0, 0};
    EXPECT_FALSE(find(town, "lanes under other roads").passed());
    town.junctions.resize(1);
    town.lanes.push_back(test::lane("to_0", LaneKind::driving, {{-90, 0, 0}, {0, 0, 0}}));
    town.lanes[2].junction = 0;
    for (std::uint32_t i = 0; i < 2; ++i)
        town.lanes[2].links.emplace_back(
            i, world::none, world::none, world::Turn::straight, false, std::uint16_t{0});
    EXPECT_TRUE(find(town, "lanes under other roads").passed());
}

TEST(LaneCheck, BothDirectionsMayShareALane) {
    TownT town = cross_roads(0);
    town.lanes[0].centre = {{50, 0, 0}, {-50, 0, 0}};
    EXPECT_TRUE(find(town, "lanes under other roads").passed());
    town.lanes[0].centre = {{50, 0.8, 0}, {-50, 0.8, 0}};
    EXPECT_FALSE(find(town, "lanes under other roads").passed()) << "but not half of it";
}

TEST(LaneCheck, FindsLanesThatSumoCountsOtherwise) {
    TownT town = cross_roads(6);
    EXPECT_TRUE(find(town, "drawn over SUMO's length").passed());
    for (const double counted : {60.0, 160.0}) {
        town.lanes[0].sumo_length = counted;
        const Criterion ratio = find(town, "drawn over SUMO's length");
        EXPECT_FALSE(ratio.passed());
        EXPECT_NEAR(ratio.figure, counted < 100 ? 100 / counted : counted / 100, 1e-9);
        ASSERT_EQ(ratio.worst.size(), 1U);
        EXPECT_EQ(ratio.worst[0].name, "over_0");
    }
}

TEST(LaneCheck, FindsLinesThatTurnBack) {
    TownT town = cross_roads(6);
    town.lanes[1].centre = {{-50, 0, 0}, {10, 0, 0}, {9, 0, 0}, {50, 0, 0}};
    const Criterion kinks = find(town, "kinks in lanes");
    EXPECT_FALSE(kinks.passed());
    EXPECT_NEAR(kinks.figure, 180, 1e-6);
    town.lanes[1].centre = {{-50, 0, 0}, {10, 0, 0}, {10, 1, 0}, {50, 1, 0}};
    EXPECT_TRUE(find(town, "kinks in lanes").passed()) << "two corners";
}

TEST(EndsCheck, FindsAStreetThatEndsInTheAir) {
    const TownT town = test::straight_road(100);
    ground::GroundMesh ground = ground::build_ground(town);
    EXPECT_TRUE(check_ends(town, ground).passed());
    // The ground beyond the eastern end goes down by 5 m.
    for (Eigen::Vector3d& vertex : ground.vertices)
        if (vertex.x() > 100.2)
            vertex.z() -= 500;
    const Criterion ends = check_ends(town, ground);
    EXPECT_FALSE(ends.passed());
    EXPECT_GT(ends.figure, 1);
    ASSERT_FALSE(ends.worst.empty());
    EXPECT_NEAR(ends.worst[0].position.x(), 100, 0.1);
}

TEST(EndsCheck, AStreetWhereOneCanOnlyTurnRoundEndsToo) {
    TownT town = test::straight_road(100);
    const auto is_driving = [](const auto& lane) { return lane.kind == world::LaneKind::driving; };
    ASSERT_EQ(std::count_if(town.lanes.begin(), town.lanes.end(), is_driving), 2);
    const auto one = std::find_if(town.lanes.begin(), town.lanes.end(), is_driving);
    const auto other = std::find_if(one + 1, town.lanes.end(), is_driving);
    const auto back = static_cast<std::uint32_t>(other - town.lanes.begin());
    const auto ends = [&] { return check_ends(town, ground::build_ground(town)).looked_at; };
    EXPECT_EQ(ends(), "4 ends of streets");
    one->links = {{back, world::none, world::none, world::Turn::around, false, 0}};
    EXPECT_EQ(ends(), "4 ends of streets");
    one->links = {{back, world::none, world::none, world::Turn::straight, false, 0}};
    EXPECT_EQ(ends(), "2 ends of streets");
}

}  // namespace
}  // namespace reprise::towns
