#include "ground/mesh/polygons.h"

#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "world/geometry2d.h"

namespace reprise {

namespace {

using ground::Area;
using world::Loop;

const Eigen::Vector2d origin(0, 0);

Loop square(double x, double y, double side) {
    return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

double covered_area(const Area& area) {
    double sum = 0;
    for (const Loop& piece : area.pieces())
        sum += world::signed_area(piece);
    return sum;
}

double bordered(const Area& area) {
    double sum = 0;
    for (const Loop& border : area.borders())
        sum += world::signed_area(border);
    return sum;
}

void expect_size(const Area& area, double size) {
    EXPECT_NEAR(area.size(), size, 1e-6);
    EXPECT_NEAR(covered_area(area), size, 1e-6);
    EXPECT_NEAR(bordered(area), size, 1e-6);
}

}  // namespace

TEST(Area, JoinsWhatOverlaps) {
    Area area(origin);
    area.add(square(0, 0, 2));
    area.add(square(1, 1, 2));
    expect_size(area, 7);
    EXPECT_EQ(area.borders().size(), 1u);
}

TEST(Area, CutsHoles) {
    Area area(origin);
    area.add(square(0, 0, 4));
    Area hole(origin);
    hole.add(square(1, 1, 2));
    area.subtract(hole);
    expect_size(area, 12);
}

TEST(Area, MergesAndComesApartAgain) {
    Area area(origin);
    area.add(square(0, 0, 4));
    Area hole(origin);
    hole.add(square(1, 1, 2));
    area.subtract(hole);
    Area other(origin);
    other.add(square(4, 0, 1));
    other.add(square(9, 9, 1));
    area.merge(other);
    expect_size(area, 14);
    const std::vector<Area> parts = area.parts();
    ASSERT_EQ(parts.size(), 2u);
    const std::size_t small = parts[0].size() < parts[1].size() ? 0 : 1;
    expect_size(parts[small], 1);
    expect_size(parts[1 - small], 13);
}

TEST(Area, TakesEitherTurningSense) {
    Area area(origin);
    Loop clockwise = square(0, 0, 3);
    std::reverse(clockwise.begin(), clockwise.end());
    area.add(clockwise);
    area.add(square(1, 1, 1));
    expect_size(area, 9);
}

TEST(Area, FillsBothLobesOfAShapeThatCrossesItself) {
    // A bow tie with lobes of 4 (left) and 1 (right), either way round.
    Loop bow{{-4, -1}, {-4, 1}, {2, -0.5}, {2, 0.5}};
    for (int turn = 0; turn < 2; ++turn) {
        Area area(origin);
        area.add(bow);
        expect_size(area, 4 * 2 / 2.0 + 2 * 1 / 2.0);
        std::reverse(bow.begin(), bow.end());
    }
}

TEST(Area, LosesNothingToAShapeThatCrossesItself) {
    Area area(origin);
    area.add(square(-5, -5, 10));
    area.add({{-4, -1}, {-4, 1}, {2, -0.5}, {2, 0.5}});
    expect_size(area, 100);
}

TEST(Area, TakesShapesWithoutArea) {
    Area area(origin);
    area.add({});
    area.add({{1, 1}});
    area.add({{1, 1}, {1, 1}, {1, 1}});
    area.add({{0, 0}, {5, 5}, {9, 9}});
    expect_size(area, 0);
    area.add({{0, 0}, {0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}});
    expect_size(area, 4);
}

TEST(Area, GivesPiecesThatAreConvexAndDisjoint) {
    Area area(origin);
    area.add({{0, 0}, {6, 1}, {3, 2}, {7, 6}, {-1, 5}, {2, 3}});
    double sum = 0;
    for (const Loop& piece : area.pieces()) {
        ASSERT_GE(piece.size(), 3u);
        for (std::size_t i = 0; i < piece.size(); ++i)
            EXPECT_GE(world::cross(piece[(i + 1) % piece.size()] - piece[i],
                                   piece[(i + 2) % piece.size()] - piece[i]),
                      -1e-2);
        sum += world::signed_area(piece);
    }
    // Corners of the pieces lie on whole millimetres: a border of 30 m may move by one.
    EXPECT_NEAR(sum, area.size(), 0.03);
}

TEST(Area, TakesPlainShapesAsItTakesThoseWithASpike) {
    // Quads on a ring, each turned by some more; with a spike of no area they go the long way.
    for (int turn = 0; turn < 2; ++turn) {
        Area plain(origin);
        Area spiked(origin);
        for (int i = 0; i < 12; ++i) {
            const Eigen::Rotation2Dd turned(0.53 * i);
            Loop quad;
            for (const Eigen::Vector2d& p :
                 {Eigen::Vector2d(3, -1), {7, -1.5}, {7.5, 1.25}, {3.25, 1}})
                quad.push_back(turned * p);
            Loop with_spike = quad;
            with_spike.push_back(turned * Eigen::Vector2d(3, 5));
            with_spike.push_back(quad[3]);
            if (turn == 1)
                std::reverse(quad.begin(), quad.end());
            plain.add(quad);
            spiked.add(with_spike);
        }
        EXPECT_GT(plain.size(), 70);
        EXPECT_EQ(plain.pieces(), spiked.pieces());
    }
}

TEST(Area, IsExactFarFromItsOrigin) {
    const Eigen::Vector2d far(600'000, 5'300'000);
    Area area(far);
    Loop moved = square(0, 0, 3);
    for (Eigen::Vector2d& p : moved)
        p += far;
    area.add(moved);
    EXPECT_DOUBLE_EQ(area.size(), 9);
    EXPECT_TRUE(world::box_around(area.borders().at(0)).low.isApprox(far));
}

}  // namespace reprise
