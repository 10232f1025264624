#include "towns/import/stubs.h"

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/towns/import/imports.h"
#include "tests/towns/street_map.h"
#include "towns/network/network.h"
#include "towns/town_reader.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::string street(
    const char* id, const char* from, const char* to, double length, const char* more = "") {
    return fmt::format(
        "<edge id='{0}' from='{1}' to='{2}'><lane id='{0}_0' length='{3}'{4}/></edge>",
        id,
        from,
        to,
        length,
        more);
}

TEST(Stubs, AreShortRoadsForCarsThatLeadNowhere) {
    const std::string streets = street("a", "w", "j", 90) + street("b", "j", "e", 90);
    EXPECT_THAT(
        stubs("<net>" + streets + street("c", "j", "n", 5) + street("-c", "n", "j", 5) + "</net>"),
        ElementsAre("c", "-c"));
    EXPECT_THAT(stubs("<net>" + streets + street("c", "j", "n", 9) + "</net>"), IsEmpty())
        << "long";
    EXPECT_THAT(
        stubs("<net>" + streets + street("c", "j", "n", 5, " allow='pedestrian'") + "</net>"),
        IsEmpty())
        << "nobody drives there";
    EXPECT_THAT(
        stubs("<net>" + streets + street("c", "j", "n", 5) + street("d", "n", "m", 50) + "</net>"),
        IsEmpty())
        << "it goes on";
    EXPECT_THAT(stubs("<net>" + street("c", "j", "n", 5) + "</net>"), IsEmpty()) << "all there is";
}

TEST_F(Imports, NoRoadThatAMapCutsOffJustBehindAJunctionIsLeft) {
    StreetMap map;
    const Tagged street{{"highway", "residential"}};
    const int middle = map.node(0, 0);
    map.way({map.node(-150, 0), middle, map.node(150, 0)}, street);
    map.way({map.node(0, -150), middle, map.node(0, 9)}, street);
    const std::string report =
        import_town({write("cut.osm", map.text()), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("roads: 2 of less than 8 m"));
    const world::TownT town = read_town(load_network(folder_ / "t/cut.net.xml"));
    int driven = 0;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving) {
            EXPECT_GT(lane.length, 100) << lane.name;
            ++driven;
        }
    EXPECT_EQ(driven, 6);
}

/// netconvert, asked to take roads out of a network, lets everybody stop at a junction with a sign.
TEST_F(Imports, RoadsWithoutAStopSignHaveNoneWhereAStubIsLeftOut) {
    StreetMap map;
    const Tagged main{{"highway", "secondary"}}, side{{"highway", "residential"}};
    const int corner = map.node(0, 0);
    map.way({map.node(-150, 0), corner, map.node(150, 0)}, main);
    map.way({map.node(0, -150), map.node(0, -15, {{"highway", "stop"}}), corner}, side);
    map.way({corner, map.node(0, 150)}, side);
    const int cut = map.node(150, 150);
    map.way({map.node(0, 150), cut, map.node(300, 150)}, side);
    map.way({cut, map.node(150, 159)}, side);
    const std::string report =
        import_town({write("stop.osm", map.text()), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("of less than 8 m"));
    EXPECT_THAT(report, HasSubstr("as stop and yield signs say at 1 junction"));
    const std::string network = load_network(folder_ / "t/stop.net.xml").xml;
    std::size_t stops = 0;
    for (std::size_t at = network.find("state=\"s\""); at != std::string::npos;
         at = network.find("state=\"s\"", at + 1))
        ++stops;
    EXPECT_EQ(stops, 3U) << "left, straight on and right, from the south";
}

}  // namespace
}  // namespace reprise::towns
