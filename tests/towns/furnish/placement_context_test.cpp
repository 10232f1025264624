#include "towns/furnish/placement_context.h"

#include <gtest/gtest.h>

namespace reprise::towns {
namespace {

using Eigen::Vector2d;
using world::Vec3;

/// A sidewalk of 3 m along y = 0 that ends at x = 0, where a junction of 20 by 20 m begins; a
/// walking area of 4 by 3 m in its north-west corner.
struct Corner {
    Corner() {
        town.name = "corner";
        world::LaneT sidewalk;
        sidewalk.name = sidewalk.edge = "sidewalk";
        sidewalk.kind = world::LaneKind::sidewalk;
        sidewalk.centre = {Vec3(-50, 0, 0), Vec3(0, 0, 0)};
        sidewalk.width = 3;
        sidewalk.length = sidewalk.sumo_length = 50;
        sidewalk.left = sidewalk.right = sidewalk.opposite = sidewalk.junction = world::none;
        world::LaneT area = sidewalk;
        area.name = area.edge = ":area";
        area.kind = world::LaneKind::walking_area;
        area.centre = {Vec3(0, 8, 0), Vec3(4, 8, 0)};
        area.outline = {Vec3(0, 7, 0), Vec3(4, 7, 0), Vec3(4, 10, 0), Vec3(0, 10, 0)};
        world::JunctionT junction;
        junction.outline = {Vec3(0, -10, 0), Vec3(20, -10, 0), Vec3(20, 10, 0), Vec3(0, 10, 0)};
        town.lanes = {sidewalk, area};
        town.junctions = {junction};
    }

    world::TownT town;
};

TEST(PlacementContext, InAJunctionAPoleStandsOnItsWalkingAreasNotBeyondASidewalksEnd) {
    Corner corner;
    const Place place;
    const PlacementContext context(corner.town, place, {});
    EXPECT_TRUE(context.may_stand({-1, 0}, pole_margin)) << "on the sidewalk";
    EXPECT_FALSE(context.may_stand({1, 0}, pole_margin)) << "a round end would reach there";
    EXPECT_TRUE(context.may_stand({1, 8}, pole_margin)) << "on the walking area";
    EXPECT_FALSE(context.may_stand({10, 0}, pole_margin)) << "on the road";
    EXPECT_TRUE(context.may_stand({-10, 20}, pole_margin)) << "on the land";
}

}  // namespace
}  // namespace reprise::towns
