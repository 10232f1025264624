#include "traffic/background.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>
#include <libsumo/libsumo.h>

#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "traffic/car_reader.h"
#include "traffic/sumo.h"
#include "world/check.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {
namespace {

using test::own_town;
using test::Stage;

std::vector<std::uint64_t> digests(std::uint64_t seed, int ticks) {
    Stage stage(own_town("town1"), 60, seed);
    std::vector<std::uint64_t> all;
    for (int i = 0; i < ticks; ++i) {
        stage.step();
        all.push_back(stage.digest());
    }
    return all;
}

TEST(Background, EqualSeedsGiveEqualRunsInAWarmProcess) {
    const auto first = digests(7, 600);
    const auto other = digests(8, 600);
    const auto again = digests(7, 600);
    EXPECT_EQ(first, again);
    EXPECT_NE(first.front(), other.front());
    EXPECT_NE(first.back(), other.back());
}

/// Before SUMO's own chance could show: which car stands on which lane.
TEST(Background, WhoComesAndWhereIsDrawnFromTheSeed) {
    const auto first_cars = [](std::uint64_t seed) {
        Stage stage(own_town("town1"), 60, seed);
        std::vector<std::pair<std::uint32_t, std::uint16_t>> lanes_and_models;
        for (const world::CarState& car : stage.step().traffic.cars)
            lanes_and_models.emplace_back(car.lane(), car.model());
        return lanes_and_models;
    };
    EXPECT_EQ(first_cars(7), first_cars(7));
    EXPECT_NE(first_cars(7), first_cars(8));
}

TEST(Background, SumosChanceIsThatOfTheSeed) {
    for (const std::uint64_t seed : {7ULL, 8ULL, 123'456'789'012ULL}) {
        const Stage stage(own_town("town1"), 0, seed);
        EXPECT_EQ(libsumo::Simulation::getOption("seed"), std::to_string(sumo_seed(seed)));
    }
    EXPECT_NE(sumo_seed(7), sumo_seed(8));
}

TEST(Background, ASecondOneAtATimeIsRefused) {
    const world::EpisodeT episode = test::episode();
    const auto& [network, town] = own_town("town2");
    const world::LaneMap lanes(town);
    const Background first(episode, town, lanes, network.xml);
    EXPECT_THROW(Background(episode, town, lanes, network.xml), std::logic_error);
}

TEST(Background, AStepOfPartialMillisecondsIsTheUsersMistake) {
    world::EpisodeT episode = test::episode();
    episode.step_ns = 16'666'667;
    const auto& [network, town] = own_town("town2");
    const world::LaneMap lanes(town);
    EXPECT_THROW(Background(episode, town, lanes, network.xml), world::Error);
}

TEST(Background, KeepsTheNumberFromTheFirstTickOn) {
    Stage stage(own_town("town1"), 100);
    std::set<std::uint32_t> ids;
    for (int i = 0; i < 400; ++i) {
        const auto& cars = stage.step().traffic.cars;
        ASSERT_EQ(cars.size(), 100U) << "tick " << i + 1;
        EXPECT_TRUE(std::is_sorted(cars.begin(), cars.end(), [](const auto& p, const auto& q) {
            return p.id() < q.id();
        }));
        for (const world::CarState& car : cars)
            ids.insert(car.id());
    }
    EXPECT_GE(*ids.begin(), world::first_background_id);
}

TEST(Background, CarsThatLeaveAtADeadEndAreReplacedByNewOnes) {
    // Two dead ends and nothing else: everybody leaves after 20 s.
    const test::Loaded road{
        {"road",
         R"(<net version="1.9"><edge id="r" from="A" to="B"><lane id="r_0" index="0" speed="13.89" length="300" shape="0,0 300,0"/></edge>)"
         R"(<junction id="A" type="dead_end" x="0" y="0" incLanes="" intLanes="" shape="0,0 0,-3"/>)"
         R"(<junction id="B" type="dead_end" x="300" y="0" incLanes="r_0" intLanes="" shape="300,0 300,-3"/></net>)",
         ""},
        {}};
    test::Loaded loaded = road;
    loaded.town = read_town(loaded.network);
    Stage stage(loaded, 5);
    std::set<std::uint32_t> ids;
    int gone = 0;
    for (int i = 0; i < 1000; ++i) {
        const world::TickDraft& tick = stage.step();
        EXPECT_EQ(tick.traffic.cars.size(), 5U) << "tick " << i + 1;
        for (const world::CarState& car : tick.traffic.cars)
            ids.insert(car.id());
        for (const auto& event : tick.tick.events)
            gone += event.kind == world::EventKind::despawned;
    }
    EXPECT_GT(gone, 5);
    EXPECT_EQ(ids.size(), 5U + static_cast<std::size_t>(gone)) << "ids are never used again";
}

TEST(Background, SaysWhenTheTownIsTooSmall) {
    Stage stage(own_town("town2"), 2000);
    const world::TickDraft& tick = stage.step();
    const auto said = std::find_if(
        tick.tick.events.begin(), tick.tick.events.end(), [](const world::EventT& event) {
            return event.kind == world::EventKind::printed;
        });
    ASSERT_NE(said, tick.tick.events.end());
    EXPECT_NE(said->text.find("2000 cars were asked for"), std::string::npos);
    EXPECT_GT(tick.traffic.cars.size(), 60U);
    for (std::size_t i = 0; i < tick.traffic.cars.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto& p = tick.traffic.cars[i].position();
            const auto& q = tick.traffic.cars[j].position();
            EXPECT_GT(std::hypot(p.x() - q.x(), p.y() - q.y()), 1.5);
        }
}

TEST(Background, CarsMoveAlongTheirLanesWithoutJumps) {
    const world::TownT& town = own_town("town1").town;
    Stage stage(own_town("town1"), 100);
    stage.step();
    std::map<std::uint32_t, world::CarState> before;
    int checked = 0;
    for (int i = 0; i < 600; ++i) {
        for (const world::CarState& car : stage.draft().traffic.cars)
            before.insert_or_assign(car.id(), car);
        stage.step();
        for (const world::CarState& car : stage.draft().traffic.cars) {
            const auto old = before.find(car.id());
            ASSERT_NE(old, before.end());
            const double moved = std::hypot(car.position().x() - old->second.position().x(),
                                            car.position().y() - old->second.position().y());
            EXPECT_LT(moved, static_cast<double>(car.speed()) * 0.05 * 1.25 + 0.25) << car.id();
            const double turned = std::remainder(static_cast<double>(car.yaw() - old->second.yaw()),
                                                 2 * std::numbers::pi);
            EXPECT_LT(std::abs(turned), 0.25) << car.id();
            // The rear axle lies on the road, and lane_s is the front bumper's (up to a slip, see
            // smooth()).
            if (i % 50 == 0 && town.lanes[car.lane()].kind == world::LaneKind::driving) {
                const auto& model = world::vehicle_models()[car.model()];
                const double ahead = model.length - model.rear_overhang;
                const Eigen::Vector3d front(
                    car.position().x() + ahead * std::cos(static_cast<double>(car.yaw())),
                    car.position().y() + ahead * std::sin(static_cast<double>(car.yaw())),
                    0);
                const auto on = world::project(town.lanes[car.lane()], front);
                EXPECT_NEAR(on.s, static_cast<double>(car.lane_s()), 3.0) << car.id();
                // A lane wide at most: who must stop in the middle of a change of lanes stands
                // there.
                EXPECT_LT(std::abs(on.t), car.speed() > 1 ? 2.0 : 3.3) << car.id();
                ++checked;
            }
        }
    }
    EXPECT_GT(checked, 500);
}

/// Traffic does not ask SUMO for what follows from a car's speed.
TEST(Background, EveryCarIsWhereSumoHasItsBumper) {
    const world::TownT& town = own_town("town1").town;
    Stage stage(own_town("town1"), 150);
    int driving = 0;
    for (int i = 0; i < 400; ++i) {
        stage.step();
        for (const world::CarState& car : stage.draft().traffic.cars) {
            const world::LaneT& lane = town.lanes[car.lane()];
            const double position = libsumo::Vehicle::getLanePosition(sumo_id(car.id()));
            ASSERT_EQ(
                car.lane_s(),
                static_cast<float>(world::rounded(position * lane.length / lane.sumo_length, 1024)))
                << car.id() << " in tick " << stage.tick();
            // Of one that stands the lane is not asked: see LaneChangePace.
            if (car.speed() == 0)
                continue;
            ASSERT_EQ(lane.name, libsumo::Vehicle::getLaneID(sumo_id(car.id()))) << car.id();
            ++driving;
        }
    }
    EXPECT_GT(driving, 20'000);
}

TEST(Background, WritesRoundedNumbers) {
    Stage stage(own_town("town1"), 20);
    stage.steps(40);
    for (const world::CarState& car : stage.draft().traffic.cars) {
        const double x = car.position().x() * 1024;
        EXPECT_EQ(x, std::nearbyint(x));
        const double yaw = static_cast<double>(car.yaw()) * 8192;
        EXPECT_EQ(yaw, std::nearbyint(yaw));
        EXPECT_LE(std::abs(car.yaw()), std::numbers::pi_v<float>);
    }
}

TEST(Background, EverySignalHasItsColourAndConflictsAreNeverGreenTogether) {
    const world::TownT& town = own_town("town1").town;
    Stage stage(own_town("town1"), 0);
    std::set<world::SignalColor> seen;
    // b1: signal 0 is the side street's right turn, 5 the avenue straight on.
    std::size_t street = 0;
    std::size_t avenue = 0;
    for (std::size_t i = 0; i < town.signals.size(); ++i)
        if (town.signals[i].program == "b1") {
            if (town.lanes[town.signals[i].lane].name == "a1_b1_1")
                street = i;
            if (town.lanes[town.signals[i].lane].name == "l1_b1_1")
                avenue = i;
        }
    ASSERT_NE(street, avenue);
    for (int i = 0; i < 800; ++i) {
        const auto& signals = stage.step().tick.signals;
        ASSERT_EQ(signals.size(), town.signals.size());
        seen.insert(signals.begin(), signals.end());
        const auto go = [](world::SignalColor color) {
            return color == world::SignalColor::green || color == world::SignalColor::green_minor;
        };
        EXPECT_FALSE(go(signals[street]) && go(signals[avenue])) << "tick " << i + 1;
    }
    EXPECT_TRUE(seen.contains(world::SignalColor::red));
    EXPECT_TRUE(seen.contains(world::SignalColor::yellow));
    EXPECT_TRUE(seen.contains(world::SignalColor::green));
    EXPECT_TRUE(seen.contains(world::SignalColor::green_minor));
    EXPECT_FALSE(seen.contains(world::SignalColor::off));
}

TEST(Background, LeavesTheScenariosPlacesFree) {
    const auto& loaded = own_town("town1");
    const std::uint32_t place = test::lane(loaded.town, "b3_r1_1");
    const world::LanePoint at = world::point_at(loaded.town.lanes[place], 40);
    const world::CommandT vehicle = test::spawn(1, place, 40, 0, world::Driver::autopilot);
    world::CommandT by_pose = test::spawn(1, world::none, 0, 0, world::Driver::autopilot);
    by_pose.has_pose = true;
    by_pose.target = world::to_vec3(at.position);
    by_pose.heading = at.yaw;
    const world::CommandT walker = test::spawn(1, place, 40, 0, world::Driver::walker, 0.5);
    const world::CommandT prop = test::spawn(1, place, 40, 0, world::Driver::prop, 0.5);
    for (const world::CommandT& command : {vehicle, by_pose, walker, prop}) {
        for (std::uint64_t seed = 1; seed <= 5; ++seed) {
            Stage stage(loaded, 150, seed);
            stage.step({command});
            for (const world::CarState& car : stage.draft().traffic.cars)
                EXPECT_GT(std::hypot(car.position().x() - at.position.x(),
                                     car.position().y() - at.position.y()),
                          car.lane() == place ? 10 : 2)
                    << EnumNameDriver(command.driver) << (command.has_pose ? " by its pose" : "");
        }
    }
}

/// As some maps draw a way through a junction; a car turned by 25 degrees within a tick there.
TEST(CarReader, NobodyTurnsOnTheSpotWhereALaneTurnsBack) {
    constexpr double step = 0.05;
    constexpr double degree = std::numbers::pi / 180;
    EXPECT_DOUBLE_EQ(CarReader::turned(1, 1.1, step), 1.1);
    double yaw = 170 * degree;
    int ticks = 0;
    for (const double wanted = -30 * degree; yaw != wanted && ticks < 100; ++ticks) {
        const double next = CarReader::turned(yaw, wanted, step);
        const double turn = world::wrap_angle(next - yaw);
        EXPECT_GT(turn, 0) << "the shorter way";
        EXPECT_LT(turn, 9 * degree);
        EXPECT_EQ(next, world::wrap_angle(next));
        yaw = next;
    }
    EXPECT_EQ(ticks, 19);
}

}  // namespace
}  // namespace reprise::traffic
