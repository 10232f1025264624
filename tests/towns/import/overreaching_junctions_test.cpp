// Junctions that reach over the next one, and what becomes of them.
#include "towns/import/overreaching_junctions.h"

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
using ::testing::Not;

/// From the west to the east through three junctions: the road in the middle begins in `begin` and
/// ends in `end`; the first one ends in 100.
std::string road(const std::string& second, double begin, double end) {
    const auto edge = [](const char* id,
                         const std::string& from,
                         const std::string& to,
                         double west,
                         double east) {
        return fmt::format(
            "<edge id='{}' from='{}' to='{}'><lane id='{}_0' length='{:.1f}' "
            "shape='{},0 {},0'/></edge>",
            id,
            from,
            to,
            id,
            std::max(0.2, east - west),
            west,
            east);
    };
    return "<net>" + edge("a", "1", second, 0, 100) + edge("b", second, "9", begin, end) +
           fmt::format("<edge id=':x'><lane id=':x_0' shape='100,0 {},0'/></edge>", begin) +
           "<connection from='a' to='b' fromLane='0' toLane='0' via=':x_0' dir='s'/></net>";
}

TEST(OverreachingJunctions, AreJoinedAcrossTheRoadThatHasNoRoom) {
    EXPECT_THAT(with_overreaching({}, road("5", 96, 96.2)), ElementsAre(ElementsAre("5", "9")));
    EXPECT_THAT(with_overreaching({{"7", "8"}}, road("5", 104, 120)),
                ElementsAre(ElementsAre("7", "8")))
        << "there is room";
}

TEST(OverreachingJunctions, TakeAllThatTheyWereMadeOfAlong) {
    const std::vector<JunctionIds> known{{"3", "4"}, {"5", "6", "61", "62", "63"}, {"8", "9"}};
    EXPECT_THAT(
        with_overreaching(known, road("cluster_5_6_61_62_#1more", 96, 96.2)),
        ElementsAre(ElementsAre("3", "4"), ElementsAre("5", "6", "61", "62", "63", "8", "9")));
    EXPECT_EQ(merges_in(known), 6U);
    EXPECT_EQ(with_overreaching(known, road("cluster_made_up", 96, 96.2)), known);
    EXPECT_EQ(read_joins(joins_xml(known)), known);
}

/// A road that forks at a sharp angle, and a footway that ends on it before both are apart.
TEST_F(Imports, NoRoadEndsBehindTheNextOnesBeginning) {
    StreetMap map;
    const Tagged street{{"highway", "secondary"}, {"lanes", "2"}}, foot{{"highway", "footway"}};
    const int fork = map.node(0, 0), zebra = map.node(17, 0, {{"highway", "crossing"}});
    map.way({map.node(-150, 0), fork, zebra, map.node(150, 0)}, street);
    map.way({fork, map.node(141, 51)}, street);
    map.way({map.node(17, -30), zebra}, foot);
    const std::string report =
        import_town({write("fork.osm", map.text()), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("junctions: 1 reached over the next one"));
    const world::TownT town = read_town(load_network(folder_ / "t/fork.net.xml"));
    int ways = 0;
    for (const world::LaneT& lane : town.lanes)
        for (const world::Link& link : lane.links) {
            if (!world::is_for_cars(lane) || link.via() == world::none ||
                link.turn() == world::Turn::around)
                continue;
            const world::LaneT& via = town.lanes[link.via()];
            const double turned =
                world::point_at(via, 0).yaw - world::point_at(lane, lane.length).yaw;
            EXPECT_GT(std::cos(turned), -0.5) << lane.name << " to " << via.name;
            ++ways;
        }
    EXPECT_GE(ways, 6);
}

}  // namespace
}  // namespace reprise::towns
