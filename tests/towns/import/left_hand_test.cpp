// Maps of countries that drive on the left: OpenDRIVE's rule="LHT".
#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include "tests/towns/import/imports.h"
#include "towns/import/signal_sites.h"
#include "towns/maps/opendrive.h"
#include "towns/network/place.h"
#include "towns/town_reader.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/lanes/road_place.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using ::testing::HasSubstr;
using world::LaneKind;

/// 60 m straight on and a bend to the left, with unlike sides: to the left of the reference line
/// (0.5 m to the left of it, as the offset says) a lane of 5 m, to its right one of 3 m. A stop
/// sign for those who drive along it.
std::string road(const std::string& id, const std::string& rule) {
    return "<road id='" + id + "' length='140' junction='-1'" + rule +
           R"(><planView><geometry s='0' x='10' y='30' hdg='0.3' length='60'><line/></geometry>
<geometry s='60' x='67.32' y='47.73' hdg='0.3' length='80'><arc curvature='0.01'/></geometry></planView>
<lanes><laneOffset s='0' a='0.5' b='0' c='0' d='0'/><laneSection s='0'>
<left><lane id='2' type='sidewalk'><width sOffset='0' a='2' b='0' c='0' d='0'/></lane>
<lane id='1' type='driving'><width sOffset='0' a='5' b='0' c='0' d='0'/></lane></left>
<center><lane id='0' type='none'/></center>
<right><lane id='-1' type='driving'><width sOffset='0' a='3' b='0' c='0' d='0'/></lane>
<lane id='-2' type='sidewalk'><width sOffset='0' a='2' b='0' c='0' d='0'/></lane></right></laneSection></lanes>
<signals><signal id='9' s='130' t='9' zOffset='0' name='Sign_Stop' type='206' orientation='+'
height='1' dynamic='no'/></signals></road>)";
}

std::string map_of(const std::string& roads) {
    return "<?xml version='1.0'?>\n<OpenDRIVE>\n<header revMajor='1' revMinor='4'/>\n" + roads +
           "</OpenDRIVE>\n";
}

struct Lane {
    double width, t;
    int number;
    double sign;  ///< of its direction along the reference line
};

TEST_F(Imports, LeftHandLanesLieWhereTheMapHasThem) {
    import_town({write("left.xodr", map_of(road("1", " rule='LHT'"))), "", false, false},
                empty("t"));
    const std::string network = bytes(folder_ / "t/left.net.xml");
    const world::TownT town = read_town(load_network(folder_ / "t/left.net.xml"));
    EXPECT_TRUE(town.left_hand);
    // The reference line, out of the map as it was written.
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(road("1", "").c_str()));
    const ReferenceLine line(document.child("road").child("planView"));
    const Vector2d offset = read_roads(network, "left").offset;

    for (const Lane& expected : {Lane{5, 3, 1, 1}, Lane{3, -1, -1, -1}}) {
        const world::LaneT* found = nullptr;
        for (const world::LaneT& lane : town.lanes)
            if (lane.kind == LaneKind::driving && std::abs(lane.width - expected.width) < 0.01)
                found = &lane;
        ASSERT_TRUE(found) << expected.width;
        for (const double s : {20.0, 50.0, 80.0, 110.0}) {
            const RoadPose pose = line.at(s);
            const Vector2d place =
                pose.position + expected.t * world::left_of(pose.heading) + offset;
            const auto on = world::project(*found, {place.x(), place.y(), 0});
            EXPECT_LT(on.distance, 0.1) << expected.width << " m at " << s;
            const double yaw = world::point_at(*found, on.s).yaw;
            EXPECT_GT(expected.sign * std::cos(yaw - pose.heading), 0.98);
        }
        const auto pieces = world::road_pieces(*found);
        ASSERT_EQ(pieces.size(), 1U);
        EXPECT_EQ(pieces[0].lane, expected.number);
    }

    const Place place = read_place(bytes(folder_ / "t/left.place.xml"), "left.place.xml");
    ASSERT_EQ(place.signs.size(), 1U);
    const RoadPose at_sign = line.at(130);
    const Vector2d foot = at_sign.position + 9 * world::left_of(at_sign.heading) + offset;
    EXPECT_LT((world::in_plan(place.signs[0].position()) - foot).norm(), 0.1);
    EXPECT_GT(std::cos(place.signs[0].yaw() - at_sign.heading), 0.99);
}

TEST_F(Imports, LanesOfLeftHandRoadsLieBesideEachOther) {
    import_town({write("left.xodr", map_of(road("1", " rule='LHT'"))), "", false, false},
                empty("t"));
    const world::TownT town = read_town(load_network(folder_ / "t/left.net.xml"));
    double covered = 0;
    for (const world::LaneT& one : town.lanes)
        for (const world::LaneT& other : town.lanes)
            if (one.name < other.name && one.name.front() != ':' && other.name.front() != ':')
                for (double s = 5; s < one.length - 5; s += 5) {
                    const auto on = world::project(other, world::point_at(one, s).position);
                    covered += on.distance < (one.width + other.width) / 2 - 0.2 ? 5 : 0;
                }
    EXPECT_EQ(covered, 0) << "lanes lie beside each other";
}

TEST_F(Imports, AMapThatDrivesOnBothSidesIsRefused) {
    const fs::path map =
        write("both.xodr", map_of(road("1", " rule='LHT'") + "\n" + road("2", " rule='RHT'")));
    EXPECT_THAT(message({map, "", false, false}),
                HasSubstr("both.xodr:14: <road id=\"2\">: traffic drives on the right here, and on "
                          "the left on road '1'"));
}

}  // namespace
}  // namespace reprise::towns
