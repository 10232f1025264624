#include "towns/network/waiting_places.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/support/towns.h"
#include "towns/network/network_xml.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

pugi::xml_document network_of(const std::string& town) {
    pugi::xml_document document;
    const std::string path =
        std::string(REPRISE_SOURCE_DIR) + "/scenarios/towns/" + town + "/" + town + ".net.xml";
    EXPECT_TRUE(document.load_file(path.c_str()));
    return document;
}

double length_of_all(const pugi::xml_document& document) {
    double length = 0;
    for (const pugi::xml_node edge : document.child("net").children("edge"))
        for (const pugi::xml_node lane : edge.children("lane"))
            length += number(lane.attribute("length").value(), 0);
    return length;
}

/// [m] from a point to the nearest of a lane's centre line.
double distance(const world::Vec3& point, const world::LaneT& lane) {
    const Eigen::Vector3d p(point.x(), point.y(), point.z());
    const world::LaneProjection at = world::project(lane, p);
    return (world::point_at(lane, at.s).position - p).head<2>().norm();
}

/// Who turns right from r2 into b1_d1 lets those pass who turn left into it, and used to wait where
/// both ways are one.
TEST(WaitingPlaces, WhoWaitsInAJunctionIsClearOfThoseWhoPass) {
    const world::TownT& town = test::own_town("town2").town;
    const world::LaneT& waits = town.lanes[test::lane(town, ":b1_2_0")];
    const world::LaneT& passes = town.lanes[test::lane(town, ":b1_9_0")];
    EXPECT_GT(distance(waits.centre.back(), passes), 1.9) << "two half cars and some air";
    EXPECT_LT(waits.length, 13);
}

/// A bend to the left, those who come towards it, and one who turns left from the right over all of
/// it: to wait clear of him it would have to end before the junction.
TEST(WaitingPlaces, WhoIsHinderedWhereverItIsKeepsNobodyFromBeingClearOfTheOthers) {
    pugi::xml_document network;
    ASSERT_TRUE(network.load_string(R"(<net>
        <edge id="in"><lane id="in_0" length="20" shape="0,-20 0,0"/></edge>
        <edge id="out"><lane id="out_0" length="20" shape="-5,14 -25,14"/></edge>
        <edge id="north"><lane id="north_0" length="20" shape="-2.6,40 -2.6,20"/></edge>
        <edge id="east"><lane id="east_0" length="20" shape="30,9 10,9"/></edge>
        <edge id="south"><lane id="south_0" length="20" shape="-2.6,0 -2.6,-20"/></edge>
        <edge id=":j_0" function="internal">
            <lane id=":j_0_0" length="8.162" shape="0,0 0,5 -1,8"/></edge>
        <edge id=":j_1" function="internal">
            <lane id=":j_1_0" length="20" shape="-2.6,20 -2.6,0"/></edge>
        <edge id=":j_2" function="internal">
            <lane id=":j_2_0" length="17.7" shape="10,9 0,7 -2.6,0"/></edge>
        <edge id=":j_3" function="internal">
            <lane id=":j_3_0" length="7.2" shape="-1,8 -5,14"/></edge>
        <junction id="j" type="priority"/>
        <junction id=":j_3_0" type="internal" x="-1" y="8" incLanes=":j_0_0" intLanes=":j_1_0 :j_2_0"/>
        <connection from="in" to="out" fromLane="0" toLane="0" via=":j_0_0"/>
        <connection from="north" to="south" fromLane="0" toLane="0" via=":j_1_0"/>
        <connection from="east" to="south" fromLane="0" toLane="0" via=":j_2_0"/>
        <connection from=":j_0" to="out" fromLane="0" toLane="0" via=":j_3_0"/>
        <connection from=":j_1" to="south" fromLane="0" toLane="0"/>
        <connection from=":j_2" to="south" fromLane="0" toLane="0"/>
        <connection from=":j_3" to="out" fromLane="0" toLane="0"/> </net>)"));
    EXPECT_EQ(move_waiting_places(network.child("net")), 1U);
    EXPECT_EQ(move_waiting_places(network.child("net")), 0U);
    const pugi::xml_node place =
        network.child("net").find_child_by_attribute("junction", "id", ":j_3_0");
    const double left_corner = number(place.attribute("x").value(), 0) - 0.95 * 3 / std::sqrt(10.0);
    EXPECT_GT(left_corner, -2.6 + 1.29) << "clear of those who come towards it";
    EXPECT_GT(number(place.attribute("y").value(), 0), 5) << "but not before the bend";
}

TEST(WaitingPlaces, WaysStayAsLongAsTheyAreAndTwiceIsAsGoodAsOnce) {
    for (const char* town : {"town1", "town2"}) {
        pugi::xml_document network = network_of(town);
        const double before = length_of_all(network);
        EXPECT_GT(move_waiting_places(network.child("net")), 3U) << town;
        EXPECT_NEAR(length_of_all(network), before, 0.1) << town;
        EXPECT_EQ(move_waiting_places(network.child("net")), 0U) << town;
    }
}

}  // namespace
}  // namespace reprise::towns
