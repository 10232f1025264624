#include "traffic/sight/passing.h"

#include <cmath>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/towns.h"
#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "traffic/cars/fleet.h"
#include "traffic/sight/obstructions.h"
#include "traffic/sight/pulling_out.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/town.h"

namespace reprise::traffic {
namespace {

constexpr double step = 0.05;
constexpr double bend_start = 60;  // [m]
constexpr double radius = 12;      // [m]

/// One lane each way; from 60 m on to the right.
world::TownT road_with_a_bend(double straight) {
    world::TownT town = test::straight_road(200, 1);
    for (world::LaneT& lane : town.lanes) {
        const world::LaneT before = lane;
        lane.centre.clear();
        lane.length = 0;
        for (double s = 0; s <= before.length; s += 1) {
            Eigen::Vector3d p = world::point_at(before, s).position;
            const double turned = std::max(p.x() - straight, 0.0) / radius;
            if (turned > 0)
                p.head<2>() = Eigen::Vector2d(straight + (radius + p.y()) * std::sin(turned),
                                              -radius + (radius + p.y()) * std::cos(turned));
            if (!lane.centre.empty())
                lane.length += (p - world::to_eigen(lane.centre.back())).norm();
            lane.centre.push_back(world::to_vec3(p));
        }
        lane.sumo_length = lane.length;
    }
    return town;
}

std::uint32_t lane_of(const world::TownT& town, const char* name) {
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        if (town.lanes[i].name == name)
            return i;
    return world::none;
}

Car car_on(const world::TownT& town, std::uint32_t id, double front, std::uint16_t model = 0) {
    Car car;
    car.id = id;
    car.model = model;
    car.sumo = "known";
    car.lane = lane_of(town, "east_1");
    car.lane_position = front;
    const world::LanePoint at = world::point_at(town.lanes[car.lane], front);
    car.turn_to(at.yaw);
    const Eigen::Vector3d ahead(std::cos(at.yaw), std::sin(at.yaw), 0);
    car.trail.start(at.position, -ahead, origin_to_front(car.model));
    car.rear = car.trail.rear();
    car.standing_ticks = car.stuck_ticks = 1000;
    return car;
}

/// Who stands `gap` [m] behind a vehicle with mass, which has stood for long; and a queue before
/// it.
struct Behind {
    Behind(const world::TownT& town,
           double gap,
           const std::vector<double>& queue_ahead = {},
           std::uint16_t model = 0)
        : lanes(town),
          obstructions(town, lanes, step),
          passing(town, obstructions, step),
          last(who_stands(town)) {
        world::TickDraft draft;
        cars.add(car_on(town, 1000000, rear_end - gap, model), "", 0, draft);
        for (const double front : queue_ahead)
            cars.add(
                car_on(town, 1000000 + static_cast<std::uint32_t>(front), front), "", 0, draft);
        for (int i = 0; i < 800; ++i)
            obstructions.look(last.view(), cars.all());
    }

    static world::SealedTick who_stands(const world::TownT& town) {
        const world::LaneT& lane = town.lanes[lane_of(town, "east_1")];
        const world::VehicleModel& sedan = world::vehicle_models()[0];
        const world::LanePoint at = world::point_at(lane, rear_end + sedan.rear_overhang);
        return test::tick_with({test::vehicle_at(9, at.position.x(), at.position.y(), at.yaw)});
    }

    Car& car() { return cars[0]; }

    bool begins() {
        passing.begin(car(), cars, last.view(), 900);
        return car().pass.has_value();
    }

    bool goes_aside() { return car().offset_order && car().offset_order->change.to != 0; }

    static constexpr double rear_end = 50;  // [m] of who stands

