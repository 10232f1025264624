#include "traffic/standoffs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "process/program.h"
#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "traffic/roads/right_of_way.h"

namespace reprise::traffic {
namespace {

using test::lane;
using test::Stage;

/// Two roads that cross, the one along x with the right of way, of so many lanes and as long to
/// both sides. The other one goes on behind it for so many metres.
test::Loaded crossing_roads(int lanes = 1,
                            const char* speed = "13.89",
                            int length = 200,
                            int behind = 200) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) /
        ("standoff" + std::to_string(lanes) + speed + "_" + std::to_string(behind));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "nodes.xml")
        << R"(<nodes> <node id="j" x="0" y="0" type="priority"/> <node id="w" x="-)" << length
        << R"(" y="0"/> <node id="e" x=")" << length
        << R"(" y="0"/> <node id="s" x="0" y="-200"/> <node id="n" x="0" y=")" << behind
        << R"("/> </nodes>)";
    const std::string main_road =
        " priority=\"9\" numLanes=\"" + std::to_string(lanes) + "\" speed=\"" + speed + "\"/>";
    std::ofstream(folder / "edges.xml") << R"(<edges> <edge id="wj" from="w" to="j")" << main_road
                                        << R"(<edge id="je" from="j" to="e")" << main_road << R"(
        <edge id="sj" from="s" to="j" priority="1"/> <edge id="jn" from="j" to="n" priority="1"/> </edges>)";
    const process::ProgramResult made = process::run_program(
        {.name = "netconvert",
         .words = {"-X", "never", "-n", "nodes.xml", "-e", "edges.xml", "-o", "standoff.net.xml"},
         .folder = folder});
    EXPECT_EQ(made.code, 0) << made.said;
    return test::load(folder / "standoff.net.xml");
}

/// Somebody with mass stands at his line on the main road, and waits for those who wait for him.
TEST(Standoffs, OneOfTwoWhoWaitForEachOtherGoes) {
    const test::Loaded loaded = crossing_roads();
    const std::uint32_t main_road = lane(loaded.town, "wj_0");
    const std::uint32_t minor = lane(loaded.town, "sj_0");
    const world::LaneT& on = loaded.town.lanes[main_road];
    const world::VehicleState ego = test::vehicle_on(on, 1, on.length - 4.5);
    Stage stage(loaded, 6, 3);
    std::map<std::uint32_t, int> stood;  // ticks, at the end of the minor road
    int longest = 0;
    std::size_t gone = 0;  // over the junction, from the minor road
    for (int i = 0; i < 2400; ++i) {
        stage.step({}, {ego});
        for (const world::CarState& car : stage.draft().traffic.cars) {
            const bool at_line =
                car.lane() == minor &&
                car.lane_s() > static_cast<float>(loaded.town.lanes[minor].length - 3);
            const bool waits = at_line && car.speed() < 0.1F;
            gone += !at_line && stood.contains(car.id());
            if (!at_line)
                stood.erase(car.id());
            else if (waits)
                longest = std::max(longest, ++stood[car.id()]);
        }
    }
    EXPECT_GT(longest, 100) << "nobody waited: nothing is shown";
    EXPECT_LT(longest, 1100) << "[ticks]";
    EXPECT_GE(gone, 1U);
}

/// [ticks] that anybody stood at the end of the minor road, whatever came on the main one.
int longest_wait(const test::Loaded& loaded, std::uint32_t cars, std::uint64_t seed) {
    const std::uint32_t minor = lane(loaded.town, "sj_0");
    const auto line = static_cast<float>(loaded.town.lanes[minor].length - 3);
    Stage stage(loaded, cars, seed);
    std::map<std::uint32_t, int> stood;
    int longest = 0;
    for (int i = 0; i < 4800; ++i) {
        stage.step();
        for (const world::CarState& car : stage.draft().traffic.cars) {
            const bool waits = car.lane() == minor && car.lane_s() > line && car.speed() < 0.1F;
            int& ticks = stood[car.id()];
            ticks = waits ? ticks + 1 : 0;
            longest = std::max(longest, ticks);
        }
    }
    return longest;
}

