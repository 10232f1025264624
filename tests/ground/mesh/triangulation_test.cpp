#include "ground/mesh/triangulation.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "ground/mesh/polygons.h"
#include "world/geometry2d.h"

namespace reprise {
namespace {

using world::Loop;

double area_of(const std::vector<std::array<Eigen::Vector2d, 3>>& triangles) {
    double area = 0;
    for (const auto& [p, q, r] : triangles) {
        const double own = world::cross(q - p, r - p) / 2;
        EXPECT_GT(own, 0) << "counter-clockwise";
        area += own;
    }
    return area;
}

const Loop unit_square{{0, 0}, {10, 0}, {10, 10}, {0, 10}};
const Loop hole{{3, 3}, {3, 6}, {6, 6}, {6, 3}};

TEST(Triangulation, CoversWhatTheBordersEnclose) {
    EXPECT_DOUBLE_EQ(area_of(ground::triangulate({unit_square})), 100);
    EXPECT_DOUBLE_EQ(area_of(ground::triangulate({unit_square, hole})), 91);
    const Loop island{{4, 4}, {5, 4}, {5, 5}, {4, 5}};
    EXPECT_DOUBLE_EQ(area_of(ground::triangulate({unit_square, hole, island})), 92);
}

TEST(Triangulation, AddsNoCorners) {
    const Loop star{{0, 0}, {10, 3}, {20, 0}, {17, 10}, {20, 20}, {10, 17}, {0, 20}, {3, 10}};
    const auto triangles = ground::triangulate({star});
    EXPECT_EQ(triangles.size(), star.size() - 2);
    for (const auto& triangle : triangles)
        for (const Eigen::Vector2d& corner : triangle)
            EXPECT_NE(std::find(star.begin(), star.end(), corner), star.end());
}

TEST(Triangulation, TakesRepeatedPointsAndBordersThatTouch) {
    const Loop repeated{{0, 0}, {10, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
    EXPECT_DOUBLE_EQ(area_of(ground::triangulate({repeated})), 100);
    const Loop touching{{0, 5}, {4, 3}, {4, 7}};
    EXPECT_DOUBLE_EQ(area_of(ground::triangulate({unit_square, touching})), 92);
}

TEST(Triangulation, OfNothingIsNothing) {
    EXPECT_TRUE(ground::triangulate({}).empty());
    EXPECT_TRUE(ground::triangulate({{{0, 0}, {1, 1}}}).empty());
    EXPECT_TRUE(ground::triangulate({{{0, 0}, {1, 1}, {2, 2}}}).empty());
}

TEST(Polygons, LeaveNoCracksBetweenTheirPieces) {
    // Slanted bars: every inner edge belongs to two pieces that meet in the same two corners.
    ground::Area area;
    for (int i = 0; i < 12; ++i)
        area.add({{i * 1.3, 0}, {i * 1.3 + 0.7, 0.1}, {20 - i * 1.1, 17.3}, {19.2 - i * 1.1, 17}});
    std::multiset<std::array<double, 4>> edges;
    for (const Loop& piece : area.pieces())
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const Eigen::Vector2d& from = piece[i];
            const Eigen::Vector2d& to = piece[(i + 1) % piece.size()];
            edges.insert({from.x(), from.y(), to.x(), to.y()});
        }
    std::size_t open = 0;
    for (const auto& edge : edges)
        open += edges.count({edge[2], edge[3], edge[0], edge[1]}) == 0 ? 1 : 0;
    std::size_t border = 0;
    for (const Loop& loop : area.borders())
        border += loop.size();
    EXPECT_EQ(open, border);
}

}  // namespace
}  // namespace reprise
