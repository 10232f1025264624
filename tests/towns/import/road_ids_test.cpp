#include "towns/import/road_ids.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/towns/import/imports.h"
#include "towns/network/network.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/lanes/road_place.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

using Eigen::Vector2d;
using ::testing::HasSubstr;
using world::RoadPlace;

constexpr double pi = std::numbers::pi;

/// One after the other: road 1 goes 100 m east; road 2 is the bend to the north behind it, drawn
/// backwards; road 3 goes 40 m north, bends right, goes 60 m east. A lane of 3.5 m each way.
std::string bends() {
    const std::string lanes = R"(<lanes><laneSection s="0">
      <left><lane id="1" type="driving" level="false"><link>{0}</link><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></left>
      <center><lane id="0" type="none" level="false"/></center>
      <right><lane id="-1" type="driving" level="false"><link>{1}</link><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></right>
    </laneSection></lanes>)";
    const auto with = [&](const std::string& left, const std::string& right) {
        return fmt::format(fmt::runtime(lanes), left, right);
    };
    return R"(<?xml version="1.0"?>
<OpenDRIVE><header revMajor="1" revMinor="4" name="bends" north="100" south="0" east="210" west="0"/>
<road name="" length="100" id="1" junction="-1">
  <link><successor elementType="road" elementId="2" contactPoint="end"/></link>
  <planView><geometry s="0" x="0" y="0" hdg="0" length="100"><line/></geometry></planView>)" +
           with(R"(<successor id="-1"/>)", R"(<successor id="1"/>)") + R"(</road>
<road name="" length="47.1238898" id="2" junction="-1">
  <link><predecessor elementType="road" elementId="3" contactPoint="start"/>
        <successor elementType="road" elementId="1" contactPoint="end"/></link>
  <planView><geometry s="0" x="130" y="30" hdg="-1.570796327" length="47.1238898"><arc curvature="-0.033333333333"/></geometry></planView>)" +
           with(R"(<predecessor id="-1"/><successor id="-1"/>)",
                R"(<predecessor id="1"/><successor id="1"/>)") +
           R"(</road>
<road name="" length="131.4159265" id="3" junction="-1">
  <link><predecessor elementType="road" elementId="2" contactPoint="start"/></link>
  <planView><geometry s="0" x="130" y="30" hdg="1.570796327" length="40"><line/></geometry>
    <geometry s="40" x="130" y="70" hdg="1.570796327" length="31.4159265"><arc curvature="-0.05"/></geometry>
    <geometry s="71.4159265" x="150" y="90" hdg="0" length="60"><line/></geometry></planView>)" +
           with(R"(<predecessor id="-1"/>)", R"(<predecessor id="1"/>)") + R"(</road>
</OpenDRIVE>
)";
}

/// Where that is, worked out by hand from the picture above: the middle of lane 1 lies 1.75 m left
/// of the reference line.
Vector2d by_hand(const RoadPlace& place) {
    const double t = place.lane * 1.75;
    if (place.road == "1")
        return {place.s, t};
    if (place.road == "2") {  // clockwise about (100, 30), from due east to due south
        const double angle = -place.s / 30;
        return Vector2d(100, 30) + (30 + t) * Vector2d(std::cos(angle), std::sin(angle));
    }
    if (place.s <= 40)
        return {130 - t, 30 + place.s};
    const double bend = 10 * pi;
    if (place.s <= 40 + bend) {  // clockwise about (150, 70), from due west to due north
        const double angle = pi - (place.s - 40) / 20;
        return Vector2d(150, 70) + (20 + t) * Vector2d(std::cos(angle), std::sin(angle));
    }
    return {150 + place.s - 40 - bend, 90 + t};
}

Vector2d offset_in(const std::string& network) {
    const std::size_t at = network.find("netOffset=\"") + 11;
    const std::size_t comma = network.find(',', at);
    return {std::stod(network.substr(at)), std::stod(network.substr(comma + 1))};
}

