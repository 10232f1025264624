#include "towns/town_reader.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"

namespace reprise::towns {
namespace {

using test::lane;
using test::own_town;
using world::LaneKind;
using world::LaneT;
using world::none;
using world::TownT;

double apart(const world::Vec3& p, const world::Vec3& q) {
    return std::hypot(p.x() - q.x(), p.y() - q.y(), p.z() - q.z());
}

class OwnTowns : public ::testing::TestWithParam<const char*> {
  protected:
    const TownT& town() const { return own_town(GetParam()).town; }
};

INSTANTIATE_TEST_SUITE_P(Towns, OwnTowns, ::testing::Values("town1", "town2"));

TEST_P(OwnTowns, EveryDrivingLaneLeadsOn) {
    for (const LaneT& one : town().lanes)
        if (one.kind == LaneKind::driving) {
            EXPECT_FALSE(one.links.empty()) << one.name;
        }
}

TEST_P(OwnTowns, LinkChainsAreConnectedOnTheGround) {
    int walked = 0;
    for (const LaneT& start : town().lanes) {
        if (start.kind != LaneKind::driving)
            continue;
        for (const world::Link& way : start.links) {
            // Lane -> internal lanes -> lane behind the junction, by following `via` only.
            const LaneT* here = &start;
            const world::Link* link = &way;
            int hops = 0;
            while (link->via() != none) {
                const LaneT& next = town().lanes[link->via()];
                EXPECT_LT(apart(here->centre.back(), next.centre.front()), 0.3) << next.name;
                EXPECT_EQ(next.kind, LaneKind::internal);
                ASSERT_EQ(next.links.size(), 1U) << next.name;
                here = &next;
                link = &next.links.front();
                ASSERT_LT(++hops, 5) << start.name;
            }
            EXPECT_EQ(link->to(), way.to());
            EXPECT_LT(apart(here->centre.back(), town().lanes[way.to()].centre.front()), 0.3);
            EXPECT_GT(hops, 0);
            ++walked;
        }
    }
    EXPECT_GE(walked, 48);
}

TEST_P(OwnTowns, NamesAreSortedSoThatTheyCanBeFound) {
    const TownT& one = town();
    const auto by_name = [](const auto& p, const auto& q) { return p.name < q.name; };
    EXPECT_TRUE(std::is_sorted(one.lanes.begin(), one.lanes.end(), by_name));
    EXPECT_TRUE(std::is_sorted(one.junctions.begin(), one.junctions.end(), by_name));
    for (std::uint32_t i = 0; i < one.lanes.size(); ++i)
        EXPECT_EQ(world::find_lane(one, one.lanes[i].name), i);
}

TEST_P(OwnTowns, SignalsStandAtTheLanesThatTheyFace) {
    const TownT& one = town();
    std::set<std::pair<std::string, std::uint32_t>> keys;
    for (const world::SignalT& signal : one.signals) {
        EXPECT_TRUE(keys.emplace(signal.program, signal.index).second) << signal.program;
        ASSERT_NE(signal.lane, none);
        const LaneT& faced = one.lanes[signal.lane];
        EXPECT_EQ(faced.kind, signal.for_walkers ? LaneKind::crossing : LaneKind::driving);
        EXPECT_LT(
            apart(signal.position, signal.for_walkers ? faced.centre.front() : faced.centre.back()),
            1e-9);
    }
    EXPECT_TRUE(
        std::is_sorted(one.signals.begin(), one.signals.end(), [](const auto& p, const auto& q) {
            return std::pair(p.program, p.index) < std::pair(q.program, q.index);
        }));
    // A lane that ends at lights has a signal on every link, others have none.
    for (const LaneT& each : one.lanes)
        if (each.kind == LaneKind::driving) {
            for (const world::Link& link : each.links)
                EXPECT_EQ(link.signal() != none, one.junctions[each.junction].lit) << each.name;
        }
}

TEST_P(OwnTowns, NeighboursAgreeOnEachOther) {
    const TownT& one = town();
    for (std::uint32_t i = 0; i < one.lanes.size(); ++i) {
        const LaneT& each = one.lanes[i];
        if (each.left != none) {
            EXPECT_EQ(one.lanes[each.left].right, i);
        }
        if (each.opposite != none) {
            EXPECT_EQ(one.lanes[each.opposite].opposite, i) << each.name;
        }
        // The leftmost lane touches the oncoming one, but in the roundabout nobody comes towards
        // us.
        const bool one_way = each.speed_limit < 9 && each.width > 4;
        if (each.kind == LaneKind::driving && !one_way) {
            EXPECT_EQ(each.left == none, each.opposite != none) << each.name;
        }
        // SUMO gives all lanes of a road, and both directions of it, one length.
        if (each.kind == LaneKind::driving) {
            EXPECT_NEAR(each.length, each.sumo_length, 9) << each.name;
        }
    }
}

TEST_P(OwnTowns, EqualBytesGiveEqualTowns) {
    EXPECT_EQ(read_town(own_town(GetParam()).network), town());
}

TEST(TownReader, Town1IsAsPlanned) {
    const TownT& town = own_town("town1").town;
    EXPECT_EQ(town.junctions.size(), 19U);
    EXPECT_EQ(std::count_if(town.junctions.begin(),
                            town.junctions.end(),
                            [](const auto& junction) { return junction.lit; }),
              9);
    // 8 avenues of 2 lanes and 17 streets of 1, both ways, and the roundabout.
    const auto driving = std::count_if(town.lanes.begin(), town.lanes.end(), [](const LaneT& one) {
        return one.kind == LaneKind::driving;
    });
    EXPECT_EQ(driving, 8 * 4 + 17 * 2 + 4);
    EXPECT_FALSE(town.left_hand);
    EXPECT_NEAR(town.low.x(), -9.5, 0.1);
    EXPECT_NEAR(town.high.x(), 421 + 9.5, 0.1);
}

TEST(TownReader, LanesKnowTheirStreet) {
    const TownT& town = own_town("town1").town;
    EXPECT_EQ(town.lanes[world::find_lane(town, "a1_m1_1").value()].street, "Bridge Street");
    for (const LaneT& lane : town.lanes)
        EXPECT_EQ(lane.street.empty(), lane.edge.front() == ':') << lane.name;
}

TEST(TownReader, NeighboursLieOnTheSideTheyAreNamedAfter) {
    const TownT& town = own_town("town1").town;
    const LaneT& right = town.lanes[lane(town, "b1_b2_1")];  // eastwards: left is north
    const LaneT& left = town.lanes[lane(town, "b1_b2_2")];
    EXPECT_EQ(right.left, lane(town, "b1_b2_2"));
    EXPECT_EQ(right.right, none) << "the sidewalk is no neighbour";
    EXPECT_GT(left.centre.front().y(), right.centre.front().y());
    EXPECT_EQ(left.opposite, lane(town, "b2_b1_2"));
}

TEST(TownReader, TurnsAndPrioritiesAreThoseOfTheNetwork) {
    const TownT& town = own_town("town1").town;
    const LaneT& street = town.lanes[lane(town, "a1_b1_1")];  // southwards onto the avenue
    ASSERT_EQ(street.links.size(), 2U);
    std::set<world::Turn> turns;
    for (const world::Link& link : street.links) {
        turns.insert(link.turn());
        EXPECT_EQ(town.signals[link.signal()].program, "b1");
    }
    EXPECT_EQ(turns, (std::set{world::Turn::left, world::Turn::right}));
    // An unlit junction: who comes from the side street yields.
    for (const world::Link& link : town.lanes[lane(town, "m2n_t2_1")].links)
        EXPECT_TRUE(link.yields());
}

TEST(TownReader, OutlinesAreCounterClockwise) {
    const TownT& town = own_town("town1").town;
    for (const LaneT& one : town.lanes) {
        if (one.kind != LaneKind::walking_area && one.kind != LaneKind::crossing) {
            EXPECT_TRUE(one.outline.empty());
            continue;
        }
        ASSERT_GE(one.outline.size(), 3U) << one.name;
        double area = 0;
        for (std::size_t i = 0; i < one.outline.size(); ++i) {
            const world::Vec3& p = one.outline[i];
            const world::Vec3& q = one.outline[(i + 1) % one.outline.size()];
            area += p.x() * q.y() - q.x() * p.y();
        }
        EXPECT_GT(area, 0) << one.name;
        if (one.kind == LaneKind::crossing) {
            EXPECT_NEAR(area / 2, one.width * one.length, 0.01) << one.name;
        }
    }
}

/// The smallest network that has what the test is about.
Network two_roads(const std::string& net_attributes,
                  const std::string& first,
                  const std::string& second) {
    return {"tiny",
            "<net version=\"1.9\"" + net_attributes + ">" +
                "<edge id=\"out\" from=\"A\" to=\"B\">" + first + "</edge>" +
                "<edge id=\"back\" from=\"B\" to=\"A\">" + second + "</edge>" +
                "<junction id=\"A\" type=\"dead_end\" x=\"0\" y=\"0\" shape=\"\"/>" +
                "<junction id=\"B\" type=\"dead_end\" x=\"100\" y=\"0\" shape=\"\"/></net>",
            ""};
}

TEST(TownReader, FindsTheOppositeLaneWithoutNeigh) {
    const Network touching =
        two_roads("",
                  R"(<lane id="out_0" index="0" speed="9" length="100" shape="0,-1.6 100,-1.6"/>)",
                  R"(<lane id="back_0" index="0" speed="9" length="100" shape="100,1.6 0,1.6"/>)");
    const TownT town = read_town(touching);
    EXPECT_EQ(town.lanes[lane(town, "out_0")].opposite, lane(town, "back_0"));
    EXPECT_EQ(town.lanes[lane(town, "out_0")].width, 3.2) << "SUMO's default";
    EXPECT_EQ(town.lanes[lane(town, "out_0")].junction, 1U);

    const Network apart_by_a_meadow =
        two_roads("",
                  R"(<lane id="out_0" index="0" speed="9" length="100" shape="0,-9 100,-9"/>)",
                  R"(<lane id="back_0" index="0" speed="9" length="100" shape="100,9 0,9"/>)");
    EXPECT_EQ(read_town(apart_by_a_meadow).lanes[0].opposite, none);
}

TEST(TownReader, LeftHandTrafficHasItsNeighboursMirrored) {
    const Network left_hand = two_roads(
        " lefthand=\"true\"",
        R"(<lane id="out_0" index="0" speed="9" length="100" shape="0,4.8 100,4.8"/>)"
        R"(<lane id="out_1" index="1" speed="9" length="100" shape="0,1.6 100,1.6"/>)",
        R"(<lane id="back_0" index="0" speed="9" length="100" shape="100,-1.6 0,-1.6"/>)");
    const TownT town = read_town(left_hand);
    EXPECT_TRUE(town.left_hand);
    EXPECT_EQ(town.lanes[lane(town, "out_0")].right, lane(town, "out_1"));
    EXPECT_EQ(town.lanes[lane(town, "out_0")].left, none);
    EXPECT_EQ(town.lanes[lane(town, "out_1")].opposite, lane(town, "back_0"));
}

TEST(TownReader, NoGrassGrowsBetweenTheLanesOfARoad) {
    // SUMO once drew lanes of 3.2 m every 3.3 m. A metre between them is meant.
    const auto widths = [](double spacing) {
        std::string lanes;
        for (int i = 0; i < 3; ++i)
            lanes += "<lane id='a_" + std::to_string(i) + "' index='" + std::to_string(i) +
                     "' speed='14' length='100' shape='0," + std::to_string(i * spacing) + " 100," +
                     std::to_string(i * spacing) + "'/>";
        const TownT town = read_town(
            {"slit", "<net><edge id='a' from='b' to='c'>" + lanes + "</edge></net>", "", ""});
        return std::vector<double>{town.lanes[0].width, town.lanes[1].width, town.lanes[2].width};
    };
    for (const double width : widths(3.3))
        EXPECT_NEAR(width, 3.3, 1e-9);
    for (const double spacing : {3.2, 4.2})
        for (const double width : widths(spacing))
            EXPECT_EQ(width, 3.2) << spacing;
}

TEST(TownReader, LanesOfNoLengthHaveTwoPointsAllTheSame) {
    const TownT town = read_town(
        two_roads("",
                  R"(<lane id="out_0" index="0" speed="9" length="0.1" shape="5,5 5,5"/>)",
                  R"(<lane id="back_0" index="0" speed="9" length="100" shape="100,0 0,0"/>)"));
    const LaneT& tiny = town.lanes[lane(town, "out_0")];
    EXPECT_EQ(tiny.centre.size(), 2U);
    EXPECT_GT(tiny.length, 0);
}

TEST(TownReader, KindsFollowWhoMayUseTheLane) {
    const TownT town = read_town(two_roads(
        "",
        R"(<lane id="out_0" index="0" allow="pedestrian" speed="9" length="100" shape="0,-5 100,-5"/>)"
        R"(<lane id="out_1" index="1" allow="bicycle" speed="9" length="100" shape="0,-3 100,-3"/>)"
        R"(<lane id="out_2" index="2" allow="bus" speed="9" length="100" shape="0,-1 100,-1"/>)",
        R"(<lane id="back_0" index="0" disallow="pedestrian" speed="9" length="100" shape="100,1 0,1"/>)"
        R"(<lane id="back_1" index="1" allow="rail" speed="9" length="100" shape="100,3 0,3"/>)"));
    EXPECT_EQ(town.lanes[lane(town, "out_0")].kind, LaneKind::sidewalk);
    EXPECT_EQ(town.lanes[lane(town, "out_1")].kind, LaneKind::other);
    EXPECT_EQ(town.lanes[lane(town, "out_2")].kind, LaneKind::other);
    EXPECT_EQ(town.lanes[lane(town, "back_0")].kind, LaneKind::driving);
    EXPECT_EQ(town.lanes[lane(town, "back_1")].kind, LaneKind::other);
}

}  // namespace
}  // namespace reprise::towns
