/// Towns in which a test finds its road by name: straight, curves, junctions.
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/support/towns.h"

namespace reprise::towns {
namespace {

const world::LaneT& lane_of(const std::string& town, const std::string& name) {
    const world::TownT& found = test::own_town(town).town;
    return found.lanes[test::lane(found, name)];
}

TEST(ProvingGround, StraightHasFourKilometresOfThreeLanesEachWayFor130) {
    for (const char* edge : {"east_", "west_"})
        for (const char* index : {"0", "1", "2"}) {
            const world::LaneT& lane = lane_of("straight", edge + std::string(index));
            EXPECT_NEAR(lane.length, 4000, 25) << "less its part of the junctions at its ends";
            EXPECT_NEAR(lane.speed_limit, 130 / 3.6, 0.01);
            for (const world::Vec3& point : lane.centre) {
                EXPECT_NEAR(point.y(), lane.centre.front().y(), 1e-9);
                EXPECT_EQ(point.z(), 0);
            }
        }
    const double right = lane_of("straight", "east_0").centre.front().y();
    EXPECT_NEAR(lane_of("straight", "east_1").centre.front().y(), right + 3.75, 1e-9);
    EXPECT_NEAR(lane_of("straight", "east_2").centre.front().y(), right + 7.5, 1e-9);
}

/// [m] of the circle through three points.
double radius_through(const world::Vec3& a, const world::Vec3& b, const world::Vec3& c) {
    const double twice_area =
        std::abs((b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y()));
    const auto apart = [](const world::Vec3& p, const world::Vec3& q) {
        return std::hypot(q.x() - p.x(), q.y() - p.y());
    };
    return apart(a, b) * apart(b, c) * apart(c, a) / (2 * twice_area);
}

class Curves : public ::testing::TestWithParam<int> {};

INSTANTIATE_TEST_SUITE_P(Radii, Curves, ::testing::Values(30, 50, 80, 120, 200, 300, 500));

TEST_P(Curves, BendAsTheirNamesSayBothWays) {
    const double radius = GetParam();
    for (const char* way : {"_0", "_back_0"}) {
        const world::LaneT& lane = lane_of("curves", "r" + std::to_string(GetParam()) + way);
        // A third and two thirds of the way are on the arc: it is the most of the edge, in its
        // middle.
        const auto& line = lane.centre;
        const std::size_t n = line.size();
        ASSERT_GE(n, 9U);
        const double bend = radius_through(line[n / 3], line[n / 2], line[n - n / 3]);
        EXPECT_NEAR(bend, radius, 1.75 + 0.01 * radius)
            << "the middle of a lane is 1.75 m beside the road's";
        EXPECT_LT(lane.speed_limit * lane.speed_limit / bend, 2.8)
            << "[m/s^2] to the side at the limit";
    }
}

TEST(ProvingGround, JunctionsAreOfEveryRuleWithThreeAndFourArms) {
    pugi::xml_document file;
    file.load_string(test::own_town("junctions").network.xml.c_str());
    std::map<std::string, std::set<std::string>> arms;
    for (const pugi::xml_node edge : file.child("net").children("edge"))
        if (!edge.attribute("function"))
            arms[edge.attribute("to").value()].insert(edge.attribute("id").value());
    std::set<std::pair<std::string, std::size_t>> kinds;
    std::map<std::string, std::string> rules;
    for (const pugi::xml_node junction : file.child("net").children("junction")) {
        const std::string name = junction.attribute("id").value();
        if (name.front() == ':' || name.find("round") != std::string::npos)
            continue;
        kinds.emplace(junction.attribute("type").value(), arms.at(name).size());
        EXPECT_EQ(arms.at(name).size(), name.front() == 'x' ? 4U : 3U) << name;
        rules[name] = junction.attribute("type").value();
    }
    for (const char* rule :
         {"traffic_light", "priority", "priority_stop", "allway_stop", "right_before_left"})
        for (const std::size_t count : {3U, 4U})
            EXPECT_TRUE(kinds.contains({rule, count})) << rule << " with " << count << " arms";
    EXPECT_EQ(rules.at("x_lit"), "traffic_light") << "a name says its rule";
    EXPECT_EQ(rules.at("t_stop"), "priority_stop");
    EXPECT_EQ(file.child("net").select_nodes("roundabout").size(), 2U);
}

}  // namespace
}  // namespace reprise::towns
