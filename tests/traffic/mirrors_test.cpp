#include "traffic/mirrors.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <libsumo/libsumo.h>

#include "process/program.h"
#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/random.h"

namespace reprise::traffic {
namespace {

using test::lane;
using test::own_town;
using test::spawn;
using test::Stage;
using test::vehicle_on;

constexpr std::uint32_t ego = 1;
constexpr std::uint32_t follower = 2;
constexpr std::uint64_t seed_of_crossings = 1;  // one that SUMO once aborted with
constexpr double sumo_gap = 2.5;                // [m] minGap of the fleet's cars

double sedan_front() {
    const world::VehicleModel& sedan = world::vehicle_models()[0];
    return sedan.length - sedan.rear_overhang;
}

TEST(Mirrors, ACarBehindAStandingEgoStopsBeforeIt) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "b2_b3_1");
    const world::VehicleState standing = vehicle_on(loaded.town.lanes[road], ego, 60);
    Stage stage(loaded, 0);
    stage.step({}, {standing});
    stage.step({spawn(follower, road, 5, 14)}, {standing});
    double nearest = 100;
    for (int i = 0; i < 400; ++i) {
        stage.step({}, {standing});
        const world::CarState* car = stage.car(follower);
        ASSERT_NE(car, nullptr);
        // Rear bumper of the ego minus front bumper of the follower, along the lane.
        const double gap =
            60 - world::vehicle_models()[0].rear_overhang - static_cast<double>(car->lane_s());
        nearest = std::min(nearest, gap);
        EXPECT_EQ(stage.draft().traffic.cars.size(), 1U) << "the ego is nobody's car but physics'";
    }
    // The ego has stood for longer than at a stop sign: room to get around it is left.
    constexpr double room = 2;
    EXPECT_NEAR(nearest, sumo_gap + room, 0.3);
    EXPECT_LT(stage.car(follower)->speed(), 0.01F);
    EXPECT_NE(stage.car(follower)->lamps() & world::lamp_brake, 0);
}

/// On the pavement, within a lane's width of the road: SUMO would have it on the lane, and
/// everybody behind it for ever.
TEST(Mirrors, WhoStandsBesideTheRoadHoldsNobodyUp) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "b2_b3_1");
    const world::LaneT& there = loaded.town.lanes[road];
    const world::VehicleModel& sedan = world::vehicle_models()[0];
    for (const double gap : {0.4, 0.9}) {
        world::VehicleState standing = vehicle_on(there, ego, 60);
        const world::LanePoint at = world::point_at(there, 60);
        const double aside = there.width / 2 + sedan.width / 2 + gap;
        const world::Vec3 place = standing.position();
        standing.mutable_position() = world::Vec3(
            place.x() + aside * std::sin(at.yaw), place.y() - aside * std::cos(at.yaw), place.z());
        Stage stage(loaded, 0);
        stage.step({}, {standing});
        stage.step({spawn(follower, road, 5, 14)}, {standing});
        double farthest = 0;
        for (int i = 0; i < 300 && stage.car(follower) != nullptr; ++i) {
            stage.step({}, {standing});
            const world::CarState* car = stage.car(follower);
            if (car != nullptr && car->lane() == road)
                farthest = std::max(farthest, static_cast<double>(car->lane_s()));
        }
        EXPECT_GT(farthest, 66) << gap;
    }
}

TEST(Mirrors, ACarFollowsADrivingEgoAtItsSpeed) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "l1_b1_1");
    Stage stage(loaded, 0);
    const double speed = 4;
    double s = 30;
    stage.step({}, {vehicle_on(loaded.town.lanes[road], ego, s, speed)});
    stage.step({spawn(follower, road, 5, 8)}, {vehicle_on(loaded.town.lanes[road], ego, s, speed)});
    for (int i = 0; i < 400; ++i) {
        s += speed * 0.05;
        stage.step({}, {vehicle_on(loaded.town.lanes[road], ego, s, speed)});
    }
    ASSERT_NE(stage.car(follower), nullptr);
    EXPECT_NEAR(static_cast<double>(stage.car(follower)->speed()), speed, 0.3);
    EXPECT_GT(s - static_cast<double>(stage.car(follower)->lane_s()), sumo_gap);
}

