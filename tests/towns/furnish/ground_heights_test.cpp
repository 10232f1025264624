#include "towns/furnish/ground_heights.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/terrain.h"
#include "tests/support/worlds.h"
#include "towns/buildings/floors.h"
#include "towns/check/standing_check.h"
#include "towns/scenery.h"

namespace reprise::towns {
namespace {

using Eigen::Vector2d;
using world::PropKind;
using world::TownT;
using world::Vec3;

/// All of it then climbs along x.
void tilt(TownT& town, double slope) {
    for (world::LaneT& lane : town.lanes) {
        for (Vec3& p : lane.centre)
            p.mutate_z(slope * p.x());
        lane.length *= std::hypot(1, slope);
    }
}

/// A street of 400 m along x that climbs by `slope`, with all that stands beside it.
TownT street(double slope, const Place& place = {}) {
    TownT town = test::straight_road(400);
    tilt(town, slope);
    place_scenery(town, place, std::vector<GiveWay>(town.lanes.size()));
    return town;
}

double figure(const TownT& town, const std::string& name) {
    for (const towns::Criterion& criterion :
         towns::check_standing(town, ground::build_ground(town)))
        if (criterion.name == name)
            return criterion.figure;
    ADD_FAILURE() << "no criterion " << name;
    return 0;
}

std::ptrdiff_t count(const TownT& town, PropKind kind) {
    return std::count_if(town.props.begin(), town.props.end(), [&](const world::Prop& prop) {
        return prop.kind() == kind;
    });
}

TEST(GroundHeights, EverythingStandsOnASlope) {
    for (const double slope : {0.02, 0.05}) {
        const TownT town = street(slope);
        EXPECT_GT(town.trees.size(), 40U);
        EXPECT_GT(town.buildings.size(), 10U);
        EXPECT_GT(town.props.size(), 20U);
        EXPECT_LE(figure(town, "things on the ground"), 0.25) << slope;
        EXPECT_LE(figure(town, "doors on the ground"), 0.06) << slope;
    }
}

/// Where all is level the ground is not looked up: heights are the lane's and a constant.
TEST(GroundHeights, LevelTownsNeedNoGround) {
    const TownT town = street(0);
    EXPECT_TRUE(GroundHeights(town).is_level());
    EXPECT_EQ(GroundHeights(town).at(Vector2d(1e6, 0), 3), 3);
    for (const world::Tree& tree : town.trees)
        EXPECT_TRUE(tree.position().z() == -ground::terrain_depth ||
                    tree.position().z() == ground::kerb_height)
            << tree.position().z();
    for (const world::Building& building : town.buildings)
        EXPECT_EQ(building.centre().z(), 0);
}

TEST(GroundHeights, HedgesGoDownASlopeInSteps) {
    constexpr double slope = 0.06;
    const TownT town = street(slope);
    double longest = 0;
    for (const world::Prop& prop : town.props)
        if (prop.kind() == PropKind::hedge || prop.kind() == PropKind::fence ||
            prop.kind() == PropKind::wall) {
            EXPECT_LE(std::abs(prop.length() * std::cos(prop.yaw())) * slope, 0.25);
            longest = std::max(longest, prop.length() * std::abs(std::sin(prop.yaw())));
        }
    EXPECT_GT(count(town, PropKind::hedge) + count(town, PropKind::fence), 6);
    EXPECT_GT(longest, 4.5) << "across the slope they are one piece";
}

/// Its pole may stand a metre lower, but drivers look for it over the road.
TEST(GroundHeights, LampsHangAtTheirHeightOverTheRoad) {
    TownT level = test::straight_road_with_signal(400);
    level.lanes[1].links.clear();  // it leads nowhere
    const std::vector<GiveWay> right_of_way(level.lanes.size());
    TownT steep = level;
    tilt(steep, 0.3);
    const auto over_the_road = [&](TownT& town) {
        place_scenery(town, {}, right_of_way);
        const world::SignalHeadT& head = town.heads.at(0);
        return head.foot.z() + head.height - town.lanes[town.signals[0].lane].centre.back().z();
    };
    const double wanted = over_the_road(level);
    EXPECT_NEAR(over_the_road(steep), wanted, 0.05);
    EXPECT_GT(std::abs(steep.heads[0].height - level.heads[0].height), 0.05);
    EXPECT_LE(figure(steep, "things on the ground"), 0.25);
}

TEST(GroundHeights, StaysOnItsLevel) {
    TownT town = test::straight_road(100);
    const std::vector<world::LaneT> low = town.lanes;
    for (world::LaneT lane : low) {
        lane.name += "_high";
        for (Vec3& p : lane.centre)
            p = Vec3(50, p.x() - 50, 6 + p.y() / 100);
        town.lanes.push_back(std::move(lane));
    }
    const GroundHeights ground_heights(town);
    const Vector2d crossing(50, 1.75);
    EXPECT_NEAR(*ground_heights.at(crossing, 1), 0, 0.01);
    EXPECT_NEAR(*ground_heights.at(crossing, 5), 6, 0.1);
    EXPECT_LT(*ground_heights.at(Vector2d(60, 6), 6), 1) << "beside the bridge";
    const auto under = ground_heights.under({crossing, 0, 30, 0.2}, 0);
    ASSERT_TRUE(under);
    EXPECT_LT(under->rise(), 0.1);
    EXPECT_FALSE(ground_heights.at(Vector2d(9000, 0), 0)) << "beyond the terrain";
}

TEST(Floors, AreAStepOverTheGroundBeforeTheDoor) {
    TownT town = test::straight_road(400);
    tilt(town, 0.08);
    const GroundHeights ground_heights(town);
    // Its front looks south at the road; 10 m along it, that is, 0.8 m of height.
    const Footprint house{{200, 15}, 0, 10, 8};
    const auto floor = floor_on(ground_heights, house, 16);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(*floor, *ground_heights.at(Vector2d(200, 10.7), 16) + 0.05, 1e-9);
    EXPECT_NEAR(*floor, 16, 0.3) << "about as high as the road";
    EXPECT_FALSE(floor_on(ground_heights, {{200, 15}, 0, 40, 8}, 16)) << "3.2 m of height along it";
    EXPECT_FALSE(floor_on(ground_heights, {{200, 15}, 0, 16, 8}, 16))
        << "1.3 m of height along the front";
    const double uphill = std::acos(0.0);
    EXPECT_TRUE(floor_on(ground_heights, {{200, 15}, uphill, 8, 12}, 16))
        << "1 m from front to back";
    EXPECT_FALSE(floor_on(ground_heights, {{200, 15}, uphill, 8, 17}, 16))
        << "1.4 m below the back door";
    EXPECT_FALSE(floor_on(ground_heights, {{200, 15}, -uphill, 8, 17}, 16))
        << "1.4 m over the back door";
}

TEST(Floors, OfDrawnBuildingsFaceTheStreet) {
    Place place;
    world::DrawnBuildingT drawn;
    drawn.outline = {{180, 12, 0}, {220, 12, 0}, {210, 22, 0}, {190, 22, 0}};  // no rectangle
    drawn.height = 9;
    place.buildings = {drawn};
    const TownT town = street(0.08, place);
    ASSERT_EQ(town.drawn_buildings.size(), 1U) << "real ones stay, be it 3.2 m of height";
    for (const Vec3& corner : town.drawn_buildings[0].outline)
        EXPECT_NEAR(corner.z(), 200 * 0.08, 0.3) << "the middle of its southern side";
    EXPECT_LE(figure(town, "doors on the ground"), 0.06);
}

}  // namespace
}  // namespace reprise::towns
