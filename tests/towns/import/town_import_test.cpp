#include "towns/import/town_import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "process/program.h"
#include "tests/towns/import/imports.h"
#include "tests/towns/street_map.h"
#include "tests/traffic/stage.h"
#include "towns/network/network.h"
#include "towns/network/place.h"
#include "towns/town_reader.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using world::LaneKind;

/// [m] of driving lanes.
double driven(const world::TownT& town) {
    double length = 0;
    for (const world::LaneT& lane : town.lanes)
        length += lane.kind == LaneKind::driving ? lane.length : 0;
    return length;
}

TEST_F(Imports, AStreetMapBecomesATown) {
    const std::string report = import_town({village(), "", true, false}, empty("t"));
    EXPECT_EQ(report, bytes(folder_ / "t/import.txt"));
    std::set<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_ / "t"))
        files.insert(entry.path().filename().string());
    EXPECT_THAT(files, testing::ElementsAre("import.txt", "village.net.xml", "village.place.xml"));

    const Network network = load_network(folder_ / "t/village.net.xml");
    EXPECT_THAT(network.xml, Not(HasSubstr("<!--")));
    const world::TownT town = read_town(network);
    EXPECT_TRUE(town.left_hand);
    EXPECT_EQ(std::count_if(town.junctions.begin(),
                            town.junctions.end(),
                            [](const auto& junction) { return junction.lit; }),
              1);
    EXPECT_THAT(network.xml, HasSubstr("name=\"High Street &amp; Quay\""));
    // 30 mph as tagged, 50 km/h where nothing is.
    EXPECT_THAT(network.xml, HasSubstr("speed=\"13.411\""));
    double fastest = 0;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == LaneKind::driving)
            fastest = std::max(fastest, lane.speed_limit);
    EXPECT_LE(fastest, 13.9);
}