/// Beside a pavement and another lane; SUMO, which has no pavement, counts these lanes otherwise
/// than the network does. Somebody changed lanes into an ego that was beside him on the map, and
/// behind him to SUMO.
TEST(Mirrors, ADrivingVehicleIsInItsOwnLaneInSumo) {
    const auto& loaded = own_town("town1");
    for (const std::string name : {"l1_t1_1", "l1_t1_2"}) {
        const world::LaneT& road = loaded.town.lanes[lane(loaded.town, name)];
        Stage stage(loaded, 0);
        for (double s = 20; s < 120; s += 0.5) {
            stage.step({}, {vehicle_on(road, ego, s, 10)});
            if (s < 21)  // seen a tick later, and just put there
                continue;
            const std::vector<std::string> known = libsumo::Vehicle::getIDList();
            ASSERT_EQ(known.size(), 1U);
            ASSERT_EQ(libsumo::Vehicle::getLaneID(known.front()), name) << s << " m";
        }
    }
}

TEST(Mirrors, TheEgoMayDriveOverAJunctionAnyWay) {
    const auto& loaded = own_town("town1");
    const world::TownT& town = loaded.town;
    for (const auto* const target : {"b1_b2_1", "b1_a1_1"}) {
        Stage stage(loaded, 60);
        // From l1_b1 through the junction, with the indicator never set.
        const std::uint32_t start =
            lane(town, std::string(target) == "b1_a1_1" ? "l1_b1_2" : "l1_b1_1");
        const world::LaneT* here = &town.lanes[start];
        double s = here->length - 30;
        for (int i = 0; i < 200; ++i) {
            s += 9 * 0.05;
            while (s > here->length) {
                s -= here->length;
                const world::Link* way = &here->links.front();
                for (const world::Link& link : here->links)
                    if (town.lanes[link.to()].name == target)
                        way = &link;
                here = &town.lanes[way->via() != world::none ? way->via() : way->to()];
            }
            ASSERT_NO_THROW(stage.step({}, {vehicle_on(*here, ego, s, 9)})) << here->name;
            EXPECT_EQ(stage.draft().traffic.cars.size(), 60U);
            EXPECT_EQ(stage.car(ego), nullptr);
        }
    }
}

/// As somebody does who lost his way at 10 m/s: over the lanes that turn and go on beside each
/// other, while cars on those lanes look for what is ahead.
TEST(Mirrors, AVehicleMayCrossTheLanesOfAJunctionSideways) {
    const auto& loaded = own_town("town1");
    const std::uint32_t left = lane(loaded.town, "l1_b1_2");
    const std::uint32_t middle = lane(loaded.town, "l1_b1_1");
    const Eigen::Vector2d corner =
        world::to_eigen(loaded.town.lanes[middle].centre.back()).head<2>();
    for (int i = 0; i < 60; ++i) {
        Stage stage(loaded, 0);
        const double ahead = 2 + 0.1 * i;  // [m] behind the stop line, to where it crosses
        const auto ego_at = [&](double aside) {
            return test::vehicle_at(ego, corner.x() + ahead, corner.y() + aside, -1.47, 10);
        };
        stage.step({spawn(follower, left, loaded.town.lanes[left].length - 12, 8),
                    spawn(follower + 1, middle, loaded.town.lanes[middle].length - 12, 8)},
                   {ego_at(12)});
        for (double aside = 12; aside > -12; aside -= 0.5)
            ASSERT_NO_THROW(stage.step({}, {ego_at(aside)})) << ahead << " m on, " << aside;
        EXPECT_EQ(stage.draft().traffic.cars.size(), 2U);
    }
}

TEST(Mirrors, OffTheRoadNothingHappensToOthers) {
    const auto& loaded = own_town("town1");
    Stage stage(loaded, 50);
    // Across the town in a straight line, over roads, meadows and far out of the map, and back.
    for (int i = 0; i < 900; ++i) {
        const double x = i < 450 ? -300.0 + 3 * i : -300.0 + 3 * (900 - i);
        ASSERT_NO_THROW(stage.step({}, {test::vehicle_at(ego, x, 120 + 0.1 * i, 0.05, 60)}));
        EXPECT_EQ(stage.draft().traffic.cars.size(), 50U);
    }
}

