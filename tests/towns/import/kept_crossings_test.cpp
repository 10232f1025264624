// Which crossings of a map stay, and where others are guessed.
#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/towns/import/imports.h"
#include "tests/towns/street_map.h"
#include "towns/network/network.h"
#include "towns/town_reader.h"
#include "world/story/wording.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using world::LaneKind;

/// A straight road with sidewalks whose limit changes half-way, after 100 m; with these objects.
std::string road_with_two_limits(const std::string& objects) {
    const auto lane = [](int id, const char* type) {
        return fmt::format(
            "<lane id='{}' type='{}'><width sOffset='0' a='3' b='0' c='0' d='0'/>"
            "</lane>",
            id,
            type);
    };
    const std::string lanes = "<left>" + lane(2, "sidewalk") + lane(1, "driving") +
                              "</left><center><lane id='0' type='none'/></center><right>" +
                              lane(-1, "driving") + lane(-2, "sidewalk") + "</right>";
    return "<OpenDRIVE><header revMajor='1' revMinor='4'/><road id='1' length='200' "
           "junction='-1'><type s='0' type='town'><speed max='30' unit='km/h'/></type>"
           "<type s='100' type='town'><speed max='50' unit='km/h'/></type>"
           "<planView><geometry s='0' x='0' y='0' hdg='0' length='200'><line/></geometry>"
           "</planView><lanes><laneSection s='0'>" +
           lanes + "</laneSection><laneSection s='100'>" + lanes +
           "</laneSection></lanes><objects>" + objects + "</objects></road></OpenDRIVE>";
}

auto count_of(const world::TownT& town, LaneKind kind) {
    return std::count_if(town.lanes.begin(), town.lanes.end(), [kind](const world::LaneT& lane) {
        return lane.kind == kind;
    });
}

TEST_F(Imports, NoCrossingIsGuessedWhereARoadOnlyGoesOn) {
    const std::string report =
        import_town({write("limits.xodr", road_with_two_limits("")), "", false, false}, empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/limits.net.xml"));
    EXPECT_EQ(count_of(town, LaneKind::driving), 4) << "there is a join";
    EXPECT_EQ(count_of(town, LaneKind::crossing), 0);
    EXPECT_THAT(report, Not(HasSubstr("between junctions")));
}

TEST_F(Imports, CrossingsOfANetworkStayWhereOthersAreGuessed) {
    const auto crossings = [&](const std::string& name, const std::string& objects) {
        import_town({write(name + ".xodr", road_with_two_limits(objects)), "", false, false},
                    empty(name));
        const fs::path network = folder_ / name / (name + ".net.xml");
        import_town({network, "again", false, true}, empty(name + "2"));
        return count_of(read_town(load_network(folder_ / (name + "2") / "again.net.xml")),
                        LaneKind::crossing);
    };
    EXPECT_EQ(crossings("none", ""), 0);
    EXPECT_EQ(crossings("one", "<object type='crosswalk' id='1' s='97' t='0'/>"), 1);
}

TEST_F(Imports, ACrosswalkOfTheMapStaysIfThereIsAJoinForIt) {
    const std::string report =
        import_town({write("walk.xodr",
                           road_with_two_limits("<object type='crosswalk' id='1' s='97' t='0'/>"
                                                "<object type='crosswalk' id='2' s='40' t='0'/>")),
                     "",
                     false,
                     false},
                    empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/walk.net.xml"));
    EXPECT_EQ(count_of(town, LaneKind::crossing), 1);
    EXPECT_THAT(report, HasSubstr("lost: 1 crossing between junctions"));
}

TEST_F(Imports, CrossingsOfAStreetMapThatFindNoPlaceAreCounted) {
    StreetMap map;
    const Tagged street{{"highway", "residential"}, {"sidewalk", "both"}},
        zebra{{"highway", "crossing"}};
    const int corner = map.node(100, 0);
    map.way(
        {map.node(0, 0), map.node(50, 0, zebra), map.node(92, 0, zebra), corner, map.node(200, 0)},
        street);
    map.way({corner, map.node(100, 100)}, street);
    map.way({map.node(150, 60, zebra), map.node(180, 60)},
            {{"highway", "service"}, {"access", "private"}, {"motor_vehicle", "no"}});
    const std::string report =
        import_town({write("zebra.osm", map.text()), "", false, false}, empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/zebra.net.xml"));
    EXPECT_GE(count_of(town, LaneKind::crossing), 1) << "at the corner";
    EXPECT_THAT(report, HasSubstr("lost: 1 crossing between junctions"));
}

/// As most cities are mapped: sidewalks are ways of their own, and so is what leads over the road.
TEST_F(Imports, FootwaysOfAStreetMapCrossItsRoadsOnACrossing) {
    StreetMap map;
    const Tagged foot{{"highway", "footway"}};
    const int zebra = map.node(100, 0, {{"highway", "crossing"}});
    map.way({map.node(0, 0), zebra, map.node(200, 0)}, {{"highway", "residential"}});
    for (const double side : {-8, 8}) {
        const int middle = map.node(100, side);
        map.way({map.node(0, side), middle, map.node(200, side)}, foot);
        map.way({middle, zebra}, foot);
    }
    const std::string report =
        import_town({write("foot.osm", map.text()), "", false, false}, empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/foot.net.xml"));
    EXPECT_EQ(count_of(town, LaneKind::crossing), 1);
    EXPECT_THAT(report, Not(HasSubstr("lost: 1 crossing")));
}

}  // namespace
}  // namespace reprise::towns