TEST_F(Imports, EveryLaneKnowsItsRoadAndWhereAlongItItLies) {
    const auto map = write("bends.xodr", bends());
    EXPECT_THAT(import_town({map, "", false, false}, empty("t")),
                HasSubstr("road ids: 2 lanes know their road"));
    const Network network = load_network(folder_ / "t/bends.net.xml");
    const world::TownT town = read_town(network);
    const Vector2d offset = offset_in(network.xml);
    int places = 0;
    for (const auto& [road, length] :
         {std::pair("1", 100.0), std::pair("2", 15 * pi), std::pair("3", 100 + 10 * pi)})
        for (const int lane : {-1, 1})
            for (double s = 1; s < length - 1; s += 7.3, ++places) {
                const RoadPlace place{road, lane, s};
                SCOPED_TRACE(fmt::format("road {} lane {} s {}", road, lane, s));
                const auto found = world::find_road_place(town, place);
                ASSERT_TRUE(found);
                const Eigen::Vector3d p =
                    world::point_at(town.lanes[found->lane], found->s).position;
                EXPECT_LT((Vector2d(p.x(), p.y()) - offset - by_hand(place)).norm(), 0.3);
                const auto back = world::road_place(town.lanes[found->lane], found->s);
                ASSERT_TRUE(back);
                EXPECT_EQ(back->road, road);
                EXPECT_EQ(back->lane, lane);
                EXPECT_NEAR(back->s, s, 0.02);
            }
    EXPECT_GT(places, 60);
}

TEST_F(Imports, SaysWhatThereIsOfARoad) {
    const auto map = write("bends.xodr", bends());
    import_town({map, "", false, false}, empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/bends.net.xml"));
    const auto message = [&](const RoadPlace& place) -> std::string {
        try {
            world::road_place_named(town, place);
        } catch (const world::Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_EQ(message({"7", -1, 3}), "no road '7' in bends (did you mean '1'?)");
    EXPECT_EQ(message({"1", -2, 3}), "road '1' of bends has no lane -2; there are -1, 1");
    EXPECT_THAT(message({"1", -1, 300}), HasSubstr("no lane at s = 300.00 of road '1', lane -1: "));
}

/// By the map's own geometry: the reference line's pose, and half the lanes' widths beside it.
TEST_F(Imports, TheRoadsOfARealMapLieWhereItSays) {
    for (const char* name : {"Town01.xodr", "Town07.xodr"}) {
        const auto file = test::real_map(name);
        if (!std::filesystem::exists(file))
            GTEST_SKIP() << test::missing_map(file);
        import_town({file, "real", false, false}, empty(name));
        const Network network = load_network(folder_ / name / "real.net.xml");
        const world::TownT town = read_town(network);
        const OpenDrive map = read_opendrive(bytes(file), name);
        const Vector2d offset = offset_of(map, read_roads(network.xml, name));
        int places = 0, lanes = 0, off = 0;
        for (const world::LaneT& lane : town.lanes) {
            if (lane.kind != world::LaneKind::driving)
                continue;
            ++lanes;
            ASSERT_FALSE(lane.road.empty()) << lane.name;
            for (double s = 2; s < lane.length - 2; s += 5, ++places) {
                // Straight across from the reference line at that s lies our point.
                const auto place = world::road_place(lane, s);
                const RoadPose pose = map.roads.at(place->road).line.at(place->s);
                const Eigen::Vector3d p = world::point_at(lane, s).position;
                const Vector2d apart = Vector2d(p.x(), p.y()) - offset - pose.position;
                const Vector2d along(std::cos(pose.heading), std::sin(pose.heading));
                off += std::abs(apart.dot(along)) > 0.3 ? 1 : 0;
                EXPECT_LT(apart.norm(), 30) << lane.name << " at " << s;
            }
        }
        EXPECT_GT(places, 500) << name;
        EXPECT_LT(off, places / 50) << name << ": of " << places << " on " << lanes << " lanes";
    }
}

}  // namespace
}  // namespace reprise::towns
