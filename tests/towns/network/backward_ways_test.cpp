#include "towns/network/backward_ways.h"

#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "towns/network/network_xml.h"
#include "world/frames.h"

namespace reprise::towns {
namespace {

using Line = std::vector<Eigen::Vector3d>;

Line points_of(const std::string& shape) {
    Line points;
    for (const world::Vec3& p : parse_shape(shape))
        points.push_back(world::to_eigen(p));
    return points;
}

double metres(const Line& line) {
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
        length += (line[i] - line[i - 1]).norm();
    return length;
}

/// Road a, a way i through a junction, and road b behind it; a way o leads onto a, t off it as
/// well.
class Chain {
  public:
    struct Shapes {
        std::string o, a, i, b, t;
    };

    explicit Chain(const Shapes& shapes) {
        const auto edge = [](const char* id, const std::string& shape, const char* more = "") {
            return fmt::format(
                R"(<edge id="{0}"{1}><lane id="{0}_0" index="0" length="{3:.3f}" shape="{2}"/></edge>)",
                id,
                more,
                shape,
                metres(points_of(shape)));
        };
        constexpr const char* inside = R"( function="internal")";
        const std::string said =
            "<net>" + edge(":o", shapes.o, inside) + edge(":i", shapes.i, inside) +
            edge(":t", shapes.t, inside) + edge("a", shapes.a) + edge("b", shapes.b) +
            edge("c", "0,0 -10,0") +
            R"(<connection from=":o" to="a" fromLane="0" toLane="0"/>)"
            R"(<connection from="a" to="b" fromLane="0" toLane="0" via=":i_0"/>)"
            R"(<connection from=":i" to="b" fromLane="0" toLane="0"/>)"
            R"(<connection from="a" to="c" fromLane="0" toLane="0" via=":t_0"/></net>)";
        document_.load_string(said.c_str());
        before = text();
        mended = mend_backward_ways(document_.child("net"));
    }

    Line line(const char* id) const { return points_of(lane(id).attribute("shape").value()); }

    double length(const char* id) const { return lane(id).attribute("length").as_double(); }

    std::string text() const {
        std::ostringstream out;
        document_.save(out);
        return out.str();
    }

    std::string before;
    std::size_t mended = 0;

  private:
    pugi::xml_node lane(const char* id) const {
        return document_.child("net").find_child_by_attribute("edge", "id", id).child("lane");
    }

    pugi::xml_document document_;
};

/// Each begins where the one before ends, all lead east, and SUMO counts as drawn.
void expect_driven_through(const Chain& chain) {
    EXPECT_EQ(chain.mended, 1U);
    Eigen::Vector3d end = chain.line(":o").front();
    for (const char* id : {":o", "a", ":i", "b"}) {
        const auto line = chain.line(id);
        ASSERT_GE(line.size(), 2U) << id;
        EXPECT_NEAR((line.front() - end).norm(), 0, 1e-3) << id;
        for (std::size_t i = 1; i < line.size(); ++i)
            EXPECT_GT((line[i] - line[i - 1]).x(), 0) << id;
        EXPECT_NEAR(chain.length(id), metres(line), 2e-3) << id;
        end = line.back();
    }
    EXPECT_NEAR((chain.line(":t").front() - chain.line("a").back()).norm(), 0, 1e-3);
}

TEST(BackwardWays, TheLongerRoadIsCutOffWhereTheOtherOneBegins) {
    const Chain first({"0,0,1 10,0,1",
                       "10,0,1 60,0,1",
                       "60,0,1 55,0,1",
                       "55,0,1 70,0,1",
                       "60,0,1 62,3,1 60,6,1"});
    expect_driven_through(first);
    EXPECT_NEAR(first.line("b").front().x(), 55, 1e-9);
    EXPECT_EQ(first.line("a").back().z(), 1);
}

TEST(BackwardWays, TheSecondRoadIsCutOffWhereItIsTheLongerOne) {
    const Chain chain({"0,0 10,0", "10,0 20,0", "20,0 16,0", "16,0 17,0 90,0", "20,0 22,3 20,6"});
    EXPECT_EQ(chain.mended, 1U);
    EXPECT_NEAR(chain.line("a").back().x(), 20, 1e-9);
    EXPECT_NEAR(chain.line("b").front().x(), 20.2, 1e-9);
    EXPECT_EQ(chain.line("b").size(), 2U);
    EXPECT_NEAR(chain.length("b"), 69.8, 1e-9);
    EXPECT_NEAR(chain.line(":i").back().x(), 20.2, 1e-9);
}

TEST(BackwardWays, ARoadThatLiesBehindTheNextOneIsMovedBeforeIt) {
    // As netconvert 1.15 made of Helsinki's Annankatu, turned east.
    expect_driven_through(Chain(
        {"0,0 40,0 60,0", "60,0 60.2,0", "60.2,0 54.4,0", "54.4,0 56.7,0", "60.2,0 63,2 60,5"}));
}

TEST(BackwardWays, WhatIsSoundOrCannotBeMendedKeepsEveryByte) {
    const Chain sound({"0,0 10,0", "10,0 60,0", "60,0 65,0", "65,0 90,0", "60,0 62,3 60,6"});
    EXPECT_EQ(sound.mended, 0U);
    EXPECT_EQ(sound.text(), sound.before);
    // Turning round, as at a dead end, is no mistake.
    const Chain turn({"0,0 10,0", "10,0 60,0", "60,0 62,2 60,4", "60,4 10,4", "60,0 62,3 60,6"});
    EXPECT_EQ(turn.text(), turn.before);
    const Chain too_short({"50,0 60,0", "60,0 60.2,0", "60.2,0 49,0", "49,0 51,0", "60,0 62,3"});
    EXPECT_EQ(too_short.mended, 0U);
    EXPECT_EQ(too_short.text(), too_short.before);
}

}  // namespace
}  // namespace reprise::towns