/// One after the other comes on the main road, four lanes wide: to SUMO a gap must hold all of the
/// way over them, from a standstill.
TEST(Standoffs, WhoFindsNoGapIsLetIn) {
    const test::Loaded loaded = crossing_roads(4);
    for (const std::uint64_t seed : {1, 2}) {
        const int longest = longest_wait(loaded, 40, seed);
        EXPECT_GT(longest, 500) << "[ticks] gaps enough: nothing is shown";
        EXPECT_LT(longest, 950) << "[ticks] alone it was 1619 and 1900";
    }
}

/// Where nobody changes lanes behind the junction, however near the next one is.
TEST(Standoffs, WhoFindsNoGapIsLetInBeforeAShortRoadOfOneLaneToo) {
    const test::Loaded loaded = crossing_roads(4, "13.89", 200, 40);
    ASSERT_LT(loaded.town.lanes[lane(loaded.town, "jn_0")].length, 40);
    for (const std::uint64_t seed : {1, 2, 4}) {
        const int longest = longest_wait(loaded, 60, seed);
        EXPECT_GT(longest, 500) << "[ticks] gaps enough: nothing is shown";
        EXPECT_LT(longest, 990) << "[ticks] alone it was 1071, 1077 and 1113";
    }
}

/// At 90 km/h nobody can stop easily who is as near as one is asked in a town: on a motorway's ramp
/// the first of a queue stood for 466 s.
TEST(Standoffs, WhoFindsNoGapOnAFastRoadIsLetIn) {
    const int longest = longest_wait(crossing_roads(4, "25", 1500), 130, 2);
    EXPECT_GT(longest, 500) << "[ticks] gaps enough: nothing is shown";
    EXPECT_LT(longest, 1100) << "[ticks] alone it was taken out after 2001";
}

/// A bus forgot whom it was getting past, stopped in his body, and both stood so until one was
/// taken out.
TEST(Standoffs, WhoIsLetInStillPushesPastWhomItIsPushingPast) {
    constexpr std::uint32_t way = 5;
    Cars cars;
    world::TickDraft draft;
    for (const std::uint32_t id : {1U, 2U, 3U, 4U}) {
        Car car;
        car.id = id;
        cars.add(std::move(car), "", 0, draft);
    }
    Car& bus = cars[0];
    bus.pushes_past = {2, 3};  // 2 stands in its way; 3 was asked a second ago, 4 is now
    bus.pushes_until = 300;
    cars[2].lets_in_way = cars[3].lets_in_way = way;
    Standoffs::push_past(bus, {4}, way, cars, 100);
    EXPECT_EQ(bus.pushes_past, (std::vector<std::uint32_t>{2, 4}));
    EXPECT_EQ(bus.pushes_until, 300U);
    Standoffs::push_past(bus, {}, way, cars, 120);
    EXPECT_EQ(bus.pushes_past, (std::vector<std::uint32_t>{2}));
    EXPECT_EQ(bus.pushes_until, 300U);
    Standoffs::push_past(bus, {4}, way, cars, 300);
    EXPECT_EQ(bus.pushes_past, (std::vector<std::uint32_t>{4})) << "it is through, or gave up";
    EXPECT_EQ(bus.pushes_until, 360U);
}

/// Two asked one, from two junctions in a row: he held for the second one, and came before the
/// first one, who pushed past him by then.
TEST(Standoffs, WhoLetsOneInIsAskedByNobodyElse) {
    constexpr std::uint32_t near_way = 5;
    constexpr std::uint32_t far_way = 6;
    Car comer;
    comer.speed = 5;
    EXPECT_FALSE(Standoffs::ask(comer, 8, near_way, 100)) << "it cannot stop easily any more";
    EXPECT_TRUE(Standoffs::ask(comer, 80, far_way, 100));
    EXPECT_FALSE(Standoffs::ask(comer, 30, near_way, 110));
    EXPECT_EQ(comer.lets_in_way, far_way);
    EXPECT_TRUE(Standoffs::ask(comer, 8, far_way, 120)) << "who was asked stays asked";
    EXPECT_FALSE(Standoffs::ask(comer, 8, near_way, 121));
    EXPECT_TRUE(Standoffs::ask(comer, 30, near_way, comer.lets_in_until)) << "that is over";
    EXPECT_EQ(comer.lets_in_way, near_way);
}

