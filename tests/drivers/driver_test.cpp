#include "drivers/driver.h"

#include <algorithm>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "drivers/way/lane_graph.h"
#include "tests/drivers/kinematic_car.h"

namespace reprise::test {
namespace {

using world::LaneKind;
using world::SignalColor;
using world::Turn;

constexpr double quarter = std::numbers::pi / 2;

/// A way that is one lane.
world::TownT one_lane(const Turtle& turtle, double limit = 13.89) {
    world::TownT town;
    town.name = "one_lane";
    town.lanes.push_back(make_lane("way", turtle, limit));
    return town;
}

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

/// Two straight lanes with a signal and a junction of 10 m between them.
world::TownT signalled_junction() {
    world::TownT town;
    town.name = "signalled";
    town.lanes = {
        make_lane("before", Turtle(0, 0, 0).ahead(200)),
        make_lane("behind", Turtle(210, 0, 0).ahead(200)),
        make_lane(":j", Turtle(200, 0, 0).ahead(10), 13.89, LaneKind::internal),
    };
    town.junctions.resize(1);
    town.lanes[0].junction = 0;
    town.lanes[0].links = {make_link(1, 2, Turn::straight, false, 0)};
    town.signals.resize(1);
    return town;
}

world::WalkerState walker_at(double x, double y, double yaw, double speed) {
    return {world::Vec3(x, y, 0),
            static_cast<float>(yaw),
            static_cast<float>(speed),
            0,
            9,
            1,
            false,
            0,
            0};
}

TEST(Autopilot, KeepsAStraightLaneAndItsLimit) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 0);
    double fastest = 0;
    while (drive.seconds() < 60) {
        drive.step();
        EXPECT_LT(drive.off_centre(), 0.05);
        fastest = std::max(fastest, drive.car.speed);
        if (drive.seconds() > 20) {
            EXPECT_GT(drive.car.speed, 0.9 * 13.89) << "at " << drive.seconds() << " s";
        }
    }
    EXPECT_LT(fastest, 13.89);
}

TEST(Autopilot, ReturnsToItsLaneFromTheSide) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(400)));
    drive.place(0, 5, 10);
    drive.car.y = 1.2;
    double farthest_right = 0;
    while (drive.seconds() < 10) {
        drive.step();
        farthest_right = std::min(farthest_right, drive.car.y);
    }
    EXPECT_LT(drive.off_centre(), 0.05);
    EXPECT_GT(farthest_right, -0.15) << "overshoots";
}

class AutopilotInBends : public testing::TestWithParam<double> {};

TEST_P(AutopilotInBends, KeepsItsLane) {
    const double radius = GetParam();
    for (const double side : {1.0, -1.0}) {
        Drive drive(one_lane(Turtle(0, 0, 0)
                                 .ahead(120)
                                 .turn(side * quarter, radius)
                                 .ahead(30)
                                 .turn(-side * quarter, radius)
                                 .ahead(100)));
        drive.place(0, 5, 12);
        double sharpest = 0;
        while (drive.seconds() < 40) {
            drive.step();
            const double turn =
                std::tan(drive.car.steering_angle) / world::vehicle_models()[0].wheelbase;
            sharpest = std::max(sharpest, drive.car.speed * drive.car.speed * std::abs(turn));
            ASSERT_LT(drive.off_centre(), 0.3)
                << "radius " << radius * side << " m, at " << drive.seconds() << " s, "
                << drive.car.speed << " m/s";
        }
        EXPECT_LT(sharpest, 3.5) << "lateral acceleration";
    }
}

INSTANTIATE_TEST_SUITE_P(Radii, AutopilotInBends, testing::Values(6.0, 9.0, 15.0, 30.0, 80.0));

TEST(Autopilot, ObeysTheCapUntilItIsLifted) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 13);
    drive.autopilot->set_speed(6);
    while (drive.seconds() < 15)
        drive.step();
    EXPECT_NEAR(drive.car.speed, 6, 0.3);
    EXPECT_TRUE(drive.autopilot->is_under_way());
    drive.autopilot->set_speed(0);
    EXPECT_FALSE(drive.autopilot->is_under_way());
    drive.autopilot->free_speed();
    while (drive.seconds() < 35)
        drive.step();
    EXPECT_GT(drive.car.speed, 0.9 * 13.89);
}

TEST(Autopilot, StopsWhereTheRoadEndsAndStays) {
    Drive drive(straight_road(200));
    drive.place(1, 5, 10);
    drive.step();
    EXPECT_TRUE(drive.autopilot->is_under_way());
    while (drive.seconds() < 40)
        drive.step();
    EXPECT_FALSE(drive.autopilot->is_under_way());
    const double left = 200 - drive.car.x - drive.car.front();
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_GT(left, 0.5);
    EXPECT_LT(left, 2);
}

TEST(Autopilot, StopsBeforeRedAndGoesOnGreen) {
    Drive drive(signalled_junction());
    drive.place(0, 5, 12);
    drive.signals = {SignalColor::red};
    double hardest = 0;
    while (drive.seconds() < 40) {
        drive.step();
        hardest = std::max(hardest, drive.control.brake() * 9);
        ASSERT_LT(drive.car.x + drive.car.front(), 200);
    }
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_NEAR(drive.car.x + drive.car.front(), 199, 0.5);
    EXPECT_LT(hardest, 5);  // standing on the brake counts as 4.5
    drive.signals = {SignalColor::green};
    while (drive.seconds() < 60)
        drive.step();
    EXPECT_GT(drive.car.x, 220);
}

