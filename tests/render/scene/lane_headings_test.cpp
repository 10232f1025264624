#include "render/scene/lane_headings.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "render/scene/land.h"
#include "tests/support/worlds.h"

namespace reprise {
namespace {

/// A bend to the left around the world's zero, of pieces of 5 degrees.
world::TownT bend(double radius) {
    world::TownT town = test::straight_road(10);
    world::LaneT& lane = town.lanes.front();
    lane.centre.clear();
    for (int i = 0; i <= 36; ++i) {
        const double angle = i * std::numbers::pi / 36;
        lane.centre.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    return town;
}

TEST(LaneHeadings, FollowABendThroughTheTurnOfTheCompass) {
    const double radius = 20;
    const render::LaneHeadings headings(bend(radius));
    for (double angle = 0.05; angle < 3.09; angle += 0.01) {
        const auto heading = headings.at(0, radius * angle);
        ASSERT_TRUE(heading);
        EXPECT_NEAR(*heading, angle + std::numbers::pi / 2, 0.005);
    }
}

TEST(LaneHeadings, HaveNoneOffTheLanes) {
    const render::LaneHeadings headings(bend(20));
    EXPECT_FALSE(headings.at(world::none, 3));
}

TEST(Land, IsLevelUpToTheTownsBorderAndHasHillsBeyond) {
    const world::TownT town = test::straight_road(400);
    const render::Mesh land = render::land_mesh(town, Eigen::Vector3d::Zero());
    float highest = -1e9F;
    for (const Eigen::Vector3f& p : land.vertices) {
        highest = std::max(highest, p.z());
        const bool inside = p.x() > static_cast<float>(town.low.x()) - 59 &&
                            p.x() < static_cast<float>(town.high.x()) + 59 &&
                            p.y() > static_cast<float>(town.low.y()) - 59 &&
                            p.y() < static_cast<float>(town.high.y()) + 59;
        if (inside) {
            EXPECT_LT(p.z(), static_cast<float>(town.low.z()));
        }
    }
    EXPECT_GT(highest, 20);
    for (const auto& corners : land.triangles) {
        const Eigen::Vector3f& a = land.vertices[corners[0]];
        EXPECT_GT((land.vertices[corners[1]] - a).cross(land.vertices[corners[2]] - a).z(), 0);
    }
}

}  // namespace
}  // namespace reprise
