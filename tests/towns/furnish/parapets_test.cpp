#include "towns/furnish/parapets.h"

#include <cmath>

#include <gtest/gtest.h>

#include "towns/check/furniture_check.h"

namespace reprise::towns {
namespace {

using world::LaneT;
using world::Vec3;

LaneT road(const char* name, const Vec3& from, const Vec3& to) {
    LaneT lane;
    lane.name = lane.edge = name;
    lane.kind = world::LaneKind::driving;
    lane.centre = {from, to};
    lane.width = 3.5;
    lane.length = std::hypot(to.x() - from.x(), to.y() - from.y());
    lane.sumo_length = lane.length;
    lane.speed_limit = 13.89;
    lane.left = lane.right = lane.opposite = lane.junction = world::none;
    return lane;
}

/// A road along x at z = 0, and one along y at this height over it.
world::TownT crossing_at(double z) {
    world::TownT town;
    town.name = "crossing";
    town.lanes = {road("high", Vec3(0, -100, z), Vec3(0, 100, z)),
                  road("low", Vec3(-100, 0, 0), Vec3(100, 0, 0))};
    return town;
}

std::vector<world::Prop> walls_of(world::TownT& town) {
    const Place place;
    PlacementContext context(town, place, {});
    place_parapets(context);
    return town.props;
}

TEST(Parapets, StandOnBothSidesWhereARoadPassesBelow) {
    world::TownT town = crossing_at(6);
    double left = 0;
    double right = 0;
    for (const world::Prop& wall : walls_of(town)) {
        EXPECT_EQ(wall.kind(), world::PropKind::wall);
        EXPECT_EQ(wall.position().z(), 6);
        EXPECT_NEAR(std::abs(wall.position().x()), 1.75 + 0.1, 1e-6) << "outside the lane";
        EXPECT_LT(std::abs(wall.position().y()), 12) << "near the road below only";
        (wall.position().x() < 0 ? left : right) += wall.length();
    }
    // The road below, its verges, and some metres before and behind.
    EXPECT_GT(left, 3.5 + 2 * 6);
    EXPECT_NEAR(left, right, 1e-6);
    for (const towns::Criterion& criterion : towns::check_furniture(town)) {
        if (criterion.name == "things in the way") {
            EXPECT_TRUE(criterion.passed()) << criterion.figure;
        }
    }
}

TEST(Parapets, StandNowhereElse) {
    world::TownT level = crossing_at(0);
    EXPECT_TRUE(walls_of(level).empty());
    world::TownT low = crossing_at(2);
    EXPECT_TRUE(walls_of(low).empty());
}

TEST(Parapets, LeaveRoomForARoadBeside) {
    world::TownT town = crossing_at(6);
    town.lanes.push_back(road("high_2", Vec3(3.5, -100, 6), Vec3(3.5, 100, 6)));
    for (const world::Prop& wall : walls_of(town))
        EXPECT_TRUE(wall.position().x() < -1.75 || wall.position().x() > 5.25)
            << wall.position().x();
}

}  // namespace
}  // namespace reprise::towns