/// Three by three crossings at which nobody has the right of way: to SUMO nobody crosses anybody's
/// way there.
test::Loaded unregulated_roads() {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "unregulated";
    std::filesystem::create_directories(folder);
    std::ofstream nodes(folder / "nodes.xml");
    std::ofstream edges(folder / "edges.xml");
    const auto edge = [&edges](int from, int to) {
        edges << "<edge id=\"" << from << '_' << to << "\" from=\"n" << from << "\" to=\"n" << to
              << "\" speed=\"13.9\"/>\n";
    };
    nodes << "<nodes>\n";
    edges << "<edges>\n";
    for (int i = 0; i < 9; ++i) {
        const int x = i % 3;
        const int y = i / 3;
        nodes << "<node id=\"n" << i << "\" x=\"" << 80 * x << "\" y=\"" << 80 * y
              << "\" type=\"unregulated\"/>\n";
        for (const int next : {x < 2 ? i + 1 : i, y < 2 ? i + 3 : i})
            if (next != i) {
                edge(i, next);
                edge(next, i);
            }
    }
    nodes << "</nodes>\n" << std::flush;
    edges << "</edges>\n" << std::flush;
    const process::ProgramResult made = process::run_program(
        {.name = "netconvert",
         .words =
             {"-X", "never", "-n", "nodes.xml", "-e", "edges.xml", "-o", "unregulated.net.xml"},
         .folder = folder});
    EXPECT_EQ(made.code, 0) << made.said;
    return test::load(folder / "unregulated.net.xml");
}

/// Four who came from four sides, each with its nose before the next one: SUMO knows nothing of it.
/// With as many cars as such a town can carry; of 60, more than fit, some seeds stand for ever.
class Rings : public testing::TestWithParam<std::uint64_t> {};

INSTANTIATE_TEST_SUITE_P(Seeds, Rings, testing::Values(1, 2, 6, 7));

TEST_P(Rings, OfThoseWhoStandInEachOthersWayAreDissolved) {
    constexpr int cars = 44;
    const test::Loaded loaded = unregulated_roads();
    Stage stage(loaded, cars, GetParam());
    std::map<std::uint32_t, int> stood;  // ticks
    int longest = 0;
    double driven = 0;  // [m] in the last minute, by all
    for (int i = 0; i < 6000; ++i) {
        // Somebody sees each of the crossings.
        std::vector<world::VehicleState> seers;
        for (std::uint32_t k = 0; k < 9; ++k)
            seers.push_back(test::vehicle_at(k + 1, 80.0 * (k % 3) + 14, 80.0 * (k / 3) + 14, 0));
        stage.step({}, seers);
        for (const world::CarState& car : stage.draft().traffic.cars) {
            int& ticks = stood[car.id()];
            ticks = car.speed() < 0.1F ? ticks + 1 : 0;
            longest = std::max(longest, ticks);
            driven += i >= 4800 ? static_cast<double>(car.speed()) * 0.05 : 0;
        }
    }
    EXPECT_GT(longest, 720) << "[ticks] nobody stood for long: nothing is shown";
    EXPECT_LT(longest, 1400) << "[ticks] for ever it was: 4000, and then the next ring";
    EXPECT_GT(driven, cars * 60 * 1.5) << "1.5 m/s on the average";
}

