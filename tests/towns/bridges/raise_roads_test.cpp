#include "towns/bridges/raise_roads.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <string>
#include <unistd.h>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/mesh/ground_probe.h"
#include "tests/towns/street_map.h"
#include "towns/bridges/guessed_bridges.h"
#include "towns/bridges/height_faults.h"
#include "towns/bridges/height_profile.h"
#include "towns/check/furniture_check.h"
#include "towns/check/ground_check.h"
#include "towns/check/walk_check.h"
#include "towns/import/town_import.h"
#include "towns/town_reader.h"
#include "walkers/map/walk_map.h"
#include "world/frames.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;
using ::testing::HasSubstr;

/// A motorway from west to east; Hill Road from south to north over (or under) it, whose middle
/// part has `tags`; a slip road from one to the other; Side Street, which leaves Hill Road 30 m
/// behind the bridge.
std::string interchange(Tagged tags) {
    StreetMap map;
    const int west = map.node(-400, 0), slip = map.node(-150, 0), east = map.node(400, 0);
    const int south = map.node(0, -300), fork = map.node(0, -160), foot = map.node(0, -30);
    const int end = map.node(0, 30), side = map.node(0, 60), north = map.node(0, 300);
    map.way({west, slip, east}, {{"highway", "motorway"}, {"oneway", "yes"}, {"lanes", "2"}});
    map.way({slip, map.node(-60, -110), fork}, {{"highway", "motorway_link"}, {"oneway", "yes"}});
    const Tagged hill{{"highway", "secondary"}, {"name", "Hill Road"}};
    map.way({south, fork, foot}, hill);
    tags.insert(tags.end(), hill.begin(), hill.end());
    map.way({foot, end}, tags);
    map.way({end, side, north}, hill);
    map.way({side, map.node(120, 60)}, {{"highway", "residential"}, {"name", "Side Street"}});
    return map.text();
}

class RaiseRoads : public ::testing::Test {
  protected:
    RaiseRoads()
        : folder_(fs::path(::testing::TempDir()) / ("raise roads " + std::to_string(getpid()))) {
        fs::create_directories(folder_ / "t");
    }

    ~RaiseRoads() override { fs::remove_all(folder_); }

    world::TownT import(const std::string& map) {
        std::ofstream(folder_ / "hill.osm") << map;
        report_ = import_town({folder_ / "hill.osm", "", false, false}, folder_ / "t");
        Network network = load_network(folder_ / "t/hill.net.xml");
        network_ = network.xml;
        return read_town(network);
    }

    fs::path folder_;
    std::string report_, network_;
};

bool is_motorway(const world::LaneT& lane) {
    return lane.kind == world::LaneKind::driving && lane.speed_limit > 20;
}

/// Where Hill Road and the motorway cross, on a lane of both.
Vector2d crossing(const world::TownT& town) {
    for (const world::LaneT& over : town.lanes)
        for (const world::LaneT& under : town.lanes)
            if (over.kind == world::LaneKind::driving && !is_motorway(over) && is_motorway(under))
                for (double s = 0; s < over.length; s += 0.1) {
                    const Vector2d place = world::point_at(over, s).position.head<2>();
                    const auto on = world::project(under, {place.x(), place.y(), 0});
                    if (on.distance < 0.2 && on.s > 20 && on.s < under.length - 20)
                        return place;
                }
    ADD_FAILURE() << "the roads do not cross";
    return Vector2d::Zero();
}

double steepest_lane(const world::TownT& town) {
    double most = 0;
    for (const world::LaneT& lane : town.lanes) {
        std::vector<Vector3d> line;
        for (const world::Vec3& p : lane.centre)
            line.push_back(world::to_eigen(p));
        most = std::max(most, steepest(line));
    }
    return most;
}

double height_of_street(const world::TownT& town, const Vector2d& near) {
    double nearest = 1e9;
    double height = 0;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind == world::LaneKind::driving) {
            const auto on = world::project(lane, {near.x(), near.y(), 0});
            const Vector3d p = world::point_at(lane, on.s).position;
            if (const double distance = (p.head<2>() - near).norm(); distance < nearest) {
                nearest = distance;
                height = p.z();
            }
        }
    EXPECT_LT(nearest, 10);
    return height;
}

