#include "towns/import/town_import.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include "ground/mesh/roofs.h"
#include "process/program.h"
#include "tests/towns/street_map.h"
#include "tests/traffic/stage.h"
#include "towns/import/right_of_way.h"
#include "towns/import/signal_sites.h"
#include "towns/network/place.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/models/building_models.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using world::LaneKind;

std::string bytes(const fs::path& path) {
    std::ostringstream all;
    all << std::ifstream(path, std::ios::binary).rdbuf();
    return std::move(all).str();
}

/// A folder of this test's own, with a comma in its name: SUMO's programs split paths there.
class Imports : public ::testing::Test {
  protected:
    Imports()
        : folder_(fs::path(::testing::TempDir()) /
                  ("reprise import, " + std::to_string(getpid()))) {
        fs::create_directories(folder_);
    }

    ~Imports() override { fs::remove_all(folder_); }

    fs::path empty(const std::string& name) const {
        fs::create_directory(folder_ / name);
        return folder_ / name;
    }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name, std::ios::binary) << text;
        return folder_ / name;
    }

    std::string message(const TownImport& wish) const {
        try {
            import_town(wish, empty("refused"));
        } catch (const world::Error& error) {
            return error.what();
        }
        return "no error";
    }

    void expect_same_bytes(const fs::path& map) const {
        const std::string name = map.stem().string();
        import_town({map, "", false, false}, empty(name + "1"));
        import_town({map, "", false, false}, empty(name + "2"));
        for (const std::string& ending :
             {name + ".net.xml", name + ".place.xml", std::string("import.txt")}) {
            const std::string first = bytes(folder_ / (name + "1") / ending);
            EXPECT_FALSE(first.empty()) << ending;
            EXPECT_EQ(first, bytes(folder_ / (name + "2") / ending)) << ending;
        }
    }

    void expect_traffic(const fs::path& map, int cars, int ticks) const;

    fs::path folder_;
};

fs::path village() {
    return fs::path(REPRISE_SOURCE_DIR) / "tests/towns/village.osm";
}

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

TEST_F(Imports, FootprintsKeepTheirPlaceAndHeight) {
    const std::string report = import_town({village(), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("courtyards: 1 were built over"));
    const Place place = read_place(bytes(folder_ / "t/village.place.xml"), "village.place.xml");
    // One lies 2 km away, one is the courtyard of another.
    ASSERT_EQ(place.buildings.size(), 7U);
    const auto side = [](const world::DrawnBuildingT& b, std::size_t i) {
        return std::hypot(b.outline[i].x() - b.outline[i + 1].x(),
                          b.outline[i].y() - b.outline[i + 1].y());
    };
    const auto with_ridge = [&](double height) {
        return std::find_if(place.buildings.begin(), place.buildings.end(), [&](const auto& b) {
            const auto [y, x] = std::minmax({side(b, 0) / 2, side(b, 1) / 2});
            const float rise = ground::roof_rise(world::building_models()[b.model - 1],
                                                 static_cast<float>(x),
                                                 static_cast<float>(y),
                                                 ground::building_seed(b.style));
            return std::abs(b.height + static_cast<double>(rise) - height) < 0.01;
        });
    };
    const auto church = with_ridge(18.288);  // 60'
    ASSERT_NE(church, place.buildings.end());
    EXPECT_EQ(church->model, *world::find_building_model("church") + 1);
    // 16 m x 40 m on the map; projected, within the scale of UTM.
    ASSERT_EQ(church->outline.size(), 4U);
    EXPECT_NEAR(std::min(side(*church, 0), side(*church, 1)), 16, 0.1);
    EXPECT_NEAR(std::max(side(*church, 0), side(*church, 1)), 40, 0.1);
    EXPECT_NE(with_ridge(11.5), place.buildings.end());
    EXPECT_TRUE(std::any_of(place.buildings.begin(), place.buildings.end(), [](const auto& b) {
        return b.height == 15;
    })) << "five floors";
    std::multiset<world::PlotKind> kinds;
    for (const world::PlotT& plot : place.plots)
        kinds.insert(plot.kind);
    EXPECT_EQ(kinds,
              (std::multiset<world::PlotKind>{world::PlotKind::park,
                                              world::PlotKind::water,
                                              world::PlotKind::car_park,
                                              world::PlotKind::playground,
                                              world::PlotKind::lawn}));
}

double area_of(const std::vector<world::Vec3>& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const world::Vec3& p = outline[i];
        const world::Vec3& q = outline[(i + 1) % outline.size()];
        twice += p.x() * q.y() - q.x() * p.y();
    }
    return twice / 2;
}