TEST_F(Imports, AStreetByItselfIsATown) {
    const fs::path map = write("lone.osm",
                               "<osm version=\"0.6\">"
                               "<node id=\"1\" lat=\"52.0\" lon=\"1.0\"/>"
                               "<node id=\"2\" lat=\"52.0\" lon=\"1.00146\"/>"
                               "<way id=\"3\"><nd ref=\"1\"/><nd ref=\"2\"/>"
                               "<tag k=\"highway\" v=\"residential\"/></way></osm>");
    import_town({map, "", false, false}, empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/lone.net.xml"));
    const auto driving = std::count_if(town.lanes.begin(), town.lanes.end(), [](const auto& lane) {
        return lane.kind == LaneKind::driving;
    });
    EXPECT_EQ(driving, 2) << "one each way";
}

TEST_F(Imports, StreetsKeepTheSpellingOfTheirNames) {
    StreetMap map;
    map.way(
        {map.node(0, 0), map.node(200, 0)},
        {{"highway", "residential"}, {"name", "L'\xC3\xA9t\xC3\xA9 &quot;a&quot; &lt;b> &amp;c"}});
    import_town({write("names.osm", map.text()), "", false, false}, empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/names.net.xml"));
    const auto named = std::find_if(town.lanes.begin(), town.lanes.end(), [](const auto& lane) {
        return !lane.street.empty();
    });
    ASSERT_NE(named, town.lanes.end());
    EXPECT_EQ(named->street, "L'\xC3\xA9t\xC3\xA9 \"a\" <b> &c");
}

TEST_F(Imports, ExtractsMayCutWaysOff) {
    std::string map = bytes(village());
    map.insert(map.rfind("</osm>"),
               "<way id=\"9001\"><nd ref=\"77001\"/><nd ref=\"77002\"/>"
               "<tag k=\"highway\" v=\"residential\"/></way>"
               "<way id=\"9002\"><nd ref=\"77003\"/><tag k=\"building\" v=\"yes\"/></way>");
    import_town({write("extract.osm", map), "", false, false}, empty("t"));
    import_town({village(), "", false, false}, empty("whole"));
    EXPECT_EQ(bytes(folder_ / "t/extract.place.xml"), bytes(folder_ / "whole/village.place.xml"));
}

TEST_F(Imports, AOneWayRoadByItselfIsATown) {
    const fs::path map = write(
        "lone.xodr",
        "<?xml version='1.0'?><!DOCTYPE OpenDRIVE [<!ENTITY a 'b'>]>\n"
        "<OpenDRIVE><header revMajor='1' revMinor='4'/><road id='1' length='80' junction='-1'>"
        "<planView><geometry s='0' x='0' y='0' hdg='0' length='80'><line/></geometry></planView>"
        "<lanes><laneSection s='0'><center><lane id='0' type='none'/></center><right>"
        "<lane id='-1' type='driving'><width sOffset='0' a='3.5' b='0' c='0' d='0'/></lane>"
        "</right></laneSection></lanes></road></OpenDRIVE>");
    import_town({map, "", false, false}, empty("t"));
    const test::Loaded loaded = test::load(folder_ / "t/lone.net.xml");
    EXPECT_NEAR(driven(loaded.town), 80, 0.01);
    // Nobody can go anywhere, and nothing breaks.
    test::Stage stage(loaded, 5);
    for (int i = 0; i < 40; ++i)
        EXPECT_LE(stage.step().traffic.cars.size(), 5U);
}

TEST_F(Imports, TheSameMapGivesTheSameBytes) {
    expect_same_bytes(village());
    expect_same_bytes(test::own_map("bridge.xodr"));
}

TEST_F(Imports, TheSameRealMapGivesTheSameBytes) {
    const fs::path map = test::real_map("Town07.xodr");
    if (!fs::exists(map))
        GTEST_SKIP() << test::missing_map(map);
    expect_same_bytes(map);
}

TEST_F(Imports, PackedMapsAreTheSame) {
    const std::string map = bytes(village());
    gzFile file = gzopen((folder_ / "village.osm.gz").c_str(), "wb");
    gzwrite(file, map.data(), static_cast<unsigned>(map.size()));
    gzclose(file);
    import_town({folder_ / "village.osm.gz", "", false, false}, empty("packed"));
    import_town({village(), "", false, false}, empty("plain"));
    for (const char* name : {"village.net.xml", "village.place.xml"})
        EXPECT_EQ(bytes(folder_ / "packed" / name), bytes(folder_ / "plain" / name)) << name;
}

TEST_F(Imports, ANetworkStaysAsItIs) {
    const fs::path own = fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns/town2/town2.net.xml";
    const std::string place = "<place><district style='old'/></place>";
    write("own.net.xml", bytes(own));
    write("own.place.xml", place);
    import_town({folder_ / "own.net.xml", "mine", false, false}, empty("t"));
    const Network made = load_network(folder_ / "t/mine.net.xml");
    EXPECT_EQ(made.name, "mine");
    EXPECT_EQ(made.place, place) << "what lies beside it goes along";
    EXPECT_EQ(read_town(made).lanes, test::own_town("town2").town.lanes);
}

TEST_F(Imports, SidewalksAreGuessedOnRequest) {
    const auto sidewalks = [](const fs::path& network) {
        const world::TownT town = read_town(load_network(network));
        return std::count_if(town.lanes.begin(), town.lanes.end(), [](const world::LaneT& lane) {
            return lane.kind == LaneKind::sidewalk || lane.kind == LaneKind::crossing;
        });
    };
    import_town({village(), "", false, false}, empty("without"));
    import_town({village(), "", false, true}, empty("with"));
    EXPECT_GT(sidewalks(folder_ / "with/village.net.xml"),
              sidewalks(folder_ / "without/village.net.xml"));
}

TEST_F(Imports, OurOwnTownComesBackThroughOpenDrive) {
    const fs::path own = fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns/town2/town2.net.xml";
    fs::copy_file(own, folder_ / "in.xml");
    ASSERT_EQ(
        process::run_program({"netconvert",
                              {"-X", "never", "-s", "in.xml", "--opendrive-output", "own.xodr"},
                              folder_})
            .code,
        0);
    import_town({folder_ / "own.xodr", "", false, false}, empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/own.net.xml"));
    const world::TownT& same = test::own_town("town2").town;
    EXPECT_NEAR(driven(town), driven(same), 0.01 * driven(same));
    const auto limits = [](const world::TownT& of) {
        std::multiset<int> found;
        for (const world::LaneT& lane : of.lanes)
            if (lane.kind == LaneKind::driving)
                found.insert(static_cast<int>(std::lround(lane.speed_limit * 3.6)));
        return found;
    };
    EXPECT_EQ(limits(town), limits(same));
    // Its lights hang over the lanes' ends: there is one for each lane, its pole at the kerb.
    const Place place = read_place(bytes(folder_ / "t/own.place.xml"), "own.place.xml");
    std::set<std::uint32_t> lit;
    for (const world::SignalT& signal : same.signals)
        if (!signal.for_walkers)
            lit.insert(signal.lane);
    EXPECT_GT(lit.size(), 10U);
    EXPECT_EQ(place.heads.size(), lit.size());
    for (const Place::Head& head : place.heads) {
        EXPECT_GT(head.arm, 1);
        EXPECT_GT(head.height, 5);
    }
}

TEST_F(Imports, StreetNamesStayAndMadeUpOnesGo) {
    std::string map = bytes(test::own_map("bridge.xodr"));
    const std::string made_up = "<road name=\"Road 1\"";
    map.replace(map.find(made_up), made_up.size(), "<road name=\"Road 1 &amp; Quay\"");
    import_town({write("named.xodr", map), "", false, false}, empty("t"));
    const std::string network = bytes(folder_ / "t/named.net.xml");
    EXPECT_THAT(network, HasSubstr("name=\"Road 1 &amp; Quay\""));
    EXPECT_THAT(network, Not(HasSubstr("name=\"Road 2\"")));
}

TEST_F(Imports, ImportedTownsCarryTraffic) {
    expect_traffic(village(), 20, 200);
    expect_traffic(test::own_map("bridge.xodr"), 20, 200);
}

TEST_F(Imports, ImportedRealTownsCarryTraffic) {
    const fs::path map = test::real_map("Town07.xodr");
    if (!fs::exists(map))
        GTEST_SKIP() << test::missing_map(map);
    expect_traffic(map, 20, 200);
}

}  // namespace
}  // namespace reprise::towns
