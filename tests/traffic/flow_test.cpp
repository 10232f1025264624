#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "traffic/sight/stuck.h"
#include "world/geometry2d.h"
#include "world/lanes/density.h"
#include "world/models/actors.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {
namespace {

using test::own_town;
using test::Stage;

constexpr int minute = 1200;  // [ticks]

/// What became of a run's background cars.
struct Flow {
    double mean_speed = 0;  ///< [m/s] of the last minute
    int longest_halt = 0;   ///< [ticks] of one car
};

Flow flow_of(const char* town, std::uint32_t cars, std::uint64_t seed, int minutes) {
    Stage stage(own_town(town), cars, seed);
    Flow flow;
    std::map<std::uint32_t, int> halted;
    double sum = 0;
    std::size_t count = 0;
    for (int tick = 0; tick < minutes * minute; ++tick) {
        for (const world::CarState& car : stage.step().traffic.cars) {
            int& ticks = halted[car.id()];
            ticks = car.speed() < 0.1F ? ticks + 1 : 0;
            flow.longest_halt = std::max(flow.longest_halt, ticks);
            if (tick >= (minutes - 1) * minute) {
                sum += static_cast<double>(car.speed());
                ++count;
            }
        }
    }
    flow.mean_speed = sum / static_cast<double>(count);
    return flow;
}

TEST(Flow, TenMinutesOfSeventyCarsInTown2) {
    const Flow flow = flow_of("town2", 70, 1, 10);
    EXPECT_GT(flow.mean_speed, 2.5) << "9 km/h";
    EXPECT_LT(flow.longest_halt, 2 * minute);
}

/// A car that stands where everybody comes onto a road: who wanted to go there takes another one,
/// and lets those behind him go on.
TEST(Flow, WhoFindsHisRoadFullTurnsOffElsewhere) {
    const test::Loaded& town2 = own_town("town2");
    Stage stage(town2, 30, 3);
    world::CommandT stop = test::command(world::CommandKind::set_speed, 1);
    stop.speed = 0;
    stage.step({test::spawn(1, test::lane(town2.town, "b1_d1_1"), 1), stop});
    std::map<std::uint32_t, int> halted;
    int longest = 0;
    for (int tick = 0; tick < 5 * minute; ++tick)
        for (const world::CarState& car : stage.step().traffic.cars) {
            int& ticks = halted[car.id()];
            ticks = car.speed() < 0.1F && car.id() != 1 ? ticks + 1 : 0;
            longest = std::max(longest, ticks);
        }
    EXPECT_LT(longest, minute);
}

/// Behind one who never drives on, in sight of a vehicle with mass.
TEST(Flow, WhoIsStuckInSightOfTheEgoIsTakenOutInTheEnd) {
    const test::Loaded& town2 = own_town("town2");
    const std::uint32_t road = test::lane(town2.town, "b1_d1_1");
    Stage stage(town2, 40, 3);
    world::CommandT stop = test::command(world::CommandKind::set_speed, 1);
    stop.speed = 0;
    const double blocked = town2.town.lanes[road].length - 6;
    const world::LanePoint near = world::point_at(town2.town.lanes[road], blocked);
    // In sight of the queue, and far from every road.
    const Eigen::Vector2d beside = near.position.head<2>() - 40 * world::left_of(near.yaw);
    const auto ego = test::vehicle_at(2, beside.x(), beside.y(), near.yaw);
    stage.step({test::spawn(1, road, blocked - 5), stop}, {ego});
    std::map<std::uint32_t, int> halted;
    int longest = 0;
    for (int tick = 0; tick < 4 * minute; ++tick)
        for (const world::CarState& car : stage.step({}, {ego}).traffic.cars) {
            int& ticks = halted[car.id()];
            ticks = car.speed() < 0.1F && car.id() != 1 ? ticks + 1 : 0;
            longest = std::max(longest, ticks);
        }
    EXPECT_GT(longest, 2 * minute) << "nobody was stuck: nothing is shown";
    EXPECT_LT(longest, 3 * minute);
}

/// Behind a vehicle with mass that stands at the end of a way through a junction for ever. In the
/// second one SUMO lets who waits inch on, some millimetres every few seconds.
TEST(Flow, WhoIsStuckInAJunctionIsTakenOutInTheEndWhoeverIsBeside) {
    const test::Loaded& town2 = own_town("town2");
    const auto& lanes = town2.town.lanes;
    for (const char* blocked : {":l2_0_0", ":a1_1_0"}) {
        const world::LaneT& way = lanes[test::lane(town2.town, blocked)];
        const world::LanePoint end = world::point_at(way, way.length);
        const auto ego = test::vehicle_at(2, end.position.x(), end.position.y(), end.yaw);
        Stage stage(town2, 60, 8);
        std::map<std::uint32_t, int> halted;
        int longest = 0;
        for (int tick = 0; tick < 8 * minute; ++tick)
            for (const world::CarState& car : stage.step({}, {ego}).traffic.cars) {
                int& ticks = halted[car.id()];
                const bool inside = car.lane() != world::none &&
                                    lanes[car.lane()].kind == world::LaneKind::internal;
                ticks = inside && car.speed() < 0.1F ? ticks + 1 : 0;
                longest = std::max(longest, ticks);
            }
        EXPECT_GT(longest, 0.5 * minute) << blocked << ": nobody was stuck, nothing is shown";
        EXPECT_LT(longest, 1.0 * minute) << blocked;
    }
}

/// He is in a row, as before a light: it would be the ego's neighbour who vanishes. In a ring of
/// those he is taken out in the end as well.
TEST(Flow, WhoStandsInAJunctionRightBehindTheEgoStaysTwiceAsLong) {
    const test::Loaded& town2 = own_town("town2");
    const std::uint32_t across = test::lane(town2.town, ":a1_1_0");
    const world::LaneT& way = town2.town.lanes[across];
    const world::LanePoint end = world::point_at(way, way.length);
    const auto ego = test::vehicle_at(2, end.position.x(), end.position.y(), end.yaw);
    Stage stage(town2, 60, 7);
    std::vector<world::VehicleState> vehicles;  // the ego comes behind somebody drove in
    std::map<std::uint32_t, int> halted;
    int longest = 0;
    for (int tick = 0; tick < 8 * minute; ++tick)
        for (const world::CarState& car : stage.step({}, vehicles).traffic.cars) {
            const bool inside = car.lane() == across;
            if (inside && car.lane_s() < 6)
                vehicles = {ego};
            int& ticks = halted[car.id()];
            ticks = inside && car.speed() < 0.1F ? ticks + 1 : 0;
            longest = std::max(longest, ticks);
        }
    EXPECT_GT(longest, 1.5 * minute);
    EXPECT_LT(longest, 1.8 * minute);
}

/// As two do that meet in a bend, each with its body in the other one's way: nobody solves it.
TEST(Flow, WhoStandsForAnotherCarForMinutesIsTakenOutWhoeverSeesIt) {
    constexpr double step = 0.05;  // [s]
    Car car;
    car.stuck_ticks = 4 * minute;
    EXPECT_FALSE(waits_for_ever(car, step)) << "a queue before the ego";
    car.waits_for = {1000008};
    EXPECT_TRUE(waits_for_ever(car, step));
    car.stuck_ticks = 3 * minute;
    EXPECT_FALSE(waits_for_ever(car, step));
}

/// On the ramp of a motorway the first of a queue stood so for 520 s, and an ego behind him.
TEST(Demand, WhoFindsNoGapAtTheEndOfHisLaneIsTakenOut) {
    world::TownT town = test::straight_road(200);
    Car car;
    car.lane = 1;
    town.lanes[1].links.clear();
    town.lanes[1].sumo_length = 200;
    car.lane_position = 198;
    car.stuck_ticks = minute;
    EXPECT_TRUE(is_at_an_end(car, 0.05, town));
    car.lane_position = 150;
    EXPECT_FALSE(is_at_an_end(car, 0.05, town)) << "behind others";
    car.lane_position = 198;
    car.stuck_ticks = minute / 2;
    EXPECT_FALSE(is_at_an_end(car, 0.05, town));
    car.stuck_ticks = minute;
    const auto leads_to = [&](std::uint32_t lane) {
        town.lanes[1].links.assign(
            1, {lane, world::none, 0, world::Turn::straight, false, std::uint16_t{0}});
    };
    leads_to(0);
    EXPECT_TRUE(is_at_an_end(car, 0.05, town)) << "onto the sidewalk";
    leads_to(3);
    EXPECT_FALSE(is_at_an_end(car, 0.05, town)) << "it leads on";
}

/// In a bend a lorry that pushed past a car stood so for 28 s.
TEST(Demand, OfTwoWhoStandInEachOtherInAJunctionWhoStoodLongerIsTakenOut) {
    constexpr double step = 0.05;
    world::TownT town = test::straight_road(200);
    std::vector<Car> cars(2);
    for (Car& car : cars) {
        car.lane = 1;
        car.stuck_ticks = 140;
    }
    cars[0].id = 7;
    cars[1].id = 8;
    cars[1].rear.y() = 1.5;
    cars[1].stuck_ticks = 160;
    const auto taken_out = [&](std::size_t i) {
        return lies_in_one_who_stands(cars[i], cars, step, town);
    };
    EXPECT_FALSE(taken_out(1)) << "on a road, where lanes are narrow";
    cars[0].stuck_ticks = 1240;
    cars[1].stuck_ticks = 1260;
    EXPECT_FALSE(taken_out(1)) << "side by side before a light";
    cars[1].turn_to(M_PI);
    EXPECT_TRUE(taken_out(1)) << "of two that meet in a bend";
    EXPECT_FALSE(taken_out(0));
    cars[1].turn_to(0);
    cars[0].stuck_ticks = 140;
    cars[1].stuck_ticks = 160;
    town.lanes[1].kind = world::LaneKind::internal;
    EXPECT_TRUE(taken_out(1));
    EXPECT_FALSE(taken_out(0)) << "the other one is";
    cars[0].stuck_ticks = 160;
    EXPECT_TRUE(taken_out(0)) << "one of two who stood as long";
    EXPECT_FALSE(taken_out(1));
    cars[0].stuck_ticks = 50;
    EXPECT_FALSE(taken_out(1)) << "the other one has just come";
    cars[0].stuck_ticks = 70;
    EXPECT_FALSE(taken_out(1)) << "they have, both";
    cars[1].stuck_ticks = 180;
    EXPECT_TRUE(taken_out(1)) << "it stood there before the other one came";
    cars[1].stuck_ticks = 160;
    cars[0].stuck_ticks = 140;
    cars[1].rear.y() = 2.5;
    EXPECT_FALSE(taken_out(1)) << "side by side";
    cars[1].rear = {0, 1.5, 6};
    EXPECT_FALSE(taken_out(1)) << "on a bridge";
}

/// In a bend an ego and a lorry stood so for 500 s, each with half a queue behind it.
TEST(Demand, WhoStandsNoseToNoseWithAVehicleWithMassIsTakenOut) {
    constexpr double step = 0.05;
    Car car;  // a sedan at the origin, eastbound
    const double gap = 2;
    const double between = 2 * world::extent_of(world::vehicle_models()[car.model]).front + gap;
    const auto before = [&](double yaw, double distance, double speed) {
        return test::tick_with({test::vehicle_at(1, distance, 0, yaw, speed)});
    };
    car.stuck_ticks = 2200;
    EXPECT_TRUE(faces_one_who_stands(car, step, before(M_PI - 0.2, between, 0).view()));
    EXPECT_FALSE(faces_one_who_stands(car, step, before(0, between, 0).view())) << "in a queue";
    EXPECT_FALSE(faces_one_who_stands(car, step, before(M_PI, between, 0.5).view()))
        << "who goes back";
    EXPECT_FALSE(faces_one_who_stands(car, step, before(M_PI, between + 5, 0).view()))
        << "there is room between";
    car.stuck_ticks = 1900;
    EXPECT_FALSE(faces_one_who_stands(car, step, before(M_PI, between, 0).view()));
}

/// Of a full town, where one waits at a minor road until he is let in. Town 1 has no dead end, at
/// which cars leave.
TEST(Flow, NobodyWhoWaitedForLongIsTakenOutAsHeDrivesIntoAJunction) {
    const test::Loaded& town1 = own_town("town1");
    int drove_in = 0;
    for (const std::uint64_t seed : {3, 4}) {
        Stage stage(town1, 110, seed);
        std::map<std::uint32_t, int> waited;  // [ticks] before a junction
        for (int tick = 0; tick < 3 * minute / 2; ++tick) {
            const auto& cars = stage.step().traffic.cars;
            for (const auto& [id, ticks] : waited)
                ASSERT_NE(stage.car(id), nullptr) << id << " waited for " << ticks << " ticks";
            for (const world::CarState& car : cars) {
                int& ticks = waited[car.id()];
                const bool inside = town1.town.lanes[car.lane()].kind == world::LaneKind::internal;
                drove_in += inside && ticks > 31 * minute / 60;
                ticks = !inside && car.speed() < 1 ? ticks + 1 : 0;
            }
        }
    }
    EXPECT_GT(drove_in, 0) << "nobody waited: nothing is shown";
}

TEST(Flow, AsManyCarsAsATownCarriesAreThereInTheFirstTick) {
    for (const char* town : {"town1", "town2", "straight", "curves", "junctions"}) {
        const std::uint32_t carried = world::cars_carried(own_town(town).town);
        Stage stage(own_town(town), carried);
        EXPECT_EQ(stage.step().traffic.cars.size(), carried) << town;
    }
}

}  // namespace
}  // namespace reprise::traffic