TEST(Autopilot, StopsAtYellowOnlyWhereThatIsComfortable) {
    for (const double distance : {15.0, 60.0}) {
        Drive drive(signalled_junction());
        drive.place(0, 200 - distance - drive.car.front(), 13);
        double most_brake = 0;
        while (drive.seconds() < 10) {
            drive.signals = {drive.seconds() < 3 ? SignalColor::yellow : SignalColor::red};
            drive.step();
            most_brake = std::max(most_brake, drive.control.brake());
        }
        if (distance < 20) {
            EXPECT_GT(drive.car.x, 210);
            EXPECT_LT(most_brake, 0.1);
        } else {
            EXPECT_LT(drive.car.x + drive.car.front(), 200);
            EXPECT_LT(most_brake * 9, 5);
        }
    }
}

TEST(Autopilot, KeepsItsDistanceFromASlowLeader) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 13);
    double leader = 80;
    while (drive.seconds() < 40) {
        drive.cars = {car_at(1'000'000, leader, 0, 0, 5)};
        drive.step();
        leader += 5 * 0.05;
        const double gap = leader - 1.0 - drive.car.x - drive.car.front();
        ASSERT_GT(gap, 4) << "at " << drive.seconds() << " s";
    }
    const double gap = leader - 1.0 - drive.car.x - drive.car.front();
    EXPECT_NEAR(drive.car.speed, 5, 0.3);
    EXPECT_LT(gap, 15);
}

TEST(Autopilot, StopsBehindAStandingCarAndGoesOnAfterIt) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    double leader = 200;
    while (drive.seconds() < 40) {
        drive.cars = {car_at(1'000'000, leader, 0)};
        drive.step();
    }
    const double gap = leader - 1.0 - drive.car.x - drive.car.front();
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_GT(gap, 1.5);
    EXPECT_LT(gap, 5);
    while (drive.seconds() < 60) {
        leader += 8 * 0.05;
        drive.cars = {car_at(1'000'000, leader, 0, 0, 8)};
        drive.step();
    }
    EXPECT_GT(drive.car.speed, 6);
}

TEST(Autopilot, DoesNotPanicWhenSomebodyFasterCutsIn) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(1500)));
    drive.place(0, 5, 10);
    drive.autopilot->set_speed(10);
    double x = 0;
    double y = 3.5;
    double hardest = 0;
    while (drive.seconds() < 15) {
        // Beside us at first, then four metres ahead, from the left lane into ours.
        x = drive.car.x + drive.car.front() + 5 + std::max(drive.seconds() - 3, 0.0) * 1.5;
        y = std::clamp(3.5 - (drive.seconds() - 3) * 1.2, 0.0, 3.5);
        drive.cars = {car_at(1'000'000, x, y, 0, 11.5)};
        drive.step();
        hardest = std::max(hardest, drive.control.brake() * 9);
    }
    EXPECT_LT(hardest, 4);
    EXPECT_GT(hardest, 0.1) << "does not notice it at all";
}

TEST(Autopilot, PassesCarsThatStandBesideItsLane) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    drive.cars = {car_at(1'000'000, 150, -2.6), car_at(1'000'001, 180, 3.5, std::numbers::pi)};
    while (drive.seconds() < 25) {
        drive.step();
        if (drive.seconds() > 1) {
            EXPECT_GT(drive.car.speed, 0.9 * 13.89);
        }
    }
}

class AutopilotAndWalkers : public testing::TestWithParam<double> {};

TEST_P(AutopilotAndWalkers, StopsForOneWhoStepsOntoTheRoad) {
    const double speed = GetParam();
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    double y = -1.5 - 2 * speed;
    double closest = 100;
    while (drive.seconds() < 30) {
        // Starts when the car is 35 m away, is at its path two seconds later - when the car would
        // be a metre or two past - and stops in the middle of the lane for a while.
        const bool walks = drive.car.x + drive.car.front() > 165 && (y < 0 || drive.seconds() > 22);
        y += walks ? speed * 0.05 : 0;
        drive.walkers = {walker_at(200, y, quarter, walks ? speed : 0)};
        drive.step();
        const double gap = 200 - 0.25 - drive.car.x - drive.car.front();
        if (std::abs(y) < 1.2)
            closest = std::min(closest, gap);
    }
    EXPECT_GT(closest, 0.5);
    EXPECT_GT(drive.car.x, 200) << "goes on when the way is free";
}

INSTANTIATE_TEST_SUITE_P(Speeds, AutopilotAndWalkers, testing::Values(1.3, 2.0, 3.5));

TEST(Autopilot, IgnoresWalkersOnTheSidewalk) {
    Drive drive(one_lane(Turtle(0, 0, 0).ahead(600)));
    drive.place(0, 5, 13);
    double x = 150;
    while (drive.seconds() < 20) {
        x += 1.3 * 0.05;
        drive.walkers = {walker_at(x, -3.5, 0, 1.3)};
        drive.step();
        if (drive.seconds() > 1) {
            EXPECT_GT(drive.car.speed, 0.9 * 13.89);
        }
    }
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

TEST(Autopilot, DoesNotBlockAJunctionWithoutAWayOut) {
    Drive drive(signalled_junction());
    drive.place(0, 100, 10);
    drive.signals = {SignalColor::green};
    drive.cars = {car_at(1'000'000, 215, 0)};  // stands just behind the junction
    while (drive.seconds() < 25)
        drive.step();
    EXPECT_EQ(drive.car.speed, 0);
    EXPECT_LT(drive.car.x + drive.car.front(), 200);
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
