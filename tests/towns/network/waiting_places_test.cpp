#include "towns/network/waiting_places.h"

#include <algorithm>
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
