#include "towns/import/map_signs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/towns/street_map.h"
#include "towns/import/town_import.h"
#include "towns/town_reader.h"
#include "world/geometry2d.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// Two equal streets cross. `south` is a node of the one from south to north, 12 m before the
/// crossroads; `north` one 12 m behind it.
std::string crossroads(const Tagged& south, const Tagged& middle, const Tagged& north) {
    StreetMap map;
    const Tagged street{{"highway", "residential"}};
    const int centre = map.node(0, 0, middle);
    map.way({map.node(0, -150),
             map.node(0, -12, south),
             centre,
             map.node(0, 12, north),
             map.node(0, 150)},
            street);
    map.way({map.node(-150, 0), centre, map.node(150, 0)}, street);
    return map.text();
}

class MapSigns : public ::testing::Test {
  protected:
    MapSigns()
        : folder_(fs::path(::testing::TempDir()) / ("map signs " + std::to_string(getpid()))) {
        fs::create_directories(folder_ / "t");
    }

    ~MapSigns() override { fs::remove_all(folder_); }

    world::TownT import(const std::string& map) {
        std::ofstream(folder_ / "cross.osm") << map;
        report_ = import_town({folder_ / "cross.osm", "", false, false}, folder_ / "t");
        return read_town(load_network(folder_ / "t/cross.net.xml"));
    }

    fs::path folder_;
    std::string report_;
};

/// Where signs of a kind stand, seen from the crossroads: 'n', 'e', 's' or 'w', in that order.
std::string sides(const world::TownT& town, world::PropKind kind) {
    std::string found;
    const auto crossroads = std::max_element(
        town.junctions.begin(), town.junctions.end(), [](const auto& one, const auto& other) {
            return one.outline.size() < other.outline.size();
        });
    for (const world::Prop& prop : town.props) {
        if (prop.kind() != kind)
            continue;
        const Eigen::Vector2d off =
            world::in_plan(prop.position()) - world::in_plan(crossroads->centre);
        found += std::abs(off.y()) > std::abs(off.x()) ? (off.y() > 0 ? 'n' : 's')
                                                       : (off.x() > 0 ? 'e' : 'w');
    }
    std::sort(found.begin(), found.end());
    return found;
}

const Tagged stop{{"highway", "stop"}}, give_way{{"highway", "give_way"}};

TEST_F(MapSigns, StopsAndGivesWayAtTheNearestJunction) {
    const world::TownT plain = import(crossroads({}, {}, {}));
    EXPECT_EQ(sides(plain, world::PropKind::stop_sign), "");
    EXPECT_EQ(sides(plain, world::PropKind::yield_sign), "ew") << "of equal roads it chooses one";
    const world::TownT stops = import(crossroads(stop, {}, stop));
    EXPECT_EQ(sides(stops, world::PropKind::stop_sign), "ns");
    EXPECT_EQ(sides(stops, world::PropKind::yield_sign), "");
    EXPECT_THAT(report_,
                HasSubstr("as stop and yield signs say at 1 junction; of roads with such a sign 2 "
                          "of 2 give way"));
    const world::TownT yields = import(crossroads(give_way, {}, {}));
    EXPECT_EQ(sides(yields, world::PropKind::yield_sign), "ns") << "SUMO gives way in pairs";
}

TEST_F(MapSigns, OnlyRoadsWithAStopSignStop) {
    const world::TownT mixed = import(crossroads(stop, {}, give_way));
    EXPECT_EQ(sides(mixed, world::PropKind::stop_sign), "s");
    EXPECT_EQ(sides(mixed, world::PropKind::yield_sign), "n");
    const world::TownT one = import(crossroads(stop, {}, {}));
    EXPECT_EQ(sides(one, world::PropKind::stop_sign), "s");
    EXPECT_EQ(sides(one, world::PropKind::yield_sign), "n") << "SUMO gives way in pairs";
    // What the signs say is what SUMO reads.
    std::ostringstream network;
    network << std::ifstream(folder_ / "t/cross.net.xml").rdbuf();
    pugi::xml_document file;
    file.load_string(network.str().c_str());
    std::set<std::string> stopping;
    for (const pugi::xml_node connection : file.child("net").children("connection"))
        if (*connection.attribute("state").value() == 's')
            stopping.insert(connection.attribute("from").value());
    EXPECT_EQ(stopping.size(), 1U);
}

TEST_F(MapSigns, DirectionSaysWhoIsMeant) {
    const auto stops_for = [&](const std::string& direction) {
        return sides(import(crossroads({stop[0], {"direction", direction}}, {}, {})),
                     world::PropKind::stop_sign);
    };
    EXPECT_EQ(stops_for("forward"), "s");
    EXPECT_EQ(stops_for("backward"), "") << "that way the next junction is far";
}

TEST_F(MapSigns, InTheMiddleOnlyAllWayStopsCount) {
    EXPECT_EQ(sides(import(crossroads({}, stop, {})), world::PropKind::stop_sign), "");
    import(crossroads({}, {stop[0], { "stop", "all" }}, {}));
}

TEST_F(MapSigns, BridgesAreStillFoundBehindSigns) {
    StreetMap map;
    const Tagged street{{"highway", "residential"}};
    const int crossing = map.node(0, 0), foot = map.node(0, 150), top = map.node(0, 210);
    map.way({map.node(0, -150), map.node(0, -12, stop), crossing, foot}, street);
    map.way({map.node(-150, 0), crossing, map.node(150, 0)}, street);
    map.way({foot, top}, {street[0], {"bridge", "yes"}});
    map.way({top, map.node(0, 400)}, street);
    map.way({map.node(-300, 180), map.node(300, 180)}, {{"highway", "motorway"}});
    const world::TownT town = import(map.text());
    EXPECT_EQ(sides(town, world::PropKind::stop_sign), "s");
    EXPECT_NEAR(town.high.z(), 6, 0.01) << report_;
}

}  // namespace
}  // namespace reprise::towns
