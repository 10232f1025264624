#include "ground/mesh/roofs.h"

#include <algorithm>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace reprise::ground {
namespace {

using Eigen::Vector3d;

double covered(const world::Loop& outline, double overhang) {
    double area = 0;
    for (const auto& face : hipped_faces(outline, overhang))
        area += world::signed_area(world::in_plan(face));
    return area;
}

const world::Loop rectangle{{0, 0}, {12, 0}, {12, 8}, {0, 8}};
const world::Loop pentagon{{0, 0}, {10, 0}, {13, 6}, {6, 11}, {-1, 7}};

TEST(HippedRoof, CoversTheOutlineAndItsEaves) {
    EXPECT_NEAR(covered(rectangle, 0), 12 * 8, 1e-9);
    EXPECT_NEAR(covered(rectangle, 0.5), 13 * 9, 1e-9);
    EXPECT_NEAR(covered(pentagon, 0), world::signed_area(pentagon), 1e-9);
    EXPECT_GT(covered(pentagon, 0.5), world::signed_area(pentagon) + 0.5 * 30);
}

TEST(HippedRoof, OfARectangleHasItsRidgeInTheMiddle) {
    const auto faces = hipped_faces(rectangle, 0);
    ASSERT_EQ(faces.size(), 4U);
    EXPECT_NEAR(hipped_rise(rectangle), 0.6 * 4, 1e-9);
    for (const auto& face : faces)
        for (const Vector3d& p : face)
            if (p.z() > 1e-9) {
                EXPECT_NEAR(p.y(), 4, 1e-9);
                EXPECT_TRUE(std::abs(p.x() - 4) < 1e-9 || std::abs(p.x() - 8) < 1e-9) << p.x();
            }
}

TEST(HippedRoof, RisesFromAllSidesAndIsFlat) {
    for (const auto& face : hipped_faces(pentagon, 0.4)) {
        const Vector3d normal = (face[1] - face[0]).cross(face[2] - face[0]).normalized();
        EXPECT_GT(normal.z(), 0.8);
        for (const Vector3d& p : face)
            EXPECT_NEAR(normal.dot(p - face[0]), 0, 1e-9);
    }
}

TEST(HippedRoof, StaysLowOverHalls) {
    EXPECT_NEAR(hipped_rise({{0, 0}, {60, 0}, {60, 40}, {0, 40}}), 5, 1e-9);
}

TEST(HippedRoof, OddOutlinesHaveNone) {
    EXPECT_TRUE(hipped_faces({{0, 0}, {12, 0}, {12, 8}, {6, 2}, {0, 8}}, 0.4).empty()) << "concave";
    EXPECT_TRUE(hipped_faces({{0, 0}, {20, 0}, {0, 4}}, 0.4).empty()) << "pointed";
    EXPECT_TRUE(hipped_faces({{0, 0}, {20, 0}}, 0.4).empty());
    world::Loop clockwise = rectangle;
    std::reverse(clockwise.begin(), clockwise.end());
    EXPECT_TRUE(hipped_faces(clockwise, 0.4).empty());
}

}  // namespace
}  // namespace reprise::ground