/// Straight on or in a bend, at 1 to 21 m/s, from anywhere to anywhere, over whatever is there.
TEST(Mirrors, AVehicleMayCrossJunctionsAnyHow) {
    const auto& loaded = own_town("town1");
    std::vector<std::uint32_t> inside;
    for (std::uint32_t i = 0; i < loaded.town.lanes.size(); ++i)
        if (loaded.town.lanes[i].kind == world::LaneKind::internal)
            inside.push_back(i);
    Stage stage(loaded, 100);
    constexpr double half = 25;  // [m] before and behind the place
    for (std::uint64_t crossing = 0; crossing < 60; ++crossing) {
        const auto dice = [crossing](std::uint64_t item) {
            return world::draw(seed_of_crossings, crossing, world::Purpose::scenario, item);
        };
        const auto lane =
            inside[static_cast<std::size_t>(dice(0) * static_cast<double>(inside.size()))];
        const auto& line = loaded.town.lanes[lane].centre;
        double yaw = 2 * std::numbers::pi * dice(1);
        const double speed = 1 + 20 * dice(2);
        const double turning = dice(3) < 0.5 ? 0.5 * (dice(4) - 0.5) : 0;  // [rad/s]
        double x = line[line.size() / 2].x() - half * std::cos(yaw);
        double y = line[line.size() / 2].y() - half * std::sin(yaw);
        for (double driven = 0; driven < 2 * half; driven += 0.05 * speed) {
            x += 0.05 * speed * std::cos(yaw);
            y += 0.05 * speed * std::sin(yaw);
            yaw += 0.05 * turning;
            ASSERT_NO_THROW(stage.step({}, {test::vehicle_at(ego, x, y, yaw, speed)}));
        }
        if (dice(5) < 0.3)
            stage.step({}, {});
    }
    EXPECT_EQ(stage.draft().traffic.cars.size(), 100U);
}

TEST(Mirrors, AVehicleMayGoAndComeBack) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "l1_b1_1");
    Stage stage(loaded, 0);
    const world::VehicleState standing = vehicle_on(loaded.town.lanes[road], ego, 60);
    for (int round = 0; round < 3; ++round) {
        stage.step({}, {standing});
        stage.step({}, {standing});
        stage.step({}, {});
        stage.step({}, {});
    }
    // Gone: a car drives through the place.
    stage.step({spawn(follower, road, 20, 10)});
    stage.steps(120);
    EXPECT_GT(stage.car(follower)->lane_s(), 60.0F + static_cast<float>(sedan_front()));
}

/// The network that netconvert makes of these nodes and edges.
test::Loaded converted(const std::string& name, const char* nodes, const char* edges) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "nodes.xml") << nodes;
    std::ofstream(folder / "edges.xml") << edges;
    const std::string output = name + ".net.xml";
    const process::ProgramResult made = process::run_program(
        {.name = "netconvert",
         .words = {"-X", "never", "-n", "nodes.xml", "-e", "edges.xml", "-o", output},
         .folder = folder});
    EXPECT_EQ(made.code, 0) << made.said;
    return test::load(folder / output);
}

/// A road along x with two junctions, and an edge of 10 cm between them.
test::Loaded road_with_a_tiny_edge() {
    return converted("tiny",
                     R"(<nodes> <node id="a" x="0" y="0"/> <node id="b" x="150" y="0"/>
        <node id="c" x="162" y="0"/> <node id="d" x="320" y="0"/> <node id="n" x="150" y="100"/>
        <node id="s" x="162" y="-100"/> </nodes>)",
                     R"(<edges> <edge id="ab" from="a" to="b"/> <edge id="bc" from="b" to="c"/>
        <edge id="cd" from="c" to="d"/> <edge id="nb" from="n" to="b"/>
        <edge id="bn" from="b" to="n"/> <edge id="sc" from="s" to="c"/>
        <edge id="cs" from="c" to="s"/> </edges>)");
}

TEST(Mirrors, ATailOverATinyEdgeIsSeenAllTheWay) {
    const test::Loaded loaded = road_with_a_tiny_edge();
    const std::uint32_t road = lane(loaded.town, "ab_0");
    const double y = loaded.town.lanes[road].centre.front().y();
    const double length = world::vehicle_models()[0].length;
    // The tail leaves the tiny edge in a tick. The follower stands up right behind, so that it
    // always looks for the ego's tail.
    const double speed = 8;
    ASSERT_LT(loaded.town.lanes[lane(loaded.town, "bc_0")].sumo_length, speed * 0.05);
    double x = 100;
    auto ego_now = [&] { return test::vehicle_at(ego, x, y, 0, speed); };
    Stage stage(loaded, 0);
    stage.step({}, {ego_now()});
    stage.step({spawn(follower, road, 85, speed)}, {ego_now()});
    for (int i = 0; i < 300; ++i) {
        x += speed * 0.05;
        stage.step({}, {ego_now()});
        const world::CarState* car = stage.car(follower);
        ASSERT_NE(car, nullptr);
        const double gap = x - (length - sedan_front()) - (car->position().x() + sedan_front());
        ASSERT_GT(gap, 1) << "with the ego at " << x;
        ASSERT_LT(gap, 20) << "with the ego at " << x;
    }
    EXPECT_GT(x, 200) << "behind both junctions";
}

