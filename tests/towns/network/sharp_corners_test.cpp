#include "towns/network/sharp_corners.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "towns/network/drawn_ways.h"

namespace reprise::towns {
namespace {

/// Road a leads east to the origin, and by the way i, of one lane or of i and j, onto b; the way o
/// comes onto b from elsewhere, the way t leads off a.
class Corner {
  public:
    struct Shapes {
        std::string a, i, j, b, o = "0,20 0,10", t = "0,0 9,0";
        std::string turn = "r";
    };

    explicit Corner(const Shapes& shapes) {
        const auto edge = [](const char* id, const std::string& shape) {
            return fmt::format(
                R"(<edge id="{0}"><lane id="{0}_0" length="1" shape="{1}"/></edge>)", id, shape);
        };
        const bool waits = !shapes.j.empty();
        const std::string said =
            "<net>" + edge(":i", shapes.i) + (waits ? edge(":j", shapes.j) : "") +
            edge(":o", shapes.o) + edge(":t", shapes.t) + edge("a", shapes.a) +
            edge("b", shapes.b) + edge("c", "9,0 50,0") + edge("d", "0,50 0,20") +
            R"(<connection from="a" to="b" fromLane="0" toLane="0" via=":i_0" dir=")" +
            shapes.turn + R"("/>)" +
            (waits ? R"(<connection from=":i" to="b" fromLane="0" toLane="0" via=":j_0"/>)"
                     R"(<connection from=":j" to="b" fromLane="0" toLane="0"/>)"
                   : R"(<connection from=":i" to="b" fromLane="0" toLane="0"/>)") +
            R"(<connection from="d" to="b" fromLane="0" toLane="0" via=":o_0" dir="s"/>)"
            R"(<connection from=":o" to="b" fromLane="0" toLane="0"/>)"
            R"(<connection from="a" to="c" fromLane="0" toLane="0" via=":t_0" dir="s"/></net>)";
        document_.load_string(said.c_str());
        mended = mend_sharp_corners(document_.child("net"));
        ways_.emplace(document_.child("net"));
    }

    DrawnLine line(const std::string& id) { return ways_->at(id + "_0").line; }

    /// Each begins where the one before ends, and turns by less than 75 degrees there and within.
    void expect_driven_through(const std::vector<std::string>& ids) {
        DrawnLine all;
        for (const std::string& id : ids) {
            const DrawnLine part = line(id);
            if (!all.empty()) {
                EXPECT_LT((part.front() - all.back()).norm(), 2e-3) << id;
                all.pop_back();
            }
            all.insert(all.end(), part.begin(), part.end());
        }
        for (std::size_t i = 1; i + 1 < all.size(); ++i)
            EXPECT_GT((all[i] - all[i - 1]).normalized().dot((all[i + 1] - all[i]).normalized()),
                      0.25)
                << "at " << all[i].transpose();
    }

    std::size_t mended = 0;

  private:
    pugi::xml_document document_;
    std::optional<DrawnWays> ways_;
};

TEST(SharpCorners, TheRoadThatBeginsBeforeTheCornerBeginsBehindIt) {
    Corner corner(
        {.a = "-50,0 0,0", .i = "0,0 3,1 4,3", .j = "", .b = "4,3 4,-60", .o = "4,20 4,3"});
    EXPECT_EQ(corner.mended, 1U);
    corner.expect_driven_through({"a", ":i", "b"});
    corner.expect_driven_through({":o", "b"});
    EXPECT_EQ(corner.line("a").back(), Eigen::Vector3d(0, 0, 0));
    EXPECT_LT(corner.line("b").front().y(), -2);
    EXPECT_GT(corner.line("b").front().y(), -4);
}

TEST(SharpCorners, TheRoadThatEndsBehindTheCornerEndsBeforeIt) {
    Corner corner({.a = "-50,0 0,0",
                   .i = "0,0 -1,-1 -3,-4",
                   .j = "",
                   .b = "-3,-4 -3,-60",
                   .o = "-3,20 -3,-4"});
    EXPECT_EQ(corner.mended, 1U);
    corner.expect_driven_through({"a", ":i", "b"});
    corner.expect_driven_through({"a", ":t", "c"});
    EXPECT_LT(corner.line("a").back().x(), -4);
    EXPECT_EQ(corner.line("b").front(), Eigen::Vector3d(-3, -4, 0));
}