TEST_F(Imports, BuildingsAreCutBackToTheRoadsOrLeftOut) {
    // One that a road grazes, one in the middle of it; drawn clockwise, in degrees.
    std::string map = bytes(village());
    const auto add = [&](int id, double north, double depth) {
        constexpr double metre = 1 / 111'200.0, metre_east = metre / 0.6232;
        std::string nodes, way = "<way id=\"" + std::to_string(id) + "\">";
        const double corners[4][2] = {{170, 0}, {170, depth}, {190, depth}, {190, 0}};
        for (int i = 0; i < 5; ++i) {
            const int node = id * 10 + i % 4;
            if (i < 4)
                nodes += "<node id=\"" + std::to_string(node) + "\" lat=\"" +
                         std::to_string(51.4520 + (north + corners[i][1]) * metre) + "\" lon=\"" +
                         std::to_string(-2.59 + corners[i][0] * metre_east) + "\"/>";
            way += "<nd ref=\"" + std::to_string(node) + "\"/>";
        }
        map.insert(map.find(" <way"), nodes);
        map.insert(map.rfind("</osm>"), way + "<tag k=\"building\" v=\"yes\"/></way>\n");
    };
    add(9001, 178, 18);  // North Road runs at 180 m: its strip is cut off
    add(9002, 178, 8);   // too little is left
    const std::string report = import_town({write("cut.osm", map), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("8 with their own footprints; 1 cut back"));
    EXPECT_THAT(report, HasSubstr("1 left out"));
    const Place place = read_place(bytes(folder_ / "t/cut.place.xml"), "cut.place.xml");
    for (const world::DrawnBuildingT& building : place.buildings)
        EXPECT_GT(area_of(building.outline), 0) << "counter-clockwise";
}

/// A rectangle: its corners, and two ways around it, both from the first to the third corner.
struct Halves {
    std::vector<int> corners;
    int south_east = 0, north_west = 0;
};

Halves halves(StreetMap& map,
              double west,
              double width,
              double depth,
              const Tagged& tags = {},
              double south = 30) {
    Halves made;
    for (const auto& [east, north] :
         {std::pair{0.0, 0.0}, {width, 0.0}, {width, depth}, {0.0, depth}})
        made.corners.push_back(map.node(west + east, south + north));
    const std::vector<int>& c = made.corners;
    made.south_east = map.way({c[0], c[1], c[2]}, tags);
    made.north_west = map.way({c[0], c[3], c[2]}, tags);
    return made;
}

TEST_F(Imports, OutlinesOfSeveralWaysAreClosed) {
    StreetMap map;
    map.way({map.node(0, 0), map.node(300, 0)}, {{"highway", "residential"}});
    // Two houses of one relation, the second way of each drawn against the first.
    const Halves one = halves(map, 20, 20, 10), two = halves(map, 60, 30, 10);
    map.multipolygon({{one.south_east, "outer"},
                      {two.north_west, "outer"},
                      {one.north_west, "outer"},
                      {two.south_east, ""}},
                     {{"building", "house"}, {"height", "7"}});
    // A park, drawn as a fence; the northern half of it is an edge of a wood, too.
    const Halves park = halves(map, 110, 50, 40, {{"barrier", "fence"}});
    const int far = map.node(100, 110);
    const int around = map.way({park.corners[2], far, park.corners[0]}, {});
    map.multipolygon({{park.south_east, "outer"}, {park.north_west, "outer"}},
                     {{"leisure", "park"}});
    map.multipolygon({{park.north_west, "outer"}, {around, "outer"}}, {{"natural", "wood"}});
    // One half is missing.
    const Halves cut = halves(map, 200, 30, 10);
    map.multipolygon({{cut.south_east, "outer"}, {777, "outer"}}, {{"building", "yes"}});
    const std::string report =
        import_town({write("rings.osm", map.text()), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("buildings: 2 with"));
    EXPECT_THAT(report, HasSubstr("lost: 1 areas, or parts of them"));
    const Place place = read_place(bytes(folder_ / "t/rings.place.xml"), "rings.place.xml");
    std::multiset<long> areas;
    for (const world::DrawnBuildingT& building : place.buildings) {
        areas.insert(std::lround(area_of(building.outline) / 10));
        EXPECT_GT(building.height, 3);
        EXPECT_LE(building.height, 7) << "of the eaves; the ridge has the map's height";
    }
    EXPECT_EQ(areas, (std::multiset<long>{20, 30}));
    std::multiset<world::PlotKind> kinds;
    for (const world::PlotT& plot : place.plots) {
        kinds.insert(plot.kind);
        if (plot.kind == world::PlotKind::park) {
            EXPECT_NEAR(area_of(plot.outline), 50 * 40, 10);
        }
    }
    EXPECT_EQ(kinds, (std::multiset{world::PlotKind::park, world::PlotKind::forest}));
}

TEST_F(Imports, OutlinesAreClosedInEveryEncoding) {
    StreetMap map;
    map.way({map.node(0, 0), map.node(300, 0)}, {{"highway", "residential"}});
    const Halves house = halves(map, 20, 20, 10);
    map.multipolygon({{house.south_east, "outer"}, {house.north_west, "outer"}},
                     {{"building", "yes"}, {"name", "H\xF6he"}});
    const fs::path file =
        write("latin.osm",
              "<?xml version='1.0' encoding='ISO-8859-1'?>\n<!-- <relation> -->" + map.text());
    EXPECT_THAT(import_town({file, "", false, false}, empty("t")), HasSubstr("buildings: 1 with"));
}

TEST_F(Imports, CourtyardsOfSeveralWaysAreCountedAndFilled) {
    StreetMap map;
    map.way({map.node(0, 0), map.node(300, 0)}, {{"highway", "residential"}});
    const Halves yard = halves(map, 40, 10, 10);
    const Halves block = halves(map, 30, 40, 30, {}, 20);
    map.multipolygon({{block.south_east, "outer"},
                      {block.north_west, "outer"},
                      {yard.south_east, "inner"},
                      {yard.north_west, "inner"}},
                     {{"building", "yes"}});
    const std::string report =
        import_town({write("yard.osm", map.text()), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("buildings: 1 with"));
    EXPECT_THAT(report, HasSubstr("courtyards: 1 were built over"));
    EXPECT_THAT(report, Not(HasSubstr("lost")));
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

TEST_F(Imports, LightsStayWhereTheHeaderMovesTheMap) {
    // As netconvert writes maps that know where on earth they lie.
    std::string net = bytes(fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns/town2/town2.net.xml");
    const std::size_t location = net.find("<location");
    net.replace(location,
                net.find("/>", location) + 2 - location,
                "<location netOffset='-604000.00,-5792000.00' convBoundary='0,0,300,300' "
                "origBoundary='10,52,11,53' projParameter='+proj=utm +zone=32 +ellps=WGS84 "
                "+datum=WGS84 +units=m +no_defs'/>");
    write("in.xml", net);
    ASSERT_EQ(
        process::run_program({"netconvert",
                              {"-X", "never", "-s", "in.xml", "--opendrive-output", "moved.xodr"},
                              folder_})
            .code,
        0);
    ASSERT_NE(bytes(folder_ / "moved.xodr").find("<offset x=\"-604000"), std::string::npos);
    const std::string report = import_town({folder_ / "moved.xodr", "", false, false}, empty("t"));
    const ImportedRoads roads = read_roads(bytes(folder_ / "t/moved.net.xml"), "moved");
    const Place place = read_place(bytes(folder_ / "t/moved.place.xml"), "moved.place.xml");
    std::set<std::uint32_t> lit;
    for (const world::SignalT& signal : roads.town.signals)
        if (signal.lane != world::none && roads.town.lanes[signal.lane].kind == LaneKind::driving)
            lit.insert(signal.lane);
    EXPECT_GT(lit.size(), 10U);
    EXPECT_EQ(place.heads.size(), lit.size()) << report;
}

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
    EXPECT_THAT(report, Not(HasSubstr("crossings between junctions")));
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
    EXPECT_THAT(report, HasSubstr("lost: 1 crossings between junctions"));
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
    EXPECT_THAT(report, HasSubstr("lost: 1 crossings between junctions"));
}

TEST_F(Imports, ASignOnTheRoadIsMovedBeyondTheMiddleOfTheSidewalk) {
    const fs::path map = write(
        "narrow.xodr",
        "<OpenDRIVE><header revMajor='1' revMinor='4'/><road id='1' length='80' junction='-1'>"
        "<planView><geometry s='0' x='0' y='0' hdg='0' length='80'><line/></geometry></planView>"
        "<lanes><laneSection s='0'><center><lane id='0' type='none'/></center><right>"
        "<lane id='-1' type='driving'><width sOffset='0' a='3.5' b='0' c='0' d='0'/></lane>"
        "<lane id='-2' type='sidewalk'><width sOffset='0' a='1.2' b='0' c='0' d='0'/></lane>"
        "</right></laneSection></lanes><signals>"
        "<signal id='a' s='40' t='-1.75' type='274' value='30' "
        "orientation='+' dynamic='no' country='DEU' subtype='-1' zOffset='2'/>"
        "<signal id='b' s='50' t='-4.1' type='274' value='50' "
        "orientation='+' dynamic='no' country='DEU' subtype='-1' zOffset='2'/>"
        "</signals></road></OpenDRIVE>");
    import_town({map, "", false, false}, empty("t"));
    const Place place = read_place(bytes(folder_ / "t/narrow.place.xml"), "narrow.place.xml");
    ASSERT_EQ(place.signs.size(), 2U);
    // The sidewalk's middle is at y = -4.1; from the lane's middle it goes in steps of 0.25 m.
    EXPECT_LT(place.signs[0].position().y(), -4.1 - 0.3);
    EXPECT_NEAR(place.signs[1].position().y(), -4.1, 1e-6) << "stays where the map has it";
}

TEST_F(Imports, EachLaneKeepsTheLightThatHangsOverIt) {
    ASSERT_EQ(process::run_program({"netgenerate",
                                    {"-X",
                                     "never",
                                     "--grid",
                                     "--grid.number",
                                     "2",
                                     "-L",
                                     "3",
                                     "--grid.attach-length",
                                     "80",
                                     "-j",
                                     "traffic_light",
                                     "--opendrive-output",
                                     "wide.xodr"},
                                    folder_})
                  .code,
              0);
    import_town({folder_ / "wide.xodr", "", false, false}, empty("t"));
    const Place place = read_place(bytes(folder_ / "t/wide.place.xml"), "wide.place.xml");
    const world::TownT town = read_town(load_network(folder_ / "t/wide.net.xml"));
    std::set<std::uint32_t> lit;
    for (const world::SignalT& signal : town.signals)
        if (signal.lane != world::none && town.lanes[signal.lane].kind == LaneKind::driving)
            lit.insert(signal.lane);
    EXPECT_EQ(lit.size(), 4U * 4 * 3) << "three lanes on each of four arms";
    EXPECT_EQ(place.heads.size(), lit.size());
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

/// Every head stands near the end of the lanes that it is for, and faces those who come there.
void expect_heads_suit(const ImportedRoads& roads, const Place& place) {
    for (const Place::Head& head : place.heads)
        for (const world::SignalT& signal : roads.town.signals)
            if (signal.program == head.program &&
                std::count(head.links.begin(), head.links.end(), signal.index) > 0) {
                EXPECT_LT(std::abs(world::wrap_angle(signal.yaw - head.yaw)), 0.1) << head.program;
                EXPECT_LT(std::hypot(signal.position.x() - head.foot.x(),
                                     signal.position.y() - head.foot.y()),
                          26)
                    << head.program;
            }
}

/// tests/maps/make_maps.py says what it holds.
TEST_F(Imports, AMapKeepsItsLightsSignsLimitsAndBridge) {
    const fs::path file = test::own_map("bridge.xodr");
    import_town({file, "", false, false}, empty("t"));
    const std::string network = bytes(folder_ / "t/bridge.net.xml");
    const ImportedRoads roads = read_roads(network, "bridge");
    const Place place = read_place(bytes(folder_ / "t/bridge.place.xml"), "bridge.place.xml");
    EXPECT_EQ(place.heads.size(), 4U) << "one on each arm";
    expect_heads_suit(roads, place);
    std::map<world::PropKind, int> signs;
    for (const world::Prop& sign : place.signs)
        ++signs[sign.kind()];
    EXPECT_EQ(signs,
              (std::map<world::PropKind, int>{{world::PropKind::stop_sign, 1},
                                              {world::PropKind::speed_limit_sign, 1}}));
    const OpenDrive map = read_opendrive(bytes(file), "bridge.xodr");
    const ObeyedSigns bind = obeyed_signs(lane_signs(map, roads), roads.town);
    EXPECT_EQ(bind.roads, 1);
    EXPECT_EQ(bind.giving_way, 1);

    const world::TownT town = read_town(load_network(folder_ / "t/bridge.net.xml"));
    std::set<long> limits_kmh;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == LaneKind::driving)
            limits_kmh.insert(std::lround(lane.speed_limit * 3.6));
    EXPECT_EQ(limits_kmh, (std::set<long>{30, 50}));
    // Where the road crosses itself, 95 m east of the crossing, it lies on the ground and 7 m
    // higher.
    const Eigen::Vector2d crossed = Eigen::Vector2d(95, 0) + offset_of(map, roads);
    std::set<long> heights;
    for (const world::LaneT& lane : town.lanes)
        for (double s = 0; lane.kind == LaneKind::driving && s < lane.length; s += 0.5) {
            const Eigen::Vector3d p = world::point_at(lane, s).position;
            if ((p.head<2>() - crossed).norm() < 3)
                heights.insert(std::lround(p.z()));
        }
    EXPECT_EQ(heights, (std::set<long>{0, 7}));
}

TEST_F(Imports, Town01KeepsItsLightsAndLimits) {
    const fs::path file = test::real_map("Town01.xodr");
    if (!fs::exists(file))
        GTEST_SKIP() << test::missing_map(file);
    import_town({file, "", false, false}, empty("t"));
    const fs::path network = folder_ / "t/Town01.net.xml";
    const world::TownT town = read_town(load_network(network));
    EXPECT_EQ(town.junctions.size(), 12U);
    EXPECT_EQ(std::count_if(town.lanes.begin(),
                            town.lanes.end(),
                            [](const auto& lane) { return lane.kind == LaneKind::crossing; }),
              36);
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == LaneKind::driving) {
            EXPECT_NEAR(lane.speed_limit, 11.176, 1e-3) << lane.name << ": 25 mph";
        }
    const Place place = read_place(bytes(folder_ / "t/Town01.place.xml"), "Town01.place.xml");
    EXPECT_EQ(place.heads.size(), 36U);
    const ImportedRoads roads = read_roads(bytes(network), "Town01");
    expect_heads_suit(roads, place);
    // Each lane that a light controls has one.
    std::map<std::pair<std::string, std::uint32_t>, int> heads;
    for (const Place::Head& head : place.heads)
        for (const std::uint32_t link : head.links)
            ++heads[{head.program, link}];
    for (const world::SignalT& signal : roads.town.signals)
        if (signal.lane != world::none && roads.town.lanes[signal.lane].kind == LaneKind::driving) {
            EXPECT_EQ((heads[{signal.program, signal.index}]), 1) << signal.program;
        }
}

TEST_F(Imports, Town07FollowsItsStopAndYieldSigns) {
    const fs::path file = test::real_map("Town07.xodr");
    if (!fs::exists(file))
        GTEST_SKIP() << test::missing_map(file);
    import_town({file, "", false, false}, empty("t"));
    const Place place = read_place(bytes(folder_ / "t/Town07.place.xml"), "Town07.place.xml");
    std::map<world::PropKind, int> signs;
    for (const world::Prop& sign : place.signs)
        ++signs[sign.kind()];
    EXPECT_EQ(signs[world::PropKind::stop_sign], 19);
    EXPECT_EQ(signs[world::PropKind::yield_sign], 20);
    EXPECT_EQ(place.heads.size(), 17U);
    const std::string network = bytes(folder_ / "t/Town07.net.xml");
    const ImportedRoads roads = read_roads(network, "Town07");
    expect_heads_suit(roads, place);
    EXPECT_THAT(network, HasSubstr("type=\"allway_stop\""));
    const OpenDrive map = read_opendrive(bytes(file), "Town07.xodr");
    const ObeyedSigns bind = obeyed_signs(lane_signs(map, roads), roads.town);
    EXPECT_EQ(bind.roads, 39);
    EXPECT_GE(bind.giving_way, 36) << "the rest stand where a road only goes on";
    // The signs stand on their own side of the road.
    for (const SignalSite& site : site_signals(map, roads))
        if (site.signal->kind == RoadSignal::Kind::stop) {
            EXPECT_TRUE(site.lane) << site.signal->id;
        }
}

void Imports::expect_traffic(const fs::path& map, int cars, int ticks) const {
    const fs::path made = empty(map.stem().string());
    import_town({map, "", false, false}, made);
    const test::Loaded loaded = test::load(made / (map.stem().string() + ".net.xml"));
    test::Stage stage(loaded, static_cast<std::uint32_t>(cars));
    double fastest = 0;
    for (int i = 0; i < ticks; ++i)
        for (const world::CarState& car : stage.step().traffic.cars)
            fastest = std::max(fastest, static_cast<double>(car.speed()));
    EXPECT_GT(fastest, 5) << map;
    EXPECT_GE(stage.draft().traffic.cars.size(), cars * 3U / 4) << map;
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

TEST_F(Imports, WhatIsNoMapIsRefusedInOneLine) {
    struct Case {
        const char* name;
        std::string text;
        const char* said;
    };

    std::string cut = bytes(village());
    cut.resize(cut.size() / 2);
    std::string deep = "<OpenDRIVE><road id='1' length='9'>";
    for (int i = 0; i < 2000; ++i)
        deep += "<userData>";
    for (int i = 0; i < 2000; ++i)
        deep += "</userData>";
    deep += "</road></OpenDRIVE>";
    const std::string wide =
        "<net><edge id='e'><lane id='e_0' index='0' speed='9' length='9' width='1000' "
        "shape='0,0 9,0'/></edge></net>";
    const Case cases[] = {
        {"empty.xodr", "", "empty.xodr: is empty"},
        {"binary.osm",
         std::string("\x7f"
                     "ELF\0\0\0",
                     7),
         "binary.osm: is not XML"},
        {"wide.osm", std::string("\xff\xfe<\0", 4), "wide.osm: is written in UTF-16"},
        {"page.osm", "<html></html>", "page.osm: begins with <html>"},
        {"none.xodr", "<OpenDRIVE/>", "none.xodr:1: has no <road>"},
        {"bare.xodr",
         "<OpenDRIVE><road id='1' length='9' junction='-1'/></OpenDRIVE>",
         "bare.xodr: netconvert refuses it: "},
        {"cut.xodr", "<OpenDRIVE>\n<road id='1'", "cut.xodr:2: is not an OpenDRIVE map"},
        {"cut.osm", cut, "cut.osm: is not as OpenStreetMap writes it: XML parsing error at line"},
        {"noroads.osm",
         "<osm version='0.6'><node id='1' lat='1' lon='1'/></osm>",
         "noroads.osm: netconvert refuses it: No nodes loaded: it has no roads"},
        {"path.osm",
         "<osm version='0.6'><node id='1' lat='1' lon='1'/><node id='2' lat='1.001' lon='1'/>"
         "<way id='5'><nd ref='1'/><nd ref='2'/><tag k='highway' v='footway'/></way></osm>",
         "path.osm: what came out of it is no town: has no edge that a passenger car may use"},
        {"far.xodr",
         "<OpenDRIVE>\n<road id='1' length='1e7'/></OpenDRIVE>",
         "far.xodr:2: <road>: length=\"1e7\" is not a number up to 100000"},
        {"nan.xodr",
         "<OpenDRIVE><road id='1' length='9'><planView><geometry s='nan'/></planView></road>"
         "</OpenDRIVE>",
         "<geometry>: s=\"nan\" is not a number"},
        {"deep.xodr", deep, "elements are nested more than 1000 deep"},
        {"wide.net.xml", wide, "<lane>: width=\"1000\" is more than 100 m"},
        {"cut.osm.gz", "\x1f\x8b\x08 and no more", "cut.osm.gz: is damaged or cut off"},
    };
    for (const Case& one : cases) {
        const std::string said = message({write(one.name, one.text), "", false, false});
        EXPECT_THAT(said, HasSubstr(one.said)) << one.name;
        EXPECT_THAT(said, Not(HasSubstr("\n"))) << one.name;
        fs::remove_all(folder_ / "refused");
    }
    EXPECT_THAT(message({folder_, "", false, false}), HasSubstr("is a folder"));
    fs::remove_all(folder_ / "refused");
    EXPECT_THAT(message({folder_ / "none.osm", "", false, false}),
                HasSubstr("none.osm: no such file"));
    fs::remove_all(folder_ / "refused");
    const fs::path own = fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns/town2/town2.net.xml";
    EXPECT_THAT(message({own, "", true, false}), HasSubstr("--lefthand is for OpenStreetMap"));
}

TEST_F(Imports, NetworksThatOnlyANewerSumoLoadsAreRefusedWithSumosReason) {
    struct Case {
        const char* name;
        const char* from;  ///< what 1.15 writes
        const char* to;
        const char* said;
    };

    const Case cases[] = {
        {"major.net.xml", "<net version=\"1.9\"", "<net version=\"2.3\"", "is too new: SUMO's"},
        {"lights.net.xml",
         "type=\"static\"",
         "type=\"quantum\"",
         "lights.net.xml: sumo refuses it: Traffic light "},
        {"turn.net.xml",
         "dir=\"s\"",
         "dir=\"q\"",
         "sumo refuses it: Unrecognised link direction 'q'"},
    };
    const std::string text =
        bytes(fs::path(REPRISE_SOURCE_DIR) / "scenarios/towns/town2/town2.net.xml");
    for (const Case& one : cases) {
        std::string newer = text;
        const std::size_t at = newer.find(one.from);
        ASSERT_NE(at, std::string::npos) << one.name;
        newer.replace(at, std::string(one.from).size(), one.to);
        const std::string said = message({write(one.name, newer), "", false, false});
        EXPECT_THAT(said, HasSubstr(one.said)) << one.name;
        EXPECT_THAT(said, Not(HasSubstr("\n"))) << one.name;
        fs::remove_all(folder_ / "refused");
    }
}

TEST_F(Imports, HugeGarbageIsRefusedBeforeItIsRead) {
    for (const char* beginning : {"", "<osm version='0.6'>\n", "<OpenDRIVE>"}) {
        const fs::path path = write("big.osm", beginning);
        fs::resize_file(path, std::uintmax_t{3} << 30);  // sparse
        EXPECT_THAT(message({path, "", false, false}),
                    testing::AnyOf(HasSubstr("is not XML"), HasSubstr("has 3072 MB")));
        fs::remove_all(folder_ / "refused");
    }
}

}  // namespace
}  // namespace reprise::towns
