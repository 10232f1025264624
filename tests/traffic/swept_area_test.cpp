#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "ground/obstacles.h"
#include "tests/support/towns.h"
#include "tests/support/worlds.h"
#include "tests/traffic/stage.h"
#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {
namespace {

using test::lane;
using test::own_town;
using test::spawn;
using test::Stage;

constexpr std::uint32_t the_bus = 10;
constexpr std::uint32_t beside = 90;

BodyBox bus_body(const world::CarState& car) {
    const world::VehicleModel& model = world::vehicle_models()[car.model()];
    const Eigen::Vector2d ahead = world::ahead_of(static_cast<double>(car.yaw()));
    return {Eigen::Vector2d(car.position().x(), car.position().y()) +
                (model.length / 2 - model.rear_overhang) * ahead,
            ahead,
            model.length / 2,
            model.width / 2};
}

struct BusDrive {
    int touched = 0;   ///< ticks
    int in_walls = 0;  ///< ticks in which a pole, a trunk or a house stands in it
    bool came_through = false;
    bool came_close = false;
    double stood = 0;              ///< [s] at a stretch
    double deepest = 0;            ///< [m] in somebody
    double fastest_in_reach = 0;   ///< [m/s] while it swings over who stands there
    double farthest = 0;           ///< [m] of a rear corner beyond its lane's edge
    Eigen::Vector2d corner{0, 0};  ///< where that was,
    int corner_tick = 0;           ///< and when
};

bool stands_in(const world::Obstacle& wall, const BodyBox& body) {
    const Eigen::Vector2d to = wall.position.head<2>() - body.middle;
    const Eigen::Vector2d beyond(std::abs(to.dot(body.ahead)) - body.half_length,
                                 std::abs(world::cross(body.ahead, to)) - body.half_width);
    return beyond.cwiseMax(0.0).norm() < std::min(wall.half.x(), wall.half.y());
}

/// A bus from this lane over the next junction, past somebody who stands at `place`: a cyclist for
/// longer than a bus waits for what has no mass, or on foot with this id. `comes_close`: the
/// cyclist is there only once the bus is a few centimetres from it.
BusDrive drive_bus(const char* name,
                   std::optional<Eigen::Vector2d> place,
                   std::uint32_t on_foot = 0,
                   bool comes_close = false) {
    const auto& loaded = own_town("town1");
    const world::TownT& town = loaded.town;
    Stage stage(loaded, 0);
    const std::uint32_t from = lane(town, name);
    world::CommandT bus = spawn(the_bus, from, town.lanes[from].length - 20, 5);
    bus.model = world::find_vehicle_model("bus").value();
    BusDrive drive;
    const std::vector<world::Obstacle> walls = ground::obstacles_of(town);
    std::vector<world::VehicleState> vehicles;
    if (place && on_foot != 0) {
        stage.walkers.emplace_back(world::Vec3(place->x(), place->y(), 0),
                                   0.0F,
                                   0.0F,
                                   0.0F,
                                   on_foot,
                                   std::uint16_t{0},
                                   false,
                                   std::uint8_t{0},
                                   1U);
    }
    const world::VehicleModel& bicycle =
        world::vehicle_models()[world::find_vehicle_model("bicycle").value()];
    const auto cyclist = [&] {
        const world::Vec3& at = vehicles[0].position();
        const Eigen::Vector2d middle(at.x() + bicycle.length / 2 - bicycle.rear_overhang, at.y());
        return BodyBox{middle, Eigen::Vector2d::UnitX(), bicycle.length / 2, bicycle.width / 2};
    };
    const auto come_nearer = [&](const BodyBox& body) {
        const Eigen::Vector2d across = world::turned_left(body.ahead);
        const double side = std::copysign(0.01, across.dot(body.middle - cyclist().middle));
        for (int i = 0; i < 40 && !overlap(body.widened(0.06), cyclist()); ++i) {
            const Eigen::Vector2d at =
                world::in_plan(vehicles[0].position()).head<2>() + side * across;
            vehicles[0].mutable_position().mutate_x(at.x());
            vehicles[0].mutable_position().mutate_y(at.y());
        }
        drive.came_close = overlap(body.widened(0.06), cyclist());
    };
    if (place && on_foot == 0) {
        vehicles.push_back(test::vehicle_at(beside, place->x(), place->y(), 0, 0));
        vehicles[0].mutate_model(world::find_vehicle_model("bicycle").value());
    }
    double stood = 0;
    for (int tick = 0; tick < 2400 && !drive.came_through; ++tick) {
        if (tick == (on_foot != 0 ? 900 : 1500)) {  // they go away
            vehicles.clear();
            stage.walkers.clear();
        }
        stage.step(tick == 0 ? std::vector<world::CommandT>{bus} : std::vector<world::CommandT>(),
                   vehicles);
        const world::CarState* car = stage.car(the_bus);
        if (car == nullptr || car->lane() == world::none)
            continue;
        const BodyBox body = bus_body(*car);
        drive.in_walls += std::any_of(
            walls.begin(), walls.end(), [&](const auto& wall) { return stands_in(wall, body); });
        // Where the lane behind is short it comes round again, and stands elsewhere.
        stood = car->speed() < 0.05F && tick < 500 ? stood + 0.05 : 0;
        drive.stood = std::max(drive.stood, stood);
        if (!stage.walkers.empty() && overlap(body, {*place, Eigen::Vector2d::UnitX(), 0.2, 0.2})) {
            ++drive.touched;
            drive.deepest =
                std::max(drive.deepest, depth(body, {*place, Eigen::Vector2d::UnitX(), 0.2, 0.2}));
            drive.fastest_in_reach =
                std::max(drive.fastest_in_reach, static_cast<double>(car->speed()));
        }
        if (!vehicles.empty()) {
            drive.touched += overlap(body, cyclist());
            if (comes_close && !drive.came_close && stood > 2)
                come_nearer(body);
        }
        for (const double side : {-1.0, 1.0}) {
            const Eigen::Vector2d corner = body.middle - body.half_length * body.ahead +
                                           side * body.half_width * world::turned_left(body.ahead);
            const Eigen::Vector3d p(corner.x(), corner.y(), car->position().z());
            const double out =
                std::abs(world::project(town.lanes[from], p).t) - town.lanes[from].width / 2;
            const double s = world::project(town.lanes[from], p).s;
            if (s > 0 && s < town.lanes[from].length - 0.5 && out > drive.farthest) {
                drive.farthest = out;
                drive.corner_tick = tick;
                drive.corner = corner - 0.15 * side * world::turned_left(body.ahead);
            }
        }
        drive.came_through = town.lanes[car->lane()].kind == world::LaneKind::driving &&
                             car->lane() != from && car->lane_s() > 12;
    }
    return drive;
}

constexpr const char* bends[]{"a1_b1_1",
                              "b1_a1_1",
                              "a2_l1_1",
                              "a3_m2w_1",
                              "b2_m1_1",
                              "c1_m1_1",
                              "c2_r1_1",
                              "a1_m1_1",
                              "b3_c1_1",
                              "c3_m2e_1",
                              "a2_a3_1",
                              "c1_c2_1"};

TEST(SweptArea, ABusWaitsForWhoStandsWhereItsTailSwingsOut) {
    int shown = 0;
    for (const char* name : bends) {
        const BusDrive alone = drive_bus(name, std::nullopt);
        ASSERT_TRUE(alone.came_through) << name;
        EXPECT_EQ(alone.in_walls, 0) << name << ": something stands where it sweeps";
        if (alone.farthest < 0.25)
            continue;
        ++shown;
        const BusDrive past = drive_bus(name, alone.corner);
        EXPECT_EQ(past.touched, 0) << name << ": its tail swings out by " << alone.farthest;
        EXPECT_TRUE(past.came_through) << name;
    }
    EXPECT_GT(shown, 2) << "no tail swings out: nothing is shown";
}

/// At a red light a bus waited to turn off, an ego came up beside it: both started, and its tail
/// came over the line.
TEST(SweptArea, ABusKeepsItsTailOffWhoDrivesPastIt) {
    const auto& loaded = own_town("town1");
    const auto bicycle = world::find_vehicle_model("bicycle").value();
    const world::VehicleModel& model = world::vehicle_models()[bicycle];
    int shown = 0;
    for (const char* name : bends) {
        const BusDrive alone = drive_bus(name, std::nullopt);
        if (alone.farthest < 0.25)
            continue;
        ++shown;
        for (const int late : {-45, -30, -15, 0, 15, 30, 45}) {
            const double speed = 3.5;
            Stage stage(loaded, 0);
            const std::uint32_t from = lane(loaded.town, name);
            const double length = loaded.town.lanes[from].length;
            const double yaw = world::point_at(loaded.town.lanes[from], length - 1).yaw;
            // Beside the line, where the corner comes farthest over it.
            const world::LaneProjection there =
                world::project(loaded.town.lanes[from], {alone.corner.x(), alone.corner.y(), 0});
            const double aside =
                std::copysign(loaded.town.lanes[from].width / 2 + 0.2, there.t) - there.t;
            const Eigen::Vector2d start =
                alone.corner + aside * world::turned_left(world::ahead_of(yaw));
            world::CommandT bus = spawn(the_bus, from, length - 20, 5);
            bus.model = world::find_vehicle_model("bus").value();
            stage.step({bus});
            int touched = 0;
            for (int tick = 1; tick < alone.corner_tick + 100; ++tick) {
                const Eigen::Vector2d middle =
                    start + 0.05 * (tick - alone.corner_tick - late) * speed * world::ahead_of(yaw);
                const Eigen::Vector2d p =
                    middle - (model.length / 2 - model.rear_overhang) * world::ahead_of(yaw);
                std::vector<world::VehicleState> vehicles{
                    test::vehicle_at(beside, p.x(), p.y(), yaw, speed)};
                vehicles[0].mutate_model(bicycle);
                stage.step({}, vehicles);
                const world::CarState* car = stage.car(the_bus);
                if (car != nullptr)
                    touched += overlap(bus_body(*car),
                                       {middle, world::ahead_of(yaw), model.length / 2, 0.3});
            }
            EXPECT_EQ(touched, 0) << name << ", " << late << " ticks later";
        }
    }
    EXPECT_GT(shown, 2) << "no tail swings out: nothing is shown";
}

TEST(SweptArea, ABusThatIsNextToSomebodyAlreadySwingsNoFurther) {
    int shown = 0;
    for (const char* name : bends) {
        const BusDrive alone = drive_bus(name, std::nullopt);
        if (alone.farthest < 0.25)
            continue;
        const BusDrive past = drive_bus(name, alone.corner, 0, true);
        shown += static_cast<int>(past.came_close);
        EXPECT_EQ(past.touched, 0) << name << ": its tail swings out by " << alone.farthest;
        EXPECT_TRUE(past.came_through) << name;
    }
    EXPECT_GT(shown, 1) << "nobody comes close: nothing is shown";
}

/// Of the town's people nobody stays under a tail (walkers/threats.h): here they do, to be seen.
TEST(SweptArea, ABusRollsSlowlyPastPeopleAtTheKerbAndBlocksNoJunctionForThem) {
    constexpr std::uint32_t townsman = 100'000'007;
    constexpr std::uint32_t of_scenario = 50;
    int shown = 0;
    for (const char* name : bends) {
        const BusDrive alone = drive_bus(name, std::nullopt);
        if (alone.farthest < 0.25)
            continue;
        const BusDrive waits = drive_bus(name, alone.corner, of_scenario);
        EXPECT_EQ(waits.touched, 0) << name << ": a scenario's walker stays where he is told";
        if (waits.stood < alone.stood + 5)
            continue;
        ++shown;
        const BusDrive past = drive_bus(name, alone.corner, townsman);
        EXPECT_TRUE(past.came_through) << name;
        EXPECT_LT(past.stood, alone.stood + 6) << name;
        EXPECT_GT(past.touched, 0) << name;
        EXPECT_LT(past.deepest, 0.3) << name << ": first it lets him out";
        EXPECT_LT(past.fastest_in_reach, 0.2) << name << ": who stands has no way out, or not yet";
    }
    EXPECT_GT(shown, 0) << "nobody is in its way: nothing is shown";
}

struct Encounter {
    double deepest = 0;  ///< [m] of the two in each other
    double waited = 0;   ///< [s] near each other, both of them standing
    bool bus_is_through = false;
    bool other_is_through = false;
};

/// A bus stands in a narrow bend for half a minute, behind a car that stands there, as a queue
/// does; another one of this model comes towards it. `place` [m] along the lane, of the car.
Encounter meet_bus_in_bend(const char* model, double place) {
    constexpr std::uint32_t ahead = 11;
    constexpr std::uint32_t other = 12;
    constexpr int ticks = 1600;
    constexpr int queue_ends = 700;  // tick
    const auto& loaded = own_town("town1");
    const world::TownT& town = loaded.town;
    const std::uint32_t there = lane(town, "a2_l1_1");
    const std::uint32_t back = lane(town, "l1_a2_1");
    world::CommandT bus = spawn(the_bus, there, place - 45, 5);
    bus.model = world::find_vehicle_model("bus").value();
    world::CommandT comes = spawn(other, back, 5, 5);
    comes.model = world::find_vehicle_model(model).value();
    const world::CommandT stop = test::command(world::CommandKind::set_speed, ahead);  // to 0
    const world::CommandT go = test::command(world::CommandKind::free_speed, ahead);
    Stage stage(loaded, 0);
    Encounter met;
    for (int tick = 0; tick < ticks; ++tick) {
        std::vector<world::CommandT> commands;
        if (tick == 0)
            commands = {bus, spawn(ahead, there, place), comes, stop};
        if (tick == queue_ends)
            commands = {go};
        stage.step(commands);
        const world::CarState* one = stage.car(the_bus);
        const world::CarState* two = stage.car(other);
        if (one == nullptr || two == nullptr)
            continue;
        met.bus_is_through |= one->lane() != there;
        met.other_is_through |= two->lane() != back;
        met.deepest = std::max(met.deepest, depth(bus_body(*one), bus_body(*two)));
        if (std::max(one->speed(), two->speed()) < 0.05F && !met.other_is_through)
            met.waited += 0.05;
    }
    return met;
}

TEST(SweptArea, WhoComesTowardsABusInABendLeavesItItsWay) {
    int waited = 0;
    for (const char* model : {"lorry", "bus"})
        for (const double place : {50.0, 52.0, 53.0, 54.0, 56.0, 60.0}) {
            const Encounter met = meet_bus_in_bend(model, place);
            EXPECT_TRUE(met.bus_is_through && met.other_is_through) << model << ", " << place;
            EXPECT_LT(met.deepest, 0.05) << model << ", " << place;
            waited += met.waited > 10;
        }
    EXPECT_GT(waited, 6) << "few had to wait: little is shown";
}

/// How long somebody's bus stands behind a junction, its tail still in it, where somebody with mass
/// has come to stand at its flank: he waits for it, perhaps. [s]; none: no bus came by.
std::optional<double> bus_is_wedged(std::uint64_t seed) {
    const test::Loaded& loaded = own_town("town1");
    const world::VehicleModel& bicycle =
        world::vehicle_models()[world::find_vehicle_model("bicycle").value()];
    const auto bus = static_cast<std::uint16_t>(world::find_vehicle_model("bus").value());
    Stage stage(loaded, 60, seed);
    std::vector<world::VehicleState> vehicles;
    std::uint32_t id = world::none;
    double outside = 0;  // side on which its tail swings out; left positive
    double stood = 0;
    for (int tick = 0; tick < 9000 && stood < 100; ++tick) {
        stage.step({}, vehicles);
        for (const world::CarState& car : stage.draft().traffic.cars) {
            const bool turns_in = id == world::none && car.model() == bus &&
                                  car.lane() != world::none && car.speed() > 2 &&
                                  loaded.town.lanes[car.lane()].kind == world::LaneKind::internal;
            if (!turns_in)
                continue;
            const world::LaneT& way = loaded.town.lanes[car.lane()];
            const world::LanePoint end = world::point_at(way, way.length);
            const double turned = std::remainder(end.yaw - world::point_at(way, 0).yaw, 2 * M_PI);
            if (std::abs(turned) < 1 || car.lane_s() > 2)
                continue;
            id = car.id();
            outside = turned > 0 ? -1 : 1;
            const Eigen::Vector2d stop = end.position.head<2>() + 8 * world::ahead_of(end.yaw);
            vehicles = {test::vehicle_at(beside, stop.x(), stop.y(), end.yaw, 0)};
        }
        const world::CarState* car = id == world::none ? nullptr : stage.car(id);
        if (car == nullptr) {
            if (id != world::none)
                break;
            continue;
        }
        const BodyBox body = bus_body(*car);
        stood = car->speed() < 0.05F ? stood + 0.05 : 0;
        if (stood > 2 && stood < 2.06 &&
            vehicles[0].model() != *world::find_vehicle_model("bicycle")) {
            const Eigen::Vector2d at = body.middle - (body.half_length - 0.2) * body.ahead +
                                       outside * (body.half_width + bicycle.width / 2 + 0.06) *
                                           world::turned_left(body.ahead);
            vehicles = {test::vehicle_at(
                beside, at.x(), at.y(), std::atan2(body.ahead.y(), body.ahead.x()), 0)};
            vehicles[0].mutate_model(world::find_vehicle_model("bicycle").value());
        }
    }
    return id == world::none ? std::nullopt : std::optional(stood);
}

TEST(SweptArea, ABusThatCannotGoOnForWhoStandsAtItsFlankIsTakenOut) {
    int shown = 0;
    for (const std::uint64_t seed : {1U, 3U, 6U}) {
        const std::optional<double> stood = bus_is_wedged(seed);
        if (!stood)
            continue;
        EXPECT_LT(*stood, 60) << seed;
        shown += *stood > 45;
    }
    EXPECT_GT(shown, 0) << "no bus is held: nothing is shown";
}

}  // namespace
}  // namespace reprise::traffic