/// Two roads that cross in (150, 150); the one along x goes first.
test::Loaded crossing_with_priority() {
    return converted("priority",
                     R"(<nodes> <node id="w" x="0" y="150"/> <node id="e" x="300" y="150"/>
        <node id="s" x="150" y="0"/> <node id="n" x="150" y="300"/>
        <node id="c" x="150" y="150" type="priority"/> </nodes>)",
                     R"(<edges> <edge id="wc" from="w" to="c" priority="9"/>
        <edge id="ce" from="c" to="e" priority="9"/> <edge id="sc" from="s" to="c" priority="1"/>
        <edge id="cn" from="c" to="n" priority="1"/> </edges>)");
}

TEST(Mirrors, WhoHasToGiveWayWaitsAtTheLineForTheEgo) {
    const test::Loaded loaded = crossing_with_priority();
    const world::LaneT& first = loaded.town.lanes[lane(loaded.town, "wc_0")];
    const std::uint32_t road = lane(loaded.town, "sc_0");
    const double middle = loaded.town.lanes[road].centre.back().x();
    const double y = first.centre.back().y();
    const double speed = 12;
    // Ticks until the car is in the junction, with the ego there after `arrives` of them; 0: none.
    const auto enters = [&](int arrives) {
        Stage stage(loaded, 0);
        const auto vehicles = [&](int tick) {
            std::vector<world::VehicleState> all;
            if (arrives != 0)
                all.push_back(
                    test::vehicle_at(ego, middle + (tick - arrives) * speed * 0.05, y, 0, speed));
            return all;
        };
        stage.step({}, vehicles(0));
        stage.step({spawn(follower, road, 70, 8)}, vehicles(1));
        int tick = 2;
        for (; tick < 600; ++tick) {
            stage.step({}, vehicles(tick));
            if (stage.car(follower) == nullptr || stage.car(follower)->lane() != road)
                break;
        }
        return tick;
    };
    const int alone = enters(0);
    ASSERT_LT(alone, 300);
    for (const int later : {0, 10, 20, 30})
        EXPECT_GT(enters(alone + later), alone + later) << later;
}

/// Drives as somebody who cannot make up his mind, in a box around (x, y) [m]. The seed decides.
void go_to_and_fro(const test::Loaded& loaded,
                   const Eigen::Vector2d& middle,
                   const Eigen::Vector2d& half,
                   std::uint64_t seed) {
    Stage stage(loaded, 0);
    double x = middle.x(), y = middle.y(), yaw = std::numbers::pi, speed = 0, wanted = 1.3,
           lock = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        const auto dice = [i, seed](std::uint64_t item) {
            return world::draw(seed, i, world::Purpose::scenario, item);
        };
        if (dice(0) < 0.02)
            wanted = dice(1) < 0.5 ? 1.3 : -1.3;
        if (dice(2) < 0.02)
            lock = 1.2 * (dice(3) - 0.5);
        speed += wanted > speed ? 0.05 : -0.05;
        const double next_x = x + 0.05 * speed * std::cos(yaw);
        const double next_y = y + 0.05 * speed * std::sin(yaw);
        if (std::abs(next_x - middle.x()) > half.x() || std::abs(next_y - middle.y()) > half.y()) {
            wanted = -wanted;
            speed = 0;
        } else {
            yaw += 0.05 * speed * std::tan(lock) / 2.7;
        }
        if (speed != 0) {
            x = next_x;
            y = next_y;
        }
        ASSERT_NO_THROW(stage.step({}, {test::vehicle_at(ego, x, y, yaw, speed)})) << "tick " << i;
        ASSERT_EQ(stage.car(ego), nullptr);
    }
}