/// One road that goes on as another one around a corner: a junction on the map. Of more `lanes`
/// only the left one leads around it.
test::Loaded corner(int lanes = 1) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("corner" + std::to_string(lanes));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "nodes.xml")
        << R"(<nodes> <node id="w" x="-200" y="0"/> <node id="c" x="0" y="0" type="priority"/>
        <node id="n" x="0" y="200"/> </nodes>)";
    std::ofstream(folder / "edges.xml")
        << R"(<edges> <edge id="wc" from="w" to="c" shape="-200,0 -12,0" numLanes=")" << lanes
        << R"("/>
        <edge id="cn" from="c" to="n" shape="0,12 0,200"/> </edges>)";
    std::ofstream(folder / "ways.xml")
        << R"(<connections> <connection from="wc" to="cn" fromLane=")" << lanes - 1
        << R"(" toLane="0"/> </connections>)";
    const process::ProgramResult made = process::run_program({.name = "netconvert",
                                                              .words = {"-X",
                                                                        "never",
                                                                        "-n",
                                                                        "nodes.xml",
                                                                        "-e",
                                                                        "edges.xml",
                                                                        "-x",
                                                                        "ways.xml",
                                                                        "-o",
                                                                        "corner.net.xml"},
                                                              .folder = folder});
    EXPECT_EQ(made.code, 0) << made.said;
    return test::load(folder / "corner.net.xml");
}

/// Behind somebody with mass, as before a light.
TEST(Standoffs, WhoStandsInARowWhereNobodyCrossesIsInNobodysWay) {
    const test::Loaded loaded = corner();
    const world::LaneT& on = loaded.town.lanes[lane(loaded.town, "cn_0")];
    const std::uint32_t around = loaded.town.lanes[lane(loaded.town, "wc_0")].links.front().via();
    ASSERT_NE(around, world::none);
    ASSERT_GT(loaded.town.lanes[around].length, 5);
    const world::VehicleState ego = test::vehicle_on(on, 1, 4);
    Stage stage(loaded, 4, 3);
    std::set<std::uint32_t> stood;  // in the corner, after half a minute
    for (int i = 0; i < 2400; ++i) {
        stage.step({}, {ego});
        for (const world::CarState& car : stage.draft().traffic.cars)
            if (i == 600 && car.lane() == around && car.speed() < 0.1F)
                stood.insert(car.id());
    }
    EXPECT_FALSE(stood.empty()) << "nobody stood: nothing is shown";
    for (const std::uint32_t id : stood)
        EXPECT_NE(stage.car(id), nullptr) << id;
}

/// He would stand at its end until somebody lets him in.
TEST(InsertionPoints, NobodyAppearsRightBeforeTheEndOfALaneThatLeadsNowhere) {
    const test::Loaded loaded = corner(2);
    const std::uint32_t ends = lane(loaded.town, "wc_0");
    ASSERT_TRUE(loaded.town.lanes[ends].links.empty());
    Stage stage(loaded, 40, 3);
    int seen = 0;
    for (const world::CarState& car : stage.step().traffic.cars) {
        if (car.lane() != ends)
            continue;
        ++seen;
        EXPECT_LT(car.lane_s(), loaded.town.lanes[ends].length - 75) << car.id();
    }
    EXPECT_GT(seen, 2);
}

TEST(RightOfWay, KnowsWhereWaysCross) {
    for (const bool cross : {true, false}) {
        const test::Loaded loaded = cross ? crossing_roads() : corner();
        const Stage stage(loaded, 0);
        const RightOfWay right_of_way = right_of_way_in_sumo(loaded.town);
        const auto& from = loaded.town.lanes[lane(loaded.town, cross ? "wj_0" : "wc_0")];
        EXPECT_EQ(right_of_way.is_crossed(from.links.front().via()), cross);
    }
}

/// Two routes that must agree: what SUMO says, and how the roads were made.
TEST(RightOfWay, IsThatOfTheNetwork) {
    const test::Loaded loaded = crossing_roads();
    const Stage stage(loaded, 0);
    const RightOfWay right_of_way = right_of_way_in_sumo(loaded.town);
    const auto way_from = [&](const char* name) {
        return loaded.town.lanes[lane(loaded.town, name)].links.front().via();
    };
    EXPECT_TRUE(right_of_way.lets_go(way_from("sj_0"), way_from("wj_0")));
    EXPECT_FALSE(right_of_way.lets_go(way_from("wj_0"), way_from("sj_0")));
}

}  // namespace
}  // namespace reprise::traffic
