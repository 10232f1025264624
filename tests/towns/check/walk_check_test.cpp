#include "towns/check/walk_check.h"

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "tests/support/towns.h"

namespace reprise::towns {
namespace {

using ground::GroundMesh;
using walkers::WalkMap;

TEST(WalkCheck, FindsTheSidewalksOfTown1Connected) {
    const world::TownT& town = test::own_town("town1").town;
    const WalkMap map(ground::build_ground(town));
    EXPECT_EQ(check_walking(town, map).figure, 100);
}

TEST(WalkCheck, LeavesOutSidewalksThatTheNetworkDoesNotJoin) {
    world::TownT town = test::own_town("town2").town;
    const WalkMap map(ground::build_ground(town));
    // A strip far away, without links: a sixth of all sidewalks.
    world::LaneT strip;
    strip.name = "strip";
    strip.kind = world::LaneKind::sidewalk;
    strip.length = 500;
    strip.centre = {{5000, 0, 0}, {5500, 0, 0}};
    town.lanes.push_back(strip);
    const towns::Criterion joined = check_walking(town, map);
    EXPECT_EQ(joined.figure, 100);
    EXPECT_NE(joined.looked_at.find("that the network joins"), std::string::npos);
    // Where no two are joined, it counts as well.
    for (world::LaneT& lane : town.lanes)
        lane.links.clear();
    EXPECT_FALSE(check_walking(town, map).passed());
}

TEST(WalkCheck, CountsPairsWithoutAWay) {
    // Only the ground of a half of the town.
    const world::TownT& town = test::own_town("town2").town;
    GroundMesh ground = ground::build_ground(town);
    GroundMesh half{ground.vertices, {}, {}};
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        if (ground.vertices[ground.triangles[i][0]].x() < 100) {
            half.triangles.push_back(ground.triangles[i]);
            half.surfaces.push_back(ground.surfaces[i]);
        }
    const towns::Criterion connected = check_walking(town, WalkMap(half));
    EXPECT_FALSE(connected.passed());
    EXPECT_LT(connected.figure, 60);
    EXPECT_EQ(connected.worst.size(), 5U);
}

}  // namespace
}  // namespace reprise::towns