/// The seed is one that SUMO once aborted with.
TEST(Mirrors, ACarMayGoToAndFroAtADeadEnd) {
    const test::Loaded loaded = converted(
        "dead_end",
        R"(<nodes> <node id="a" x="0" y="0"/> <node id="b" x="150" y="0"/> </nodes>)",
        R"(<edges> <edge id="ab" from="a" to="b"/> <edge id="ba" from="b" to="a"/> </edges>)");
    go_to_and_fro(loaded, {0, 0}, {12, 2.2}, 23);
}

/// The way back from a dead end gets a second lane there, which comes near the way there.
TEST(Mirrors, ACarMayGoToAndFroWhereALaneBegins) {
    const test::Loaded loaded = converted(
        "lane_begins",
        R"(<nodes> <node id="a" x="0" y="0"/> <node id="b" x="85" y="0"/> <node id="c" x="100" y="0"/>
        <node id="d" x="200" y="0"/> </nodes>)",
        R"(<edges> <edge id="ca" from="c" to="a"/> <edge id="ab" from="a" to="b"/>
        <edge id="bc" from="b" to="c" numLanes="2" shape="85,3.2 100,3.2"/>
        <edge id="cd" from="c" to="d"/> <edge id="dc" from="d" to="c"/> </edges>)");
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U})
        go_to_and_fro(loaded, {83, 0}, {15, 3}, seed);
}

/// The lanes that lead along these edges, those in the junctions between them, too.
std::vector<std::uint32_t> lanes_along(const world::TownT& town,
                                       const std::vector<std::string>& edges) {
    std::vector<std::uint32_t> lanes{lane(town, edges.front() + "_0")};
    for (std::size_t i = 1; i < edges.size(); ++i) {
        const std::uint32_t next = lane(town, edges[i] + "_0");
        for (const world::Link& link : town.lanes[lanes.back()].links)
            if (link.to() == next) {
                for (std::uint32_t via = link.via(); via != world::none && via != next;) {
                    lanes.push_back(via);
                    const world::Link& on = town.lanes[via].links.front();
                    via = on.via() == world::none ? on.to() : on.via();
                }
                break;
            }
        lanes.push_back(next);
    }
    return lanes;
}

/// The way that Mirrors::set_route is careful about. It does not show the abort of SUMO's that was
/// seen on a large map: that needs more than these roads.
TEST(Mirrors, AVehicleMayComeRoundARingAndLeaveItElsewhere) {
    const test::Loaded loaded = converted(
        "ring",
        R"(<nodes> <node id="a" x="0" y="0"/> <node id="b" x="60" y="0"/> <node id="c" x="60" y="60"/>
        <node id="d" x="0" y="60"/> <node id="x" x="140" y="0"/> <node id="y" x="-80" y="60"/> </nodes>)",
        R"(<edges> <edge id="ab" from="a" to="b"/> <edge id="bc" from="b" to="c"/> <edge id="cd" from="c" to="d"/>
        <edge id="da" from="d" to="a"/> <edge id="bx" from="b" to="x"/> <edge id="xb" from="x" to="b"/>
        <edge id="dy" from="d" to="y"/> <edge id="yd" from="y" to="d"/> </edges>)");
    const std::vector<std::uint32_t> lanes =
        lanes_along(loaded.town, {"ab", "bc", "cd", "da", "ab", "bx", "xb", "bc", "cd", "dy",
                                  "yd", "da", "ab", "bc", "cd", "da", "ab", "bc", "cd", "dy"});
    for (const std::uint16_t lamps : std::vector<std::uint16_t>{0, 2, 4}) {
        Stage stage(loaded, 3);
        for (const std::uint32_t on : lanes)
            for (double s = 0; s < loaded.town.lanes[on].length; s += 0.4) {
                world::VehicleState vehicle = vehicle_on(loaded.town.lanes[on], ego, s, 8);
                vehicle.mutate_lamps(lamps);
                ASSERT_NO_THROW(stage.step({}, {vehicle})) << loaded.town.lanes[on].name;
            }
    }
}

TEST(Mirrors, RunsWithMirrorsAreRepeatable) {
    const auto& loaded = own_town("town1");
    const std::uint32_t road = lane(loaded.town, "b2_b3_1");
    auto run = [&] {
        Stage stage(loaded, 80);
        for (int i = 0; i < 300; ++i)
            stage.step({}, {vehicle_on(loaded.town.lanes[road], ego, std::min(60.0, 0.3 * i), 6)});
        return stage.digest();
    };
    EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace reprise::traffic
