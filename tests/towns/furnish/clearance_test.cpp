#include "towns/furnish/clearance.h"

#include <numbers>

#include <gtest/gtest.h>

namespace reprise::towns {
namespace {

using world::Vec3;

TEST(Clearance, MeasuresFromBorderToBorder) {
    Clearance clearance(10);
    clearance.add_line({Vec3(-50, 0, 0), Vec3(50, 0, 0)}, 1.75);
    EXPECT_NEAR(clearance.of({{0, 12}, 0, 10, 6}), 12 - 3 - 1.75, 1e-9);
    EXPECT_NEAR(clearance.of({{0, 12}, std::numbers::pi / 2, 10, 6}), 12 - 5 - 1.75, 1e-9);
    EXPECT_NEAR(clearance.of({{55, 0}, 0, 0, 0}), 5 - 1.75, 1e-9);
    EXPECT_LE(clearance.of({{0, 2}, 0.3, 10, 6}), 0);
    EXPECT_EQ(clearance.of({{0, 500}, 0, 10, 6}), 10) << "far is far";
}

TEST(Clearance, TheInsideOfAPolygonIsTaken) {
    Clearance clearance(8);
    clearance.add_polygon({Vec3(0, 0, 0), Vec3(40, 0, 0), Vec3(40, 40, 0), Vec3(0, 40, 0)});
    EXPECT_LT(clearance.of({{20, 20}, 0, 2, 2}), 1.5);
    EXPECT_NEAR(clearance.of({{-5, 20}, 0, 2, 2}), 4, 1e-9);
}

TEST(Clearance, FootprintsKeepEachOtherAway) {
    Clearance clearance(8);
    clearance.add_footprint({{0, 0}, 0, 20, 10});
    EXPECT_NEAR(clearance.of({{0, 10}, 0, 20, 6}), 10 - 5 - 3, 1e-9);
    EXPECT_LE(clearance.of({{9, 4}, 0, 4, 4}), 0);
}

TEST(Clearance, FindsWhatCrossesWithoutACornerInside) {
    Clearance clearance(8);
    clearance.add_line({Vec3(-30, 0.5, 0), Vec3(30, 1, 0)}, 0.1);
    EXPECT_LE(clearance.of({{0, 0}, 0.2, 20, 8}), 0);
}

}  // namespace
}  // namespace reprise::towns
