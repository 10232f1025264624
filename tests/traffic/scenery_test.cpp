#include "traffic/scenery.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/traffic/stage.h"

namespace reprise::traffic {
namespace {

using test::own_town;
using world::LaneT;
using world::TownT;

/// Points around and inside of a building, half a metre apart.
std::vector<Eigen::Vector3d> samples(const world::Building& building) {
    std::vector<Eigen::Vector3d> points;
    const double c = std::cos(building.yaw());
    const double s = std::sin(building.yaw());
    for (double x = -building.length() / 2; x <= building.length() / 2; x += 0.5)
        for (double y = -building.width() / 2; y <= building.width() / 2; y += 0.5)
            points.emplace_back(building.centre().x() + c * x - s * y,
                                building.centre().y() + s * x + c * y,
                                building.centre().z());
    return points;
}

class OwnScenery : public ::testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Towns, OwnScenery, ::testing::Values("town1", "town2"));

// The other route: not Clearance's grid, but the distance of sampled points from every lane.
TEST_P(OwnScenery, BuildingsStandClearOfRoadsAndSidewalks) {
    const TownT& town = own_town(GetParam()).town;
    ASSERT_FALSE(town.buildings.empty());
    double nearest = 100;
    for (const world::Building& building : town.buildings)
        for (const Eigen::Vector3d& point : samples(building))
            for (const LaneT& lane : town.lanes) {
                if (!lane.outline.empty())
                    continue;
                const auto& start = lane.centre.front();
                if (std::hypot(start.x() - point.x(), start.y() - point.y()) > lane.length + 20)
                    continue;
                nearest = std::min(nearest, world::project(lane, point).distance - lane.width / 2);
            }
    EXPECT_GE(nearest, 3 - 1e-6);
    EXPECT_LT(nearest, 5) << "and yet along the roads";
}

TEST_P(OwnScenery, TrunksStandClearOfTheRoad) {
    const TownT& town = own_town(GetParam()).town;
    ASSERT_FALSE(town.trees.empty());
    for (const world::Tree& tree : town.trees)
        for (const LaneT& lane : town.lanes) {
            const Eigen::Vector3d point(
                tree.position().x(), tree.position().y(), tree.position().z());
            if (lane.outline.empty()) {
                EXPECT_GE(world::project(lane, point).distance - lane.width / 2, 1.5 - 1e-6)
                    << lane.name;
            }
        }
}

TEST(Scenery, Town1IsATown) {
    const TownT& town = own_town("town1").town;
    EXPECT_GE(town.buildings.size(), 150U);
    EXPECT_LE(town.buildings.size(), 250U);
    EXPECT_GE(town.trees.size(), 200U);
    EXPECT_LE(town.trees.size(), 450U);
    for (const world::Building& building : town.buildings) {
        EXPECT_GE(building.height(), 6);
        EXPECT_LE(building.height(), 30);
    }
}

TEST(Scenery, AnotherNameBuildsAnotherTown) {
    Network renamed = own_town("town2").network;
    renamed.name = "elsewhere";
    EXPECT_NE(read_town(renamed).buildings, own_town("town2").town.buildings);
}

}  // namespace
}  // namespace reprise::traffic