TEST_F(RaiseRoads, CarsPassOverAndUnderAtOnePlace) {
    const world::TownT town = import(interchange({{"bridge", "yes"}, {"layer", "1"}}));
    const ground::GroundMesh ground = ground::build_ground(town);
    const ground::GroundProbe probe(ground);
    const Vector2d place = crossing(town);
    const auto deck = probe.below({place.x(), place.y(), 100});
    const auto road = probe.below({place.x(), place.y(), 4.5});
    ASSERT_TRUE(deck && road);
    EXPECT_NEAR(deck->z, 6, 0.01);
    EXPECT_EQ(deck->surface, ground::Surface::road);
    EXPECT_NEAR(road->z, 0, 0.01) << "and nothing hangs lower than a lorry is high";
    EXPECT_EQ(road->surface, ground::Surface::road);
    for (const towns::Criterion& criterion : towns::check_ground(town, ground))
        EXPECT_TRUE(criterion.passed()) << criterion.name << ": " << criterion.figure;
    EXPECT_THAT(report_, HasSubstr("1 place where a road passes over another"));
}

/// Networks that others made of maps have mostly lost all heights, and which way a road was.
TEST_F(RaiseRoads, WhereRoadsOfAFlatNetworkCrossWithoutAJunctionOneIsABridge) {
    import(interchange({}));
    EXPECT_FALSE(guess_bridges(network_).ways.empty());
    std::ofstream(folder_ / "t/hill.net.xml")
        << std::regex_replace(network_, std::regex("<param key=\"origId\"[^>]*>"), "");
    fs::create_directories(folder_ / "u");
    const std::string report =
        import_town({folder_ / "t/hill.net.xml", "", false, false}, folder_ / "u");
    EXPECT_THAT(report, HasSubstr("1 place where a road passes over another"));
    const Network network = load_network(folder_ / "u/hill.net.xml");
    EXPECT_EQ(network.xml.find("origId"), std::string::npos);
    const world::TownT town = read_town(network);
    const ground::GroundMesh ground = ground::build_ground(town);
    const Vector2d place = crossing(town);
    const auto deck = ground::GroundProbe(ground).below({place.x(), place.y(), 100});
    const auto road = ground::GroundProbe(ground).below({place.x(), place.y(), 4.5});
    ASSERT_TRUE(deck && road);
    EXPECT_NEAR(deck->z, 6, 0.01);
    EXPECT_NEAR(road->z, 0, 0.01) << "Hill Road runs to the north: it is the upper one";
    for (const world::LaneT& lane : town.lanes)
        if (is_motorway(lane)) {
            EXPECT_EQ(lane.centre.back().z(), 0) << lane.name;
        }
    EXPECT_TRUE(guess_bridges(network.xml).ways.empty()) << "it has heights now";
}

TEST_F(RaiseRoads, ABridgeOfAnotherSpeedBecomesATown) {
    // netconvert keeps the joins at its ends, each with a lane of no length.
    const world::TownT town =
        import(interchange({{"bridge", "yes"}, {"layer", "1"}, {"maxspeed", "70"}}));
    int joins = 0;
    for (const world::LaneT& lane : town.lanes)
        joins += lane.kind == world::LaneKind::internal && lane.sumo_length <= 0.1 &&
                         lane.centre.front().z() > 1
                     ? 1
                     : 0;
    EXPECT_GT(joins, 0);
    EXPECT_THAT(report_, HasSubstr("1 place where a road passes over another"));
}