TEST(SharpCorners, AWayOnWhichOneWaitsStaysOneOfTwoLanes) {
    Corner corner(
        {.a = "-50,0 0,0", .i = "0,0 2,0", .j = "2,0 4,1 5,3", .b = "5,3 5,-60", .o = "5,20 5,3"});
    EXPECT_EQ(corner.mended, 1U);
    corner.expect_driven_through({"a", ":i", ":j", "b"});
    corner.expect_driven_through({":o", "b"});
    EXPECT_EQ(corner.line(":i").back(), Eigen::Vector3d(2, 0, 0));
}

/// As where two roads leave a wide junction side by side.
TEST(SharpCorners, AWayThatComesBackByACornerTurnsOnAnArc) {
    Corner corner({.a = "-50,0 0,0",
                   .i = "0,0 15,0 20,-1 15,-1 -1,-4",
                   .j = "",
                   .b = "-1,-4 -60,-20",
                   .o = "5,20 -1,-4"});
    EXPECT_EQ(corner.mended, 1U);
    corner.expect_driven_through({"a", ":i", "b"});
    EXPECT_EQ(corner.line("b").front(), Eigen::Vector3d(-1, -4, 0));
    for (const Eigen::Vector3d& point : corner.line(":i"))
        EXPECT_GT(point.y(), -14) << "no further aside than it needs";
}

TEST(SharpCorners, AWayThatLeavesItsRoadBackwardsSwingsOutOverTheJunction) {
    const Corner::Shapes left{
        .a = "-50,0 0,0", .i = "0,0 -20,24", .j = "", .b = "-20,24 -60,72", .o = "2,40 -20,24"};
    const Corner::Shapes right{.a = "-50,0 0,0",
                               .i = "0,0 -20,-24",
                               .j = "",
                               .b = "-20,-24 -60,-72",
                               .o = "-18,-4 -20,-24"};
    for (const Corner::Shapes& shapes : {left, right}) {
        Corner corner(shapes);
        EXPECT_EQ(corner.mended, 1U);
        corner.expect_driven_through({"a", ":i", "b"});
        EXPECT_EQ(corner.line("a").back(), Eigen::Vector3d(0, 0, 0));
        EXPECT_EQ(corner.line("b").front(), corner.line(":i").back());
        // On a circle of 6.5 m: it passes the road's end by that much.
        double furthest = 0;
        for (const Eigen::Vector3d& p : corner.line(":i"))
            furthest = std::max(furthest, p.x());
        EXPECT_NEAR(furthest, 6.5, 0.1);
    }
}

TEST(SharpCorners, WhereTheRoadIsTooShortToCutTheWayTurnsWithTheWheelsAtTheStop) {
    Corner corner({.a = "-50,0 0,0",
                   .i = "0,0 3,1 6,2 6.2,3",
                   .j = "",
                   .b = "6.2,3 9.3,-1.3",
                   .o = "-10,10 6.2,3"});
    EXPECT_EQ(corner.mended, 1U);
    corner.expect_driven_through({"a", ":i", "b"});
    corner.expect_driven_through({":o", "b"});
    EXPECT_GE(drawn_metres(corner.line("b")), 2);
}

TEST(SharpCorners, AWayThatComesOntoItsRoadBackwardsSwingsOutBeforeIt) {
    Corner corner({.a = "-50,0 0,0",
                   .i = "0,0 30,4",
                   .j = "",
                   .b = "30,4 -60,34",
                   .o = "40,40 30,4",
                   .t = "0,0 9,0"});
    EXPECT_EQ(corner.mended, 1U);
    corner.expect_driven_through({"a", ":i", "b"});
    EXPECT_EQ(corner.line("b").front(), Eigen::Vector3d(30, 4, 0));
}

TEST(SharpCorners, WhatCanBeDrivenOrHasNoRoomOrTurnsRoundStaysAsItIs) {
    const Corner::Shapes right{.a = "-50,0 0,0", .i = "0,0 3,-1 4,-4", .j = "", .b = "4,-4 4,-60"};
    Corner::Shapes short_road{.a = "-50,0 0,0", .i = "0,0 3,1 4,3", .j = "", .b = "4,3 4,0"};
    Corner::Shapes around{
        .a = "-50,0 0,0", .i = "0,0 3,1 4,3", .j = "", .b = "4,3 4,-60", .turn = "t"};
    for (const Corner::Shapes& shapes : {right, short_road, around}) {
        Corner corner(shapes);
        EXPECT_EQ(corner.mended, 0U) << shapes.b;
        EXPECT_EQ(corner.line("b").front(), corner.line(":i").back());
    }
}

}  // namespace
}  // namespace reprise::towns
