// Where the autopilot goes: wandering, or along the route that it is given.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "drivers/driver.h"
#include "drivers/way/lane_graph.h"
#include "tests/drivers/kinematic_car.h"

namespace reprise::test {
namespace {

using world::LaneKind;
using world::Turn;

/// A one-way ring, driven counter-clockwise, with a short cut and a blind alley:
///
///        top <----+---------.        top (2)  may go on to left (3) or into blind (4)
///   blind |       | short    \       bottom (0) may go on to right (1) or take the short cut (5),
///   left  |       | cut  right|      which gives way where it joins the top
///        bottom --+---------'
world::TownT ring() {
    constexpr double pi = std::numbers::pi;
    world::TownT town;
    town.name = "ring";
    town.junctions.resize(3);
    town.lanes = {
        make_lane("bottom", Turtle(0, 0, 0).ahead(150)),
        make_lane("right", Turtle(160, 0, 0).turn(pi, 30)),
        make_lane("top", Turtle(150, 60, pi).ahead(150)),
        make_lane("left", Turtle(-10, 60, pi).turn(pi, 30)),
        make_lane("blind", Turtle(-12, 72, quarter).ahead(60)),
        make_lane("short_cut", Turtle(162, 12, quarter).ahead(36), 8.33),
        make_lane(":a0", Turtle(150, 0, 0).ahead(10), 13.89, LaneKind::internal),
        make_lane(":a1", Turtle(150, 0, 0).turn(quarter, 12), 5.5, LaneKind::internal),
        make_lane(":b0", Turtle(160, 60, pi).ahead(10), 13.89, LaneKind::internal),
        make_lane(":b1", Turtle(162, 48, quarter).turn(quarter, 12), 5.5, LaneKind::internal),
        make_lane(":c0", Turtle(0, 60, pi).ahead(10), 13.89, LaneKind::internal),
        make_lane(":c1", Turtle(0, 60, pi).turn(-quarter, 12), 5.5, LaneKind::internal),
        make_lane(":d0", Turtle(-10, 0, 0).ahead(10), 13.89, LaneKind::internal),
    };
    town.lanes[0].junction = 0;
    town.lanes[0].links = {make_link(1, 6, Turn::straight), make_link(5, 7, Turn::left)};
    town.lanes[1].junction = town.lanes[5].junction = 1;
    town.lanes[1].links = {make_link(2, 8, Turn::straight)};
    town.lanes[5].links = {make_link(2, 9, Turn::left, true)};
    town.lanes[2].junction = 2;
    town.lanes[2].links = {make_link(3, 10, Turn::straight), make_link(4, 11, Turn::right)};
    town.lanes[3].links = {make_link(0, 12, Turn::straight)};
    for (const world::LaneT& lane : std::vector(town.lanes))
        for (const world::Link& link : lane.links)
            town.lanes[link.via()].links = {make_link(link.to(), world::none, link.turn())};
    return town;
}

/// The ring, with a second lane to the left of the bottom (13): only from there one gets onto the
/// short cut, and nowhere else.
world::TownT ring_with_turning_lane() {
    world::TownT town = ring();
    town.lanes.push_back(make_lane("bottom_left", Turtle(0, 3.5, 0).ahead(150)));
    town.lanes[7] = make_lane(
        ":a1", Turtle(150, 3.5, 0).ahead(3.5).turn(quarter, 8.5), 5.5, LaneKind::internal);
    town.lanes[7].links = {make_link(5, world::none, Turn::left)};
    town.lanes[0].links = {make_link(1, 6, Turn::straight)};
    town.lanes[13].links = {make_link(5, 7, Turn::left)};
    town.lanes[13].junction = 0;
    town.lanes[13].edge = town.lanes[0].edge;
    town.lanes[0].left = 13;
    town.lanes[13].right = 0;
    return town;
}

TEST(Autopilot, WandersWithoutLeavingTheLanesOrEnteringBlindAlleys) {
    std::set<std::uint32_t> seen;
    for (const std::uint64_t seed : {1u, 2u}) {
        Drive drive(ring(), seed);
        drive.place(0, 5, 0);
        while (drive.seconds() < 180) {
            drive.step();
            ASSERT_LT(drive.off_centre(), 0.3) << "at " << drive.seconds() << " s";
            seen.insert(drive.autopilot->path().front());
        }
        EXPECT_GT(drive.car.odometer, 900);
    }
    EXPECT_EQ(seen.count(4), 0u) << "the blind alley";
    EXPECT_EQ(seen.count(5), 1u) << "the short cut";
    EXPECT_EQ(seen.count(1), 1u) << "the long way";
}

TEST(LaneGraph, TurnsAroundOnlyWhereNothingElseIsLeft) {
    world::TownT town = ring();
    EXPECT_EQ(drivers::LaneGraph(town).choices(2), std::vector<std::uint32_t>{0}) << "blind alley";
    town.lanes[4].links = {make_link(0, world::none, Turn::around)};
    EXPECT_EQ(drivers::LaneGraph(town).choices(2), std::vector<std::uint32_t>{0})
        << "turning place";
    town.lanes[4].links = {make_link(0, world::none, Turn::right)};
    EXPECT_EQ(drivers::LaneGraph(town).choices(2), (std::vector<std::uint32_t>{0, 1}));
    town.lanes[2].links = {make_link(4, 11, Turn::right)};
    town.lanes[4].links = {make_link(0, world::none, Turn::around)};
    EXPECT_EQ(drivers::LaneGraph(town).choices(4), std::vector<std::uint32_t>{0});
}

TEST(LaneGraph, LeavesCornersThatNoCarCanTurnAtToThoseWhoMust) {
    constexpr double sharp = 2.6;  // [rad]
    world::TownT town;
    town.lanes = {make_lane("in", Turtle(0, 0, 0).ahead(100)),
                  make_lane("on", Turtle(102, 0, 0).ahead(100)),
                  make_lane("back", Turtle(102, -2, -sharp).ahead(100)),
                  make_lane(":on", Turtle(100, 0, 0).ahead(2), 5.5, LaneKind::internal),
                  make_lane(":back", Turtle(100, 0, 0).ahead(2), 5.5, LaneKind::internal)};
    town.lanes[1].links = town.lanes[2].links = {make_link(0, world::none, Turn::straight)};
    town.lanes[0].links = {make_link(1, 3, Turn::straight), make_link(2, 4, Turn::right)};
    EXPECT_EQ(drivers::LaneGraph(town).choices(0), std::vector<std::uint32_t>{0});
    town.lanes[0].links = {make_link(2, 4, Turn::right)};
    EXPECT_EQ(drivers::LaneGraph(town).choices(0), std::vector<std::uint32_t>{0});
    // A right angle at a corner is none of them.
    town.lanes[0].links = {make_link(1, 3, Turn::straight), make_link(2, 4, Turn::right)};
    town.lanes[2] = make_lane("back", Turtle(102, -2, -quarter).ahead(100));
    town.lanes[2].links = {make_link(0, world::none, Turn::straight)};
    EXPECT_EQ(drivers::LaneGraph(town).choices(0), (std::vector<std::uint32_t>{0, 1}));
}

/// A street into a small ring of two lanes, whose outer one alone leads out:
///   0 in right, 1 in left -> 2 ring outer, 3 ring inner -> itself; 2 also -> 4 out
world::TownT roundabout() {
    constexpr double pi = std::numbers::pi;
    world::TownT town;
    town.name = "roundabout";
    town.lanes = {make_lane("in_0", Turtle(-100, 0, 0).ahead(100)),
                  make_lane("in_1", Turtle(-100, 3.5, 0).ahead(100)),
                  make_lane("ring_0", Turtle(0, 0, 0).turn(2 * pi, 18)),
                  make_lane("ring_1", Turtle(0, 3.5, 0).turn(2 * pi, 14.5)),
                  make_lane("out_0", Turtle(0, 0, 0).ahead(1500))};
    town.lanes[0].left = 1;
    town.lanes[1].right = 0;
    town.lanes[2].left = 3;
    town.lanes[3].right = 2;
    town.lanes[1].edge = town.lanes[0].edge;
    town.lanes[3].edge = town.lanes[2].edge;
    town.lanes[0].links = {make_link(2, world::none, Turn::straight)};
    town.lanes[1].links = {make_link(3, world::none, Turn::straight)};
    town.lanes[2].links = {make_link(2, world::none, Turn::left),
                           make_link(4, world::none, Turn::right)};
    town.lanes[3].links = {make_link(3, world::none, Turn::left)};
    town.lanes[4].links = {make_link(0, world::none, Turn::straight)};
    return town;
}

/// A street of two lanes whose right one goes on for so many metres and ends, beside one that leads
/// on:   0 right, 1 left -> 2 right, 3 left; 3 -> 4
world::TownT merging_road(double metres) {
    world::TownT town;
    town.name = "merging road";
    town.lanes = {make_lane("before_0", Turtle(-100, 0, 0).ahead(100)),
                  make_lane("before_1", Turtle(-100, 3.5, 0).ahead(100)),
                  make_lane("short_0", Turtle(0, 0, 0).ahead(metres)),
                  make_lane("short_1", Turtle(0, 3.5, 0).ahead(metres)),
                  make_lane("behind_0", Turtle(metres, 3.5, 0).ahead(1500))};
    for (const std::uint32_t right : {0u, 2u}) {
        town.lanes[right].left = right + 1;
        town.lanes[right + 1].right = right;
        town.lanes[right + 1].edge = town.lanes[right].edge;
        town.lanes[right].links.clear();
    }
    town.lanes[0].links = {make_link(2, world::none, Turn::straight)};
    town.lanes[1].links = {make_link(3, world::none, Turn::straight)};
    town.lanes[3].links = {make_link(4, world::none, Turn::straight)};
    town.lanes[4].links = {make_link(0, world::none, Turn::straight)};
    return town;
}

/// On a motorway of many short pieces one drove to the end of his lane, 4 m behind the last place
/// where he could leave it, and stood there for as long as the run lasted.
TEST(LaneGraph, WhoseLaneEndsTooSoonBehindTheNextJunctionLeavesItBefore) {
    const world::TownT soon = merging_road(4);
    const auto better = drivers::LaneGraph(soon).better_lane(0);
    ASSERT_TRUE(better);
    EXPECT_EQ(better->neighbour, 1u);
    const world::TownT later = merging_road(60);
    EXPECT_FALSE(drivers::LaneGraph(later).better_lane(0)) << "there is room for it there";
    EXPECT_TRUE(drivers::LaneGraph(later).better_lane(2));
}

TEST(Wandering, ALaneThatEndsTooSoonBehindTheNextJunctionIsLeftBefore) {
    for (const std::uint64_t seed : {1u, 7u, 21u}) {
        Drive drive(merging_road(4), seed);
        drive.place(0, 10, 10);
        double slowest = 10;
        while (drive.seconds() < 40 && drive.car.x < 100) {
            drive.step();
            slowest = std::min(slowest, drive.car.speed);
        }
        EXPECT_GT(drive.car.x, 99) << "seed " << seed;
        EXPECT_NEAR(drive.car.y, 3.5, 0.3);
        EXPECT_GT(slowest, 4) << "without a stop";
    }
}

TEST(LaneGraph, NobodyWandersRoundAndRoundARoundabout) {
    const world::TownT town = roundabout();
    const drivers::LaneGraph graph(town);
    for (std::uint32_t lane = 0; lane < 5; ++lane)
        EXPECT_EQ(graph.circles(lane), lane == 1 || lane == 3) << "lane " << lane;
    for (const std::uint32_t inner : {1u, 3u}) {
        const auto better = graph.better_lane(inner);
        ASSERT_TRUE(better);
        EXPECT_EQ(better->neighbour, inner - 1);
    }
    EXPECT_FALSE(graph.better_lane(0));
    EXPECT_FALSE(graph.better_lane(2));
    // Who could go into the circle goes elsewhere; who must, goes.
    world::TownT wide = roundabout();
    wide.lanes[0].links = {make_link(2, world::none, Turn::straight),
                           make_link(3, world::none, Turn::straight)};
    EXPECT_EQ(drivers::LaneGraph(wide).choices(0), std::vector<std::uint32_t>{0});
    EXPECT_EQ(graph.choices(1), std::vector<std::uint32_t>{0});
}

TEST(LaneGraph, PlansTheShorterWayThroughAllStops) {
    const world::TownT town = ring();
    const drivers::LaneGraph graph(town);
    using Lanes = std::vector<std::uint32_t>;
    EXPECT_EQ(graph.plan({0, 0}, Lanes{2}, 150).lanes, (Lanes{5, 2}));
    EXPECT_EQ(graph.plan({0, 0}, Lanes{1, 5}, 36).lanes, (Lanes{1, 2, 3, 0, 5}));
    EXPECT_EQ(graph.plan({4, 0}, Lanes{0}, 150).unreachable, 0u);
    const world::TownT two_lanes = ring_with_turning_lane();
    const drivers::LaneGraph wide(two_lanes);
    EXPECT_EQ(wide.plan({0, 100}, Lanes{5}, 20).lanes, (Lanes{13, 5}));
    EXPECT_EQ(wide.plan({0, 140}, Lanes{5}, 20).lanes, (Lanes{1, 2, 3, 0, 13, 5}));
    const auto around = wide.detour(0, Lanes{5}, 20);
    ASSERT_TRUE(around);
    EXPECT_EQ(around->link, 0u);
    EXPECT_EQ(around->plan.lanes, (Lanes{2, 3, 0, 13, 5}));
}

TEST(Autopilot, TakesTheRouteItIsGiven) {
    for (const std::uint32_t wanted : {1u, 5u, 4u}) {
        Drive drive(ring());
        drive.place(0, 5, 0);
        drive.autopilot->set_route({wanted}, drive.town.lanes[wanted].length);
        bool there = false;
        while (drive.seconds() < 100 && !there) {
            drive.step();
            there = drive.autopilot->path().front() == wanted;
            if (wanted == 5) {
                ASSERT_NE(drive.autopilot->path().front(), 1u);
            }
        }
        EXPECT_TRUE(there) << "lane " << wanted;
    }
}

TEST(Autopilot, SaysWhichLaneItsRouteCannotReach) {
    Drive drive(straight_road(300));
    drive.place(1, 5, 0);
    drive.autopilot->set_route({3}, drive.town.lanes[3].length);
    try {
        drive.step();
        FAIL() << "west_1 cannot be reached from east_1";
    } catch (const std::exception& error) {
        EXPECT_NE(std::string(error.what()).find("'west_1'"), std::string::npos) << error.what();
    }
}

TEST(Autopilot, ChangesLanesForItsRouteWhenThereIsRoom) {
    for (const bool occupied : {false, true}) {
        Drive drive(straight_road(600, 2));
        drive.place(1, 5, 10);
        drive.autopilot->set_route({2}, drive.town.lanes[2].length);
        const double target = drive.town.lanes[2].centre.front().y();
        double closest = 100;
        while (drive.seconds() < 25) {
            // Beside us for ten seconds, then it falls back.
            const double back = std::max(drive.seconds() - 10, 0.0) * 3;
            if (occupied)
                drive.cars = {car_at(1'000'000, drive.car.x - back, target, 0, drive.car.speed)};
            drive.step();
            if (occupied && back < 4)
                closest = std::min(closest, target - drive.car.y);
        }
        EXPECT_NEAR(drive.car.y, target, 0.2);
        if (occupied) {
            EXPECT_GT(closest, 2.8);
        }
    }
}

TEST(Autopilot, SharesTheRoomAmongAllChangesOfLanes) {
    Drive drive(straight_road(400, 4), 7, 0);
    drive.place(1, 5, 13);
    const std::uint32_t fourth = 4;
    drive.autopilot->set_route({fourth}, 140);
    const double target = drive.town.lanes[fourth].centre.front().y();
    double hardest = 0;
    while (drive.car.x < 135) {
        const double yaw = drive.car.yaw;
        drive.step();
        hardest = std::max(hardest, std::abs(drive.car.yaw - yaw) / 0.05 * drive.car.speed);
        ASSERT_LT(drive.seconds(), 60);
    }
    EXPECT_NEAR(drive.car.y, target, 0.3);
    EXPECT_LT(hardest, 4) << "[m/s^2] to the side";
}

/// Every order of a scenario that makes a new way, given while the car is between two lanes: it
/// goes on evenly, and ends up where the order sends it.
TEST(Autopilot, GoesOnWithAChangeOfLanesWhateverItIsToldMeanwhile) {
    struct Order {
        const char* what;
        void (*give)(drivers::Autopilot& autopilot);
        std::uint32_t ends_on;
    };

    const std::uint32_t own = 1, second = 2, third = 3;
    for (const Order& order :
         {Order{"the same again", [](auto& car) { car.change_lane(second); }, second},
          Order{"back", [](auto& car) { car.change_lane(own); }, own},
          Order{"one further", [](auto& car) { car.change_lane(third); }, third},
          Order{"a route", [](auto& car) { car.set_route({second}, 550); }, second},
          Order{"keep", [](auto& car) { car.keep_lane(true); }, second}})
        for (const double after : {1.2, 1.8, 2.5}) {
            SCOPED_TRACE(std::string(order.what) + " after " + std::to_string(after) + " s");
            Drive drive(straight_road(600, 4));
            drive.place(own, 5, 13);
            drive.step();
            drive.autopilot->change_lane(second);
            bool is_given = false;
            double hardest = 0;
            while (drive.seconds() < 20) {
                if (!is_given && drive.seconds() > after) {
                    order.give(*drive.autopilot);
                    is_given = true;
                }
                const double yaw = drive.car.yaw;
                drive.step();
                hardest = std::max(hardest, std::abs(drive.car.yaw - yaw) / 0.05 * drive.car.speed);
            }
            EXPECT_LT(hardest, 4) << "[m/s^2] to the side";
            EXPECT_NEAR(drive.car.y, drive.town.lanes[order.ends_on].centre.front().y(), 0.3);
        }
}

/// Drives until the car is on `lane`; the lanes on its way there.
std::set<std::uint32_t> lanes_until(Drive& drive, std::uint32_t lane) {
    std::set<std::uint32_t> seen;
    while (drive.seconds() < 150 && seen.count(lane) == 0) {
        drive.step();
        seen.insert(drive.autopilot->path().front());
    }
    return seen;
}

TEST(Autopilot, GoesAroundTheBlockWhenItIsTooLateToChangeLanes) {
    for (const double s : {30.0, 138.0}) {
        Drive drive(ring_with_turning_lane());
        drive.place(0, s, 13);
        drive.autopilot->set_route({5}, 20);
        const std::set<std::uint32_t> seen = lanes_until(drive, 5);
        EXPECT_EQ(seen.count(5), 1u) << "from " << s << " m";
        EXPECT_EQ(seen.count(1), s < 100 ? 0u : 1u) << "the long way, from " << s << " m";
    }
}

TEST(Autopilot, StaysOnTheLaneOfItsGoalUntilItIsThere) {
    for (const std::uint32_t start : {0u, 13u}) {
        // Who goes nowhere in particular leaves a lane that ends as soon as possible.
        world::TownT town = ring_with_turning_lane();
        town.lanes[13].links.clear();
        Drive drive(town);
        drive.place(start, 5, 8);
        drive.autopilot->set_route({13}, 110);
        while (drive.car.x < 109) {
            drive.step();
            ASSERT_LT(drive.seconds(), 60);
        }
        EXPECT_NEAR(drive.car.y, 3.5, 0.3) << "at the goal, from lane " << start;
        EXPECT_EQ(lanes_until(drive, 1).count(1), 1u) << "then it goes on";
    }
}

TEST(Autopilot, FindsItsRouteAgainWhenItIsPushedOffIt) {
    Drive drive(ring_with_turning_lane());
    drive.place(0, 5, 8);
    drive.autopilot->set_route({5}, 20);
    while (drive.car.x < 75)
        drive.step();
    ASSERT_NEAR(drive.car.y, 3.5, 0.5) << "on its lane to turn";
    drive.car.y -= 4.2;
    EXPECT_EQ(lanes_until(drive, 5).count(5), 1u);
}

TEST(Autopilot, LetsAChangeOfLanesBeThatComesTooLate) {
    for (const double s : {30.0, 140.0}) {
        Drive drive(ring_with_turning_lane());
        drive.place(0, s, 13);
        drive.step();
        drive.autopilot->change_lane(13);
        const std::uint32_t next = s < 100 ? 5 : 1;
        EXPECT_EQ(lanes_until(drive, next).count(next), 1u) << "from " << s << " m";
    }
}

TEST(Autopilot, GivesWayWhereItsLinkSaysSo) {
    for (const bool somebody : {true, false}) {
        Drive drive(ring());
        drive.place(5, 0, 5);
        bool waited = false;
        double s = 20;  // of a car that comes round the right bend, on the lane with priority
        while (drive.seconds() < 20) {
            s += 6 * 0.05;
            const world::LaneT& lane = drive.town.lanes[1];
            if (somebody && s < lane.length) {
                const world::LanePoint at = world::point_at(lane, s);
                world::CarState car =
                    car_at(1'000'000, at.position.x(), at.position.y(), at.yaw, 6);
                car.mutate_lane(1);
                car.mutate_lane_s(static_cast<float>(s + 3.7));
                drive.cars = {car};
            } else {
                drive.cars.clear();
            }
            drive.step();
            waited = waited || drive.car.speed < 1;
            if (somebody && s + drive.car.front() < lane.length - 15) {
                ASSERT_LT(drive.car.y + drive.car.front(), 48) << "at " << drive.seconds() << " s";
            }
        }
        EXPECT_EQ(waited, somebody);
        EXPECT_LT(drive.car.x, 150) << "goes on when the way is free";
    }
}

TEST(Autopilot, IndicatesBeforeItTurnsAndLightsUpInRain) {
    Drive drive(ring());
    drive.place(0, 60, 5);
    drive.autopilot->set_route({5}, drive.town.lanes[5].length);
    drive.step();
    EXPECT_EQ(drive.control.lamps(), 0);
    while (drive.car.x + drive.car.front() < 140)
        drive.step();
    EXPECT_EQ(drive.control.lamps(), world::lamp_left);
    drive.start.weather.mutate_rain(5);
    drive.step();
    EXPECT_EQ(drive.control.lamps(), world::lamp_left | world::lamp_low_beam);
}

TEST(Autopilot, EqualInputsGiveEqualControlsAndDigests) {
    Drive one(ring(), 3);
    Drive other(ring(), 3);
    one.place(0, 5, 0);
    other.place(0, 5, 0);
    std::set<std::uint64_t> digests;
    for (int i = 0; i < 1200; ++i) {
        one.step();
        other.step();
        ASSERT_EQ(one.control, other.control) << "tick " << i;
        ASSERT_EQ(one.autopilot->digest(), other.autopilot->digest()) << "tick " << i;
        digests.insert(one.autopilot->digest());
    }
    EXPECT_GT(digests.size(), 1000u) << "the digest hardly depends on the state";
    const std::uint64_t before = other.autopilot->digest();
    other.autopilot->set_speed(3);
    EXPECT_NE(other.autopilot->digest(), before);
}

}  // namespace
}  // namespace reprise::test