TEST_F(RaiseRoads, RampsCanBeDriven) {
    const world::TownT town = import(interchange({{"bridge", "yes"}, {"layer", "1"}}));
    EXPECT_LT(steepest_lane(town), 0.1);
    EXPECT_GT(steepest_lane(town), 0.04);
    const Vector2d place = crossing(town);
    // Side Street leaves the ramp on its way down, and comes down to the ground by itself.
    const double corner = height_of_street(town, place + Vector2d(20, 60));
    EXPECT_GT(corner, 3);
    EXPECT_LT(corner, 6);
    EXPECT_LT(height_of_street(town, place + Vector2d(118, 60)), corner - 2);
    // Hill Road ends on the ground at both sides, and the motorway never leaves it.
    EXPECT_NEAR(height_of_street(town, place + Vector2d(0, 290)), 0, 0.01);
    EXPECT_NEAR(height_of_street(town, place - Vector2d(0, 290)), 0, 0.01);
    for (const world::LaneT& lane : town.lanes)
        for (const world::Vec3& p : lane.centre) {
            EXPECT_TRUE(!is_motorway(lane) || std::abs(p.z()) < 0.1) << lane.name;
        }
}

TEST_F(RaiseRoads, ALayerSaysOnlyWhoIsAbove) {
    const Vector2d north(0, 10);
    const world::TownT third = import(interchange({{"bridge", "viaduct"}, {"layer", "3"}}));
    EXPECT_NEAR(height_of_street(third, crossing(third) + north), 6, 0.01);
    const world::TownT silent = import(interchange({{"bridge", "yes"}}));
    EXPECT_NEAR(height_of_street(silent, crossing(silent) + north), 6, 0.01);
}

TEST_F(RaiseRoads, TunnelsGoDown) {
    const world::TownT town = import(interchange({{"tunnel", "yes"}, {"layer", "-1"}}));
    const Vector2d place = crossing(town);
    EXPECT_NEAR(height_of_street(town, place + Vector2d(0, 15)), -6, 0.01);
    const ground::GroundMesh ground = ground::build_ground(town);
    const ground::GroundProbe probe(ground);
    EXPECT_NEAR(probe.below({place.x(), place.y(), 100})->z, 0, 0.01);
    EXPECT_NEAR(probe.below({place.x(), place.y(), -1.5})->z, -6, 0.01);
    for (const towns::Criterion& criterion : towns::check_ground(town, ground))
        EXPECT_TRUE(criterion.passed()) << criterion.name << ": " << criterion.figure;
}

TEST_F(RaiseRoads, WhatCrossesNothingStaysFlat) {
    StreetMap map;
    const int south = map.node(0, -100), foot = map.node(0, -20), end = map.node(0, 20);
    map.way({south, foot}, {{"highway", "secondary"}});
    map.way({foot, end}, {{"highway", "secondary"}, {"bridge", "yes"}, {"layer", "1"}});
    map.way({end, map.node(0, 100)}, {{"highway", "secondary"}});
    map.way({south, map.node(100, -100), map.node(100, 0)}, {{"highway", "residential"}});
    const world::TownT town = import(map.text());
    EXPECT_EQ(town.high.z(), 0);
    EXPECT_THAT(report_, HasSubstr("1 way in the map; 0 places"));
}

/// A grid of streets with bridges and tunnels from corner to corner, much too near to others: over
/// streets, over each other, and along streets that they cross without a junction.
std::string crowded_city(unsigned seed) {
    std::mt19937 generator(seed);
    const auto draw = [&](unsigned most) { return static_cast<int>(generator() % most); };
    constexpr int side = 3, block = 90;
    StreetMap map;
    std::vector<int> corners;
    for (int i = 0; i < side * side; ++i)
        corners.push_back(map.node(i % side * block, i / side * block));
    for (int i = 0; i < side * side; ++i)
        for (const int next : {i + 1, i + side})
            if (next < side * side && (next == i + side || next % side != 0))
                map.way(
                    {corners[static_cast<std::size_t>(i)], corners[static_cast<std::size_t>(next)]},
                    {{"highway", "tertiary"}, {"sidewalk", draw(2) == 0 ? "both" : "no"}});
    for (int bridge = 0; bridge < 3; ++bridge) {
        const int column = draw(side), last = draw(side), start = 20 + draw(60);
        const int end = (side - 1) * block - 20 - draw(60);
        const int from = map.node(column * block + 15 + draw(60), start);
        const int to = map.node(last * block + 15 + draw(60), end);
        const Tagged street{{"highway", "secondary"}};
        const std::string layer = std::to_string(draw(2) == 0 ? 1 + draw(2) : -1);
        map.way({corners[static_cast<std::size_t>(column)], from}, street);
        map.way({from, to},
                {street[0], {layer == "-1" ? "tunnel" : "bridge", "yes"}, {"layer", layer}});
        map.way({to, corners[static_cast<std::size_t>(side * (side - 1) + last)]}, street);
    }
    return map.text();
}

