// Lights, signs, limits and bridges of a map stand where it has them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "process/program.h"
#include "tests/support/towns.h"
#include "tests/towns/import/imports.h"
#include "towns/import/right_of_way.h"
#include "towns/import/signal_sites.h"
#include "towns/network/place.h"
#include "world/frames.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using world::LaneKind;

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

}  // namespace
}  // namespace reprise::towns