    const world::LaneMap lanes;
    Obstructions obstructions;
    Passing passing;
    Cars cars;
    world::SealedTick last;
};

/// Does it go around it?
bool passes(const world::TownT& town,
            double gap,
            const std::vector<double>& queue_ahead = {},
            std::uint16_t model = 0) {
    return Behind(town, gap, queue_ahead, model).begins();
}

/// At 2.4 m a corner swept over an ego's rear in Town07: it pulls out as steeply as it can.
TEST(Passing, WhoStandsCloseBehindHasNoRoomToPullOut) {
    const world::TownT town = road_with_a_bend(1000);
    EXPECT_TRUE(passes(town, 5.5)) << "nothing is shown";
    EXPECT_FALSE(passes(town, 2.4));
    EXPECT_FALSE(passes(town, 1.5));
}

/// The longer it is the later its side clears the corner.
TEST(Passing, LorriesAndBusesNeedMoreRoomThanCars) {
    const world::TownT town = road_with_a_bend(1000);
    const std::uint16_t lorry = *world::find_vehicle_model("lorry");
    const std::uint16_t bus = *world::find_vehicle_model("bus");
    EXPECT_TRUE(passes(town, 3));
    EXPECT_FALSE(passes(town, 3, {}, lorry));
    EXPECT_TRUE(passes(town, 4.5, {}, lorry));
    EXPECT_FALSE(passes(town, 4.5, {}, bus));
    EXPECT_TRUE(passes(town, 6, {}, bus));
}

/// A bus, in its first tick slower than what counts as driving, gave up for having stood for long;
/// and a few millimetres aside never began again.
TEST(Passing, WhoHasWaitedForLongDrivesOnOnceItHasBegun) {
    const world::TownT town = road_with_a_bend(1000);
    Behind behind(town, 6, {}, *world::find_vehicle_model("bus"));
    ASSERT_TRUE(behind.begins());
    behind.car().offset = 0.003;
    behind.car().speed = 0.06;
    behind.car().standing_ticks = 1001;
    behind.passing.follow(behind.car(), 901);
    EXPECT_TRUE(behind.goes_aside());

    behind.car().pass.reset();
    behind.car().offset_order = OffsetOrder{{0.003, 0, 2.5, world::Shape::linear}, 900};
    behind.car().speed = 0;
    EXPECT_TRUE(behind.begins());
    EXPECT_TRUE(behind.goes_aside());
}

/// Who has stood for long in a queue waits as everybody there does.
TEST(Passing, NobodyPassesAQueueThatGoesOnRoundABend) {
    const world::TownT town = road_with_a_bend(bend_start);
    EXPECT_TRUE(passes(town, 5.5)) << "nothing is shown";
    EXPECT_FALSE(passes(town, 5.5, {bend_start + 14}));
}

/// SUMO counts the rest of a change in whole milliseconds, and asserts before a turn that one is
/// left: who stood a few centimetres from the end of a change stopped the run.
/// A wreck across the line between two lanes stood before a queue on both of them for half an hour.
TEST(Passing, WhereEachLaneIsBlockedTheInnerOneGoesThroughTheOncomingOne) {
    const test::Loaded& loaded = test::own_town("town1");
    const std::uint32_t inner = test::lane(loaded.town, "l1_t1_2");
    const std::uint32_t outer = test::lane(loaded.town, "l1_t1_1");
    const double s = 100;
    const std::vector<world::VehicleState> wrecks{
        test::vehicle_on(loaded.town.lanes[inner], 1, s),
        test::vehicle_on(loaded.town.lanes[outer], 2, s),
    };
    test::Stage stage(loaded, 100, 2);
    std::map<std::uint32_t, double> before;
    int past = 0;
    for (int i = 0; i < 6000; ++i) {
        stage.step({}, wrecks);
        for (const world::CarState& car : stage.view().cars()) {
            if (car.lane() != inner && car.lane() != outer)
                continue;
            const double at = static_cast<double>(car.lane_s());
            const auto last = before.find(car.id());
            const bool is_past = last != before.end() && last->second < s && at > s;
            ASSERT_FALSE(is_past && car.lane() == outer) << "through the wreck";
            past += is_past;
            before[car.id()] = at;
        }
    }
    EXPECT_GT(past, 3);
}

TEST(PullingOut, WhatIsLeftOfAChangeTakesAStepAndNoLess) {
    for (const double off : {0.004, 0.02, 0.05, 0.3, 1.6})
        for (const double side : {-1, 1}) {
            const double pace = PullingOut::pace_to_end_change(side * off, false, step);
            EXPECT_GE(off / pace, 0.001) << off;
            EXPECT_LE(off / pace, step) << off;
        }
    constexpr double lane = 3.5;  // [m] almost all of it is left of a change that has begun
    EXPECT_LE(lane / PullingOut::pace_to_end_change(0.02, true, step), step);
    EXPECT_GT(PullingOut::pace_to_end_change(0, false, step), 0) << "SUMO divides by it";
}

}  // namespace
}  // namespace reprise::traffic