/// All that `town check` asks for, but for reading twice.
std::vector<towns::Criterion> all_criteria(const world::TownT& town) {
    const ground::GroundMesh ground = ground::build_ground(town);
    std::vector<towns::Criterion> criteria = towns::check_ground(town, ground);
    criteria.push_back(check_walking(town, walkers::WalkMap(ground)));
    for (const towns::Criterion& criterion : towns::check_furniture(town))
        criteria.push_back(criterion);
    return criteria;
}

TEST_F(RaiseRoads, NoTownIsSpoiltByItsBridges) {
    for (const unsigned seed : {2U, 3U}) {
        const world::TownT town = import(crowded_city(seed));
        for (const towns::Criterion& criterion : all_criteria(town))
            EXPECT_TRUE(criterion.passed()) << seed << ": " << criterion.name;
        EXPECT_LT(steepest_lane(town), 0.15) << seed;
        EXPECT_THAT(report_, HasSubstr("flat: ")) << seed;
    }
}

TEST_F(RaiseRoads, OneOfTwoThatAreTooNearStaysFlat) {
    StreetMap map;
    const Tagged street{{"highway", "secondary"}};
    const Tagged bridge{street[0], {"bridge", "yes"}}, tunnel{street[0], {"tunnel", "yes"}};
    map.way({map.node(-300, 0), map.node(1200, 0)}, {{"highway", "primary"}});
    map.way({map.node(700, 90), map.node(1200, 90)}, {{"highway", "primary"}});
    for (const int east : {0, 800}) {
        const int foot = map.node(east, -30), top = map.node(east, 30);
        map.way({map.node(east, -300), foot}, street);
        map.way({foot, top}, bridge);
        // 30 m behind the second the street dives under the next road.
        const int entry = map.node(east, 60), exit = map.node(east, 120);
        map.way({top, entry}, street);
        map.way({entry, exit}, east == 0 ? street : tunnel);
        map.way({exit, map.node(east, 300)}, street);
    }
    const world::TownT town = import(map.text());
    EXPECT_THAT(report_, HasSubstr("what they cross stay 1 bridge or tunnel"));
    const Vector2d west = in_plan(town.low) + Vector2d(0, 300);
    EXPECT_NEAR(height_of_street(town, west + Vector2d(300, 20)), 6, 0.01);
    EXPECT_NEAR(height_of_street(town, west + Vector2d(1100, 24)), 6, 0.01);
    // Its ramp now crosses the second road, which comes up to it.
    EXPECT_GT(height_of_street(town, west + Vector2d(1100, 110)), 1);
    for (const towns::Criterion& criterion : all_criteria(town))
        EXPECT_TRUE(criterion.passed()) << criterion.name;
}

TEST_F(RaiseRoads, WhereRoadsCrossWithoutAJunctionBothAreLevel) {
    StreetMap map;
    const Tagged street{{"highway", "secondary"}};
    map.way({map.node(-300, 0), map.node(300, 0)}, {{"highway", "primary"}});
    map.way({map.node(-300, 90), map.node(300, 90)}, {{"highway", "primary"}});
    const int entry = map.node(0, 60), exit = map.node(0, 120);
    map.way({map.node(0, -300), entry}, street);
    map.way({entry, exit}, {street[0], {"tunnel", "yes"}});
    map.way({exit, map.node(0, 400)}, street);
    const world::TownT town = import(map.text());
    EXPECT_THAT(report_, ::testing::Not(HasSubstr("flat:")));
    // The ramp into the tunnel takes the first road down with it, but not below the second.
    EXPECT_LT(height_of_street(town, in_plan(town.low) + Vector2d(303, 303)), -1);
    EXPECT_NEAR(town.low.z(), -6, 0.01);
}

