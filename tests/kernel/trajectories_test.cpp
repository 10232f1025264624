// Whole runs in which the scenario says where somebody is.
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kernel/whole_run.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::test {
namespace {

/// What the tick holds of an actor, whatever moves it.
struct Sighting {
    Eigen::Vector3d position{0, 0, 0};
    double yaw = 0;
    double speed = 0;
    double pitch = 0;
};

std::optional<Sighting> look(const KeptTick& tick, std::uint32_t actor) {
    const world::TickView view = tick.recorded().view;
    if (const auto* vehicle = world::find(view.vehicles(), actor)) {
        const Eigen::Vector3d ahead =
            world::to_eigen(vehicle->orientation()) * Eigen::Vector3d::UnitX();
        return Sighting{world::to_eigen(vehicle->position()),
                        std::atan2(ahead.y(), ahead.x()),
                        world::to_eigen(vehicle->velocity()).dot(ahead),
                        std::asin(ahead.z())};
    }
    if (const auto* car = world::find(view.cars(), actor))
        return Sighting{world::to_eigen(car->position()),
                        static_cast<double>(car->yaw()),
                        static_cast<double>(car->speed()),
                        static_cast<double>(car->pitch())};
    if (const auto* walker = world::find(view.walkers(), actor))
        return Sighting{world::to_eigen(walker->position()),
                        static_cast<double>(walker->yaw()),
                        static_cast<double>(walker->speed()),
                        0};
    return std::nullopt;
}

/// [i] is tick i + 1.
std::vector<std::optional<Sighting>> seen(const std::string& body,
                                          double seconds,
                                          std::uint32_t actor = 1) {
    const world::Recording recording = on_straight_lanes(body, seconds);
    std::vector<std::optional<Sighting>> all;
    for (const KeptTick& tick : run(recording))
        all.push_back(look(tick, actor));
    return all;
}

std::string mistake(const std::string& body, double seconds = 3) {
    try {
        run(on_straight_lanes(body, seconds));
    } catch (const world::Error& error) {
        return error.what();
    }
    return "none";
}

std::size_t count_collisions(const std::vector<KeptTick>& ticks,
                             std::uint32_t actor,
                             std::uint32_t other) {
    std::size_t count = 0;
    for (const KeptTick& tick : ticks)
        for (const auto* event : *tick.recorded().view.tick->events())
            count += event->kind() == world::EventKind::collision && event->actor() == actor &&
                             event->other() == other
                         ? 1
                         : 0;
    return count;
}

constexpr const char* way =
    "ego:follow{ { t = 1, x = 112, y = -4.8 }, { t = 2, x = 125, y = -3 }, { t = 3.5, x = 150, y = "
    "-1.6 }, { t = 5, x = 180, y = -1.6 } }\n";

std::string spawn_driven_by(const std::string& driver) {
    return fmt::format(
        "local ego = spawn{{ model = '{}', driver = '{}', lane = 'main_1', s = 100 {} }}\n",
        driver == "walker" ? "adult" : "sedan",
        driver,
        driver == "walker" ? "" : ", speed = 10");
}

class Trajectories : public testing::TestWithParam<const char*> {};

/// Said in the first tick that the actor is there: tick 1; so t = 1 is tick 21.
TEST_P(Trajectories, AreKeptToTheMillimetreAtTheirTimes) {
    const std::string driver = GetParam();
    // Nobody walks 30 m in a second and a half.
    const std::string slow =
        "ego:follow{ { t = 1, x = 101, y = -4.8 }, { t = 2, x = 103, y = -3 }, { t = 3.5, x = 106, "
        "y = -1.6 }, { t = 5, x = 112, y = -1.6 } }\n";
    const auto ticks =
        seen(spawn_driven_by(driver) + (driver == "walker" ? slow : way) + "wait(100)", 9);
    const bool walks = driver == "walker";
    const std::map<std::size_t, Eigen::Vector2d> points{
        {21, {walks ? 101 : 112, -4.8}},
        {41, {walks ? 103 : 125, -3}},
        {71, {walks ? 106 : 150, -1.6}},
        {101, {walks ? 112 : 180, -1.6}},
    };
    for (const auto& [tick, p] : points) {
        ASSERT_TRUE(ticks[tick - 1].has_value());
        EXPECT_NEAR(ticks[tick - 1]->position.x(), p.x(), 1e-3) << driver << " tick " << tick;
        EXPECT_NEAR(ticks[tick - 1]->position.y(), p.y(), 1e-3) << driver << " tick " << tick;
    }
    EXPECT_NEAR(ticks[100]->yaw, 0, 1e-3);
    // Its speed is that of its way, and where it heads is where it goes.
    for (std::size_t i = 3; i < 100; ++i) {
        const Eigen::Vector3d moved = ticks[i]->position - ticks[i - 2]->position;
        EXPECT_NEAR(ticks[i - 1]->speed, moved.norm() / 0.1, 0.15) << driver << " tick " << i;
        EXPECT_NEAR(ticks[i - 1]->yaw, std::atan2(moved.y(), moved.x()), walks ? 0.1 : 0.03)
            << driver << i;
    }
    // Then it is left to itself: walkers stand, the others roll on from there at that speed.
    const Sighting behind = *ticks[101];
    const double speed = ticks[100]->speed;
    if (walks) {
        EXPECT_EQ(behind.speed, 0);
        EXPECT_EQ(ticks.back()->position, behind.position);
    } else {
        EXPECT_NEAR(behind.speed, speed, 0.6) << driver;
        EXPECT_NEAR(behind.position.x(), 180 + speed * 0.05, 0.05) << driver;
        EXPECT_NEAR(behind.position.y(), -1.6, 0.02) << driver;
    }
    if (driver == "autopilot" || driver == "traffic") {
        EXPECT_GT(ticks.back()->speed, 10) << driver << " drives on";
        EXPECT_NEAR(ticks.back()->position.y(), -1.6, 0.3) << driver << " in the lane it came to";
    }
}

INSTANTIATE_TEST_SUITE_P(OfEveryDriver,
                         Trajectories,
                         testing::Values("autopilot", "manual", "traffic", "walker"));

TEST(Trajectory, ClimbsWithTheGround) {
    for (const char* driver : {"manual", "traffic"}) {
        const auto ticks = seen(
            fmt::format("local ego = spawn{{ model = 'sedan', driver = '{}', lane = 'hill_0', s = "
                        "100 }}\n"
                        "ego:follow{{ {{ t = 4, lane = 'hill_0', s = 160 }} }} wait(100)",
                        driver),
            4.2);
        const double climb = std::atan(48.0 / 600);
        for (std::size_t i = 10; i < 80; ++i) {
            const Sighting& ego = *ticks[i];
            EXPECT_NEAR(ego.position.z(), ego.position.x() * 48 / 600, 0.02) << driver << i;
            EXPECT_NEAR(ego.pitch, climb, 0.005) << driver << i;
        }
        EXPECT_NEAR(ticks[80]->position.x(), 160 * std::cos(climb), 1e-3);
    }
}

TEST(Trajectory, TurnsTheWheels) {
    const world::Recording recording = on_straight_lanes(
        spawn_driven_by("manual") + "ego:follow{ { t = 4, x = 140, y = -4.8 } } wait(100)", 4);
    const auto ticks = run(recording);
    double turned = 0;
    for (std::size_t i = 20; i < 60; ++i) {
        const double change = ticks[i].recorded().view.wheels()[0].rotation() -
                              ticks[i - 1].recorded().view.wheels()[0].rotation();
        turned += change < 0 ? change + 2 * std::acos(-1.0) : change;
        for (int wheel = 0; wheel < 4; ++wheel)
            EXPECT_TRUE(ticks[i].recorded().view.wheels()[wheel].in_contact());
    }
    const double radius = world::vehicle_models()[0].wheel_radius;
    EXPECT_NEAR(turned * radius, 39.5 / 4 * 2, 0.01);  // from 100.5 on
}

/// One that is led at 10 m/s has no more than its momentum, which tests of crashes measure.
TEST(Trajectory, EndsInACrash) {
    const std::string body =
        "local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 100 }\n"
        "local other = spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 120 }\n"
        "ego:follow{ { t = 4, x = 140, y = -4.8 } }\n"
        "wait_until(function() return ego:collided() end)\n"
        "if ego:following() then error('it follows still') end wait(100)";
    const auto ticks = run(on_straight_lanes(body, 5));
    EXPECT_GT(count_collisions(ticks, 1, 2), 0U);
    EXPECT_EQ(count_collisions(ticks, 2, 1), 0U) << "told under the lower id";
    EXPECT_LT(look(ticks[80], 1)->position.x(), 125) << "both stand";
    EXPECT_LT(look(ticks[80], 2)->speed, 0.1);
}

/// 1 cm beside one of 1.82 m it is where it is to be.
TEST(Trajectory, IsKeptWhereOthersArePassedClosely) {
    const std::string body =
        "local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 100 }\n"
        "local other = spawn{ model = 'sedan', driver = 'manual', x = 120, y = -2.97, "
        "heading_deg = 0 }\n"
        "ego:follow{ { t = 4, x = 140, y = -4.8 } } wait(100)";
    const auto ticks = run(on_straight_lanes(body, 5));
    EXPECT_EQ(count_collisions(ticks, 1, 2), 0U);
    for (std::size_t tick = 21; tick < 80; ++tick)
        EXPECT_NEAR(look(ticks[tick], 1)->position.x(), 100 + 0.5 * static_cast<double>(tick), 1e-3)
            << tick;
}

/// Both are led.
TEST(Trajectory, OfTwoThatMeetIsACollision) {
    for (const char* driver : {"manual", "traffic", "parked"}) {
        const std::string other =
            std::string(driver) == "parked" ? "" : "other:follow{ { t = 4, x = 126, y = -4.8 } }\n";
        const std::string body = fmt::format(
            "local ego = spawn{{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 100 }}\n"
            "local other = spawn{{ model = 'sedan', driver = '{}', lane = 'main_1', s = 125 }}\n"
            "ego:follow{{ {{ t = 4, x = 140, y = -4.8 }} }}\n"
            "{} wait(100)",
            driver,
            other);
        const auto ticks = run(on_straight_lanes(body, 5));
        EXPECT_GT(count_collisions(ticks, 1, 2), 0U) << driver;
    }
}

TEST(Trajectory, LaysDownWhoIsInItsWay) {
    const auto ticks = run(on_straight_lanes(
        "local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 100 }\n"
        "spawn{ model = 'adult', lane = 'main_1', s = 120 }\n"
        "ego:follow{ { t = 4, x = 140, y = -4.8 } } wait(100)",
        5));
    EXPECT_EQ(count_collisions(ticks, 1, 2), 1U);
    EXPECT_NEAR(look(ticks[80], 1)->position.x(), 140, 1e-3);
}

TEST(Trajectory, EndsWhenItIsToldTo) {
    const std::string body = spawn_driven_by("autopilot") +
                             "ego:follow{ { t = 4, x = 140, y = -4.8 } }\n"
                             "check.eventually('ended', function() return tick() > 21 and not "
                             "ego:following() end)\n"
                             "wait(1) ego:follow(false) wait(3)";
    const auto ticks = run(on_straight_lanes(body, 5));
    EXPECT_NEAR(look(ticks[20], 1)->position.x(), 100.5 + 39.5 / 4, 1e-3);
    EXPECT_GT(look(ticks[79], 1)->position.x(), 141) << "faster than the trajectory had it";
}

TEST(Trajectory, MayCountFromTheStart) {
    const auto ticks = seen(spawn_driven_by("manual") +
                                "wait(0.5) ego:follow({ { t = 1, x = 112, y = -4.8 }, { t = 2, x = "
                                "122, y = -4.8 } }, { from = 'start' })\nwait(100)",
                            3);
    EXPECT_NEAR(ticks[19]->position.x(), 112, 1e-3);
    EXPECT_NEAR(ticks[39]->position.x(), 122, 1e-3);
}

TEST(Trajectory, IsKnownToEndInTheScenario) {
    const std::string body = spawn_driven_by("traffic") +
                             "ego:follow{ { t = 1, x = 112, y = -4.8 } }\n"
                             "wait_until(function() return not ego:following() end)\n"
                             "if tick() ~= 21 then error('at ' .. tick()) end\n"
                             "if math.abs(ego:x() - 112) > 0.001 then error('x ' .. ego:x()) end\n";
    EXPECT_EQ(mistake(body), "none");
}

// --- Where actors are put.

TEST(Teleport, PutsEveryDriverThereAndKeepsItsSpeed) {
    for (const char* driver : {"autopilot", "manual", "traffic"}) {
        const auto ticks = seen(
            spawn_driven_by(driver) + "wait(1) ego:teleport{ lane = 'main_2', s = 700 } wait(100)",
            3);
        const Sighting before = *ticks[19];
        const Sighting there = *ticks[20];
        // Nobody is at the wheel of the manual one: it brakes.
        EXPECT_NEAR(there.speed, before.speed, driver == std::string("manual") ? 0.6 : 0.1)
            << driver;
        EXPECT_NEAR(there.position.x(), 700 + before.speed * 0.05, 0.02) << driver;
        EXPECT_NEAR(there.position.y(), -1.6, 0.02) << driver;
        EXPECT_NEAR(ticks[59]->position.y(), -1.6, 0.1) << driver << " goes on from there";
    }
}

TEST(Teleport, ToAPoseWithASpeed) {
    for (const char* driver : {"autopilot", "manual", "traffic"}) {
        const auto ticks = seen(spawn_driven_by(driver) +
                                    "wait(1) ego:teleport{ x = 300, y = -5.3, heading_deg = 2, "
                                    "speed = 20 } wait(100)",
                                3);
        const Sighting there = *ticks[20];
        EXPECT_NEAR(there.speed, 20, driver == std::string("manual") ? 0.6 : 0.1) << driver;
        EXPECT_NEAR(there.position.x(), 301, 0.05) << driver;
        EXPECT_NEAR(there.position.y(), -5.3 + std::sin(0.035), 0.06) << driver;
        EXPECT_NEAR(there.yaw, 0.035, 0.02) << driver;
    }
}

TEST(Teleport, IsNotDriven) {
    const std::string body = spawn_driven_by("autopilot") +
                             "wait(1) local before = ego:distance_driven()\n"
                             "ego:teleport{ lane = 'main_1', s = 700 } wait(0.1)\n"
                             "local driven = ego:distance_driven() - before\n"
                             "if driven > 1.5 or driven < 0.8 then error('driven ' .. driven) end";
    EXPECT_EQ(mistake(body), "none");
}

TEST(Teleport, LeavesASleepingNeighbourInPeace) {
    // Two metres to the side: a box that swept over there would push with 40 m/s.
    const auto ticks = run(on_straight_lanes(
        "local ego = spawn{ model = 'sedan', driver = 'manual', lane = 'main_1', s = 100 }\n"
        "local car = spawn{ model = 'sedan', driver = 'traffic', lane = 'main_1', s = 92 }\n"
        "car:set_speed(0) wait(1)\n"
        "car:teleport{ lane = 'main_1', s = 108, speed = 0 } wait(1)",
        3));
    EXPECT_EQ(count_collisions(ticks, 1, 2), 0U);
}

TEST(SetVelocity, IsAtOnceAlongItsHeading) {
    for (const char* driver : {"autopilot", "manual", "traffic"}) {
        const auto ticks =
            seen(spawn_driven_by(driver) + "wait(1) ego:set_velocity(25) wait(100)", 2);
        EXPECT_NEAR(ticks[20]->speed, 25, driver == std::string("manual") ? 0.6 : 0.1) << driver;
        EXPECT_NEAR(ticks[20]->position.x() - ticks[19]->position.x(), 1.25, 0.05) << driver;
    }
    const auto backwards =
        seen(spawn_driven_by("manual") + "wait(1) ego:set_velocity(-5) wait(100)", 2);
    EXPECT_NEAR(backwards[20]->speed, -5, 0.6);
}

TEST(SpawnByPose, StandsThereOnTheGround) {
    for (const char* driver : {"autopilot", "manual", "traffic", "parked"}) {
        const auto ticks =
            seen(fmt::format(
                     "spawn{{ model = 'sedan', driver = '{}', x = 300, y = -304.4, heading_deg = "
                     "1 }} wait(100)",
                     driver),
                 0.5);
        const Sighting first = *ticks[0];
        EXPECT_NEAR(first.position.x(), 300, 0.05) << driver;
        EXPECT_NEAR(first.position.y(), -304.4, 0.05) << driver;
        EXPECT_NEAR(first.position.z(), 24, 0.05) << driver;
        EXPECT_NEAR(first.yaw, 0.01745, 0.02) << driver;
        EXPECT_NEAR(first.pitch, std::atan(0.08), 0.01) << driver;
    }
}

TEST(SpawnByPose, AnywhereThatThereIsGround) {
    const auto ticks = seen(
        "spawn{ model = 'sedan', driver = 'manual', x = 200, y = 40, heading_deg = 135 } wait(100)",
        2);
    EXPECT_NEAR(ticks[0]->position.x(), 200, 1e-3);
    EXPECT_NEAR((ticks[39]->position - ticks[0]->position).norm(), 0, 0.05) << "it stands";
    EXPECT_EQ(mistake("spawn{ name = 'ego', model = 'sedan', x = 200, y = 40, heading_deg = 0 }"),
              "test.lua:3: spawn: 'ego' at (200.00, 40.00) heading 0.0 degrees would be on no lane "
              "that leads its way; 'main_2' is 41.6 m away: driver = 'autopilot' follows lanes");
}

TEST(SpawnByRelation, MeasuresFromBumperToBumper) {
    const std::string ego = "local ego = spawn{ model = 'van', lane = 'main_1', s = 300 }\n";
    for (const auto& [where, lane] :
         std::map<std::string, std::string>{{"ahead_of = ego, gap = 30", "main_1"},
                                            {"behind = ego, gap = 30", "main_1"},
                                            {"ahead_of = ego, gap = 30, lane = 'left'", "main_2"},
                                            {"behind = ego, gap = 30, lane = 'right'", "main_0"}}) {
        const std::string body =
            ego + fmt::format(
                      "local other = spawn{{ model = 'lorry', driver = 'manual', {} }}\n"
                      "wait_ticks(1)\n"
                      "local g = gap(ego, other)\n"
                      "if math.abs(g - 30) > 0.02 then error('gap ' .. g) end\n"
                      "if other:lane() ~= '{}' then error(other:lane()) end\n",
                      where,
                      lane);
        EXPECT_EQ(mistake(body), "none") << where;
    }
    EXPECT_EQ(mistake(ego + "local other = spawn{ model = 'sedan', beside = ego, lane = 'left' }\n"
                            "wait_ticks(1) if math.abs(other:x() - ego:x()) > 0.1 then "
                            "error(other:x()) end"),
              "none");
}

TEST(SpawnByRelation, WaitsForOneWhoIsGivenItsPlace) {
    EXPECT_EQ(mistake("local ego = spawn{ model = 'sedan' }\n"
                      "local other = spawn{ model = 'sedan', ahead_of = ego, gap = 5 }\n"
                      "wait_ticks(1) if gap(ego, other) > 6 then error(gap(ego, other)) end"),
              "none");
}

}  // namespace
}  // namespace reprise::test
