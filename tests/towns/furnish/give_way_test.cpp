#include "towns/furnish/give_way.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/support/towns.h"
#include "world/frames.h"

namespace reprise::towns {
namespace {

/// A T: `main` goes through, `side` ends there, with a crossing over it that all must respect.
/// Link 0: side to the right, 1: side to the left, 2: main straight on; 3: the crossing.
std::string junction(const std::string& type,
                     const std::string& side_state,
                     const std::string& main_state = "m") {
    const auto edge = [](const std::string& id, const std::string& from, const std::string& to) {
        return "<edge id=\"" + id + "\" from=\"" + from + "\" to=\"" + to + "\"><lane id=\"" + id +
               "_0\" index=\"0\" speed=\"9\" length=\"50\" shape=\"0,0 50,0\"/></edge>";
    };
    const auto inner = [](const std::string& id) {
        return "<edge id=\"" + id + "\" function=\"internal\"><lane id=\"" + id +
               "_0\" index=\"0\" speed=\"9\" length=\"5\" shape=\"50,0 55,0\"/></edge>";
    };
    const auto link = [&](const std::string& from,
                          const std::string& to,
                          const std::string& via,
                          const std::string& state) {
        return "<connection from=\"" + from + "\" to=\"" + to +
               "\" fromLane=\"0\" toLane=\"0\" via=\"" + via + "_0\" dir=\"s\" state=\"" + state +
               "\"/>";
    };
    return "<net version=\"1.9\">" + edge("main", "A", "a_J") + edge("side", "B", "a_J") +
           edge("out", "a_J", "C") + edge("up", "a_J", "D") + inner(":a_J_0") + inner(":a_J_1") +
           inner(":a_J_2") + "<junction id=\"a_J\" type=\"" + type +
           "\" x=\"50\" y=\"0\" shape=\"\" intLanes=\":a_J_0_0 :a_J_1_0 :a_J_2_0 :a_J_c0_0\">"
           "<request index=\"0\" response=\"1100\" foes=\"1100\" cont=\"0\"/>"
           "<request index=\"1\" response=\"1100\" foes=\"1100\" cont=\"0\"/>"
           "<request index=\"2\" response=\"1000\" foes=\"1011\" cont=\"0\"/>"
           "<request index=\"3\" response=\"0000\" foes=\"0111\" cont=\"0\"/></junction>" +
           link("side", "out", ":a_J_0", side_state) + link("side", "up", ":a_J_1", side_state) +
           link("main", "out", ":a_J_2", main_state) + "</net>";
}

GiveWay of(const std::string& lane, const std::string& net) {
    const world::TownT town = read_town({"tiny", net, "", ""});
    pugi::xml_document document;
    document.load_string(net.c_str());
    return read_give_way(document.child("net"), town)[test::lane(town, lane)];
}

TEST(GiveWay, YieldingToWalkersAloneTakesNoSign) {
    EXPECT_EQ(of("side_0", junction("priority", "m")), GiveWay::yield);
    EXPECT_EQ(of("main_0", junction("priority", "m")), GiveWay::none);
    EXPECT_EQ(of("out_0", junction("priority", "m")), GiveWay::none);
}

TEST(GiveWay, StopsAreTold) {
    EXPECT_EQ(of("side_0", junction("priority_stop", "s")), GiveWay::stop);
    EXPECT_EQ(of("main_0", junction("priority_stop", "s")), GiveWay::none);
}

TEST(GiveWay, ACrossingAloneMakesNoStopSign) {
    EXPECT_EQ(of("side_0", junction("priority_stop", "s", "s")), GiveWay::stop);
    EXPECT_EQ(of("main_0", junction("priority_stop", "s", "s")), GiveWay::none);
    EXPECT_EQ(of("main_0", junction("allway_stop", "w", "w")), GiveWay::stop) << "all do";
}

TEST(GiveWay, EqualRoadsAndLightsHaveNoSigns) {
    EXPECT_EQ(of("side_0", junction("right_before_left", "=")), GiveWay::none);
    EXPECT_EQ(of("side_0", junction("traffic_light", "o")), GiveWay::none);
}

/// Names of the roads with a sign of a kind, "a b c", by their kerb-side lanes.
std::string signed_roads(const world::TownT& town, world::PropKind kind) {
    std::string roads;
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::driving || lane.links.empty())
            continue;
        const Eigen::Vector3d end = world::point_at(lane, lane.length).position;
        const double yaw = world::point_at(lane, lane.length).yaw;
        if (std::any_of(town.props.begin(), town.props.end(), [&](const world::Prop& prop) {
                return prop.kind() == kind && std::cos(prop.yaw() - yaw) > 0.9 &&
                       (world::to_eigen(prop.position()) - end).norm() < 4;
            }))
            roads += (roads.empty() ? "" : " ") + lane.edge;
    }
    return roads;
}

TEST(GiveWay, StopSignsStandOnTheSideStreetsOfOurTowns) {
    EXPECT_EQ(signed_roads(test::own_town("town1").town, world::PropKind::stop_sign),
              "l1_a2 m1_b2 r1_c2");
    EXPECT_EQ(signed_roads(test::own_town("town2").town, world::PropKind::stop_sign),
              "d1_l2 r2_a2");
}

TEST(GiveWay, SideStreetsOfOurTownsYield) {
    const test::Loaded& own = test::own_town("town1");
    const auto signs =
        std::count_if(own.town.props.begin(), own.town.props.end(), [](const world::Prop& prop) {
            return prop.kind() == world::PropKind::yield_sign ||
                   prop.kind() == world::PropKind::stop_sign;
        });
    EXPECT_GE(signs, 5);
}

}  // namespace
}  // namespace reprise::towns