TEST_F(RaiseRoads, ABridgeOverATunnelAloneGoesUp) {
    StreetMap map;
    const Tagged street{{"highway", "secondary"}};
    for (const bool bridge : {false, true}) {
        const auto node = [&](double at) { return bridge ? map.node(0, at) : map.node(at, 0); };
        const int foot = node(-40), end = node(40);
        map.way({node(-300), foot}, street);
        map.way({foot, end}, {street[0], {bridge ? "bridge" : "tunnel", "yes"}});
        map.way({end, node(300)}, street);
    }
    const world::TownT town = import(map.text());
    EXPECT_NEAR(town.high.z() - town.low.z(), 6, 0.1) << report_;
}

/// Roads that cross without a junction, each pair a kilometre from the next one.
std::string crossings_in_a_row(int count) {
    std::string junctions, edges;
    for (int i = 0; i < count; ++i)
        for (const bool up : {false, true}) {
            const auto point = [&](double at) {
                return fmt::format("{},{}", 1000 * i + (up ? 0 : at), up ? at : 0);
            };
            const std::string id = fmt::format("{}{}", up ? "up" : "low", i);
            edges += fmt::format(
                "<edge id='{0}' from='{0}a' to='{0}b'><lane id='{0}_0' index='0' speed='14' "
                "length='600' shape='{1} {2}'/></edge>",
                id,
                point(-300),
                point(300));
            for (const auto& [end, at] : {std::pair("a", -300), std::pair("b", 300)})
                junctions += fmt::format(
                    "<junction id='{}{}' type='dead_end' x='{}' y='{}' incLanes='' intLanes='' "
                    "shape=''/>",
                    id,
                    end,
                    1000 * i + (up ? 0 : at),
                    up ? at : 0);
        }
    return "<net>" + edges + junctions + "</net>";
}

TEST(RaiseRoadsOfALargeNetwork, TakesNoMoreRoundsThanThatOfASmallOne) {
    for (const int count : {1, 20}) {
        const GuessedBridges guessed = guess_bridges(crossings_in_a_row(count));
        ASSERT_EQ(guessed.ways.size(), count);
        std::string network = guessed.network;
        int rounds = 0;
        // A judge who minds every bridge.
        const RaisedRoads raised = raise_roads(network, guessed.ways, [&](const std::string&) {
            ++rounds;
            std::vector<HeightFault> faults;
            for (int i = 0; i < count; ++i)
                faults.push_back({HeightFault::Kind::low, Vector2d(1000.0 * i, 0)});
            return faults;
        });
        EXPECT_EQ(rounds, 1) << count;
        EXPECT_EQ(raised.flat.at(HeightFault::Kind::low), count);
    }
}

/// A network with all of its heights multiplied.
std::string stretched(const std::string& network, double factor) {
    const std::regex height("([-0-9.]+,[-0-9.]+,)([-0-9.]+)");
    std::string text;
    auto rest = network.cbegin();
    for (std::sregex_iterator at(network.begin(), network.end(), height), last; at != last; ++at) {
        text.append(rest, (*at)[0].first);
        text += fmt::format("{}{:.3f}", (*at)[1].str(), factor * std::stod((*at)[2]));
        rest = (*at)[0].second;
    }
    return text.append(rest, network.cend());
}

TEST_F(RaiseRoads, LowBridgesAndSteepRampsAreFaults) {
    import(interchange({{"bridge", "yes"}, { "layer", "1" }}));
    HeightFaultFinder judge({"hill", stretched(network_, 0), "", ""});
    EXPECT_TRUE(judge.faults(network_).empty());
    EXPECT_TRUE(judge.faults(stretched(network_, 0.9)).empty());
    const auto low = judge.faults(stretched(network_, 0.7));
    ASSERT_FALSE(low.empty());
    EXPECT_EQ(low[0].kind, HeightFault::Kind::low);
    const auto steep = judge.faults(stretched(network_, 3));
    ASSERT_FALSE(steep.empty());
    EXPECT_EQ(steep[0].kind, HeightFault::Kind::steep);
}

}  // namespace
}  // namespace reprise::towns
