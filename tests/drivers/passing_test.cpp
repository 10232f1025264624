// What stands or crawls in the way is passed where there is room, and nothing else is.
#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "tests/drivers/junction_road.h"
#include "tests/drivers/kinematic_car.h"
#include "world/models/prop_models.h"

namespace reprise::test {
namespace {

constexpr std::uint32_t ours = 0;

/// A straight street eastward, our lane along y = 0.
struct Street {
    int lanes = 1;          ///< of our direction, ours is the right one
    bool oncoming = false;  ///< a lane of the other direction on the left
    double width = 3.5;     ///< of our lane
};

world::TownT town_of(const Street& street) {
    world::TownT town;
    town.name = "street";
    town.lanes.push_back(make_lane("ours", Turtle(0, 0, 0).ahead(600)));
    town.lanes[ours].width = street.width;
    double y = street.width / 2 + 1.75;
    if (street.lanes == 2) {
        town.lanes.push_back(make_lane("next", Turtle(0, y, 0).ahead(600)));
        town.lanes[ours].left = 1;
        town.lanes[1].right = ours;
        y += 3.5;
    }
    if (street.oncoming) {
        const auto last = static_cast<std::uint32_t>(town.lanes.size() - 1);
        town.lanes.push_back(make_lane("theirs", Turtle(600, y, std::numbers::pi).ahead(600)));
        town.lanes[last].opposite = last + 1;
        town.lanes[last + 1].opposite = last;
    }
    return town;
}

world::CarState car_on(double x, double y, double yaw, double speed, const char* model = "van") {
    world::CarState car{};
    car.mutable_position() = world::Vec3(x, y, 0);
    car.mutate_yaw(static_cast<float>(yaw));
    car.mutate_speed(static_cast<float>(speed));
    car.mutate_id(50);
    car.mutate_lane(world::none);
    car.mutate_model(*world::find_vehicle_model(model));
    return car;
}

world::PropState prop_on(double x, double y) {
    world::PropState prop{};
    prop.mutable_position() = world::Vec3(x, y, 0);
    prop.mutable_orientation() = world::Quat(1, 0, 0, 0);
    prop.mutate_id(60);
    prop.mutate_model(*world::find_prop_model("cone"));
    return prop;
}

world::WalkerState person_on(double x, double y, bool down) {
    return {world::Vec3(x, y, 0), 1, 0, 0, 70, 0, down, 0, 0};
}

struct Overtaker : Drive {
    explicit Overtaker(const Street& street, std::span<const world::Obstacle> obstacles = {})
        : Drive(town_of(street), 7, 0, obstacles) {
        autopilot->may_overtake(true);
    }
};

/// [m] between the outline of our car and a box; 0 where they touch.
double distance_to(const Drive& drive,
                   const Eigen::Vector2d& middle,
                   double yaw,
                   double half_length,
                   double half_width) {
    const world::VehicleModel& model = world::vehicle_models()[drive.car.model];
    const Eigen::Rotation2Dd ego(drive.car.yaw);
    const Eigen::Rotation2Dd back(-yaw);
    double least = 1e9;
    for (double along = -model.rear_overhang; along <= drive.car.front(); along += 0.1)
        for (const double across : {-model.width / 2, model.width / 2}) {
            const Eigen::Vector2d p =
                Eigen::Vector2d(drive.car.x, drive.car.y) + ego * Eigen::Vector2d(along, across);
            const Eigen::Vector2d q = back * (p - middle);
            const double dx = std::max(std::abs(q.x()) - half_length, 0.0);
            const double dy = std::max(std::abs(q.y()) - half_width, 0.0);
            least = std::min(least, std::hypot(dx, dy));
        }
    return least;
}

double distance_to(const Drive& drive, const world::CarState& car) {
    const world::VehicleModel& model = world::vehicle_models()[car.model()];
    const double yaw = static_cast<double>(car.yaw());
    const Eigen::Vector2d middle =
        Eigen::Vector2d(car.position().x(), car.position().y()) +
        Eigen::Rotation2Dd(yaw) * Eigen::Vector2d(model.length / 2 - model.rear_overhang, 0);
    return distance_to(drive, middle, yaw, model.length / 2, model.width / 2);
}

/// What became of a drive past something.
struct Outcome {
    double clearance = 1e9;  ///< [m] the least to all of them
    double farthest_left = 0;
    double at_end = 0;  ///< [m] left of our lane, at the end
    double x = 0;
    bool stood = false;
};

/// Drives for so long; cars go on along their heading.
Outcome drive_past(Drive& drive, double seconds) {
    Outcome outcome;
    while (drive.seconds() < seconds && drive.car.x < 400) {
        drive.step();
        for (world::CarState& car : drive.cars) {
            const double step = static_cast<double>(car.speed()) * 0.05;
            const double yaw = static_cast<double>(car.yaw());
            car.mutable_position() =
                world::Vec3(car.position().x() + step * std::cos(yaw), car.position().y(), 0);
            outcome.clearance = std::min(outcome.clearance, distance_to(drive, car));
        }
        for (const world::PropState& prop : drive.props)
            outcome.clearance = std::min(
                outcome.clearance,
                distance_to(drive, {prop.position().x(), prop.position().y()}, 0, 0.2, 0.2));
        for (const world::WalkerState& walker : drive.walkers)
            outcome.clearance = std::min(outcome.clearance,
                                         distance_to(drive,
                                                     {walker.position().x(), walker.position().y()},
                                                     static_cast<double>(walker.yaw()),
                                                     walker.down() ? 0.9 : 0.25,
                                                     0.25));
        outcome.farthest_left = std::max(outcome.farthest_left, drive.car.y);
        outcome.stood = outcome.stood || (drive.seconds() > 2 && drive.car.speed < 0.1);
    }
    outcome.at_end = drive.car.y;
    outcome.x = drive.car.x;
    return outcome;
}

TEST(Passing, AParkedVanThroughTheNextLane) {
    for (const double speed : {0.0, 6.0, 13.0})
        for (const double x : {60.0, 120.0}) {
            Overtaker drive({2});
            drive.place(ours, 20, speed);
            drive.cars = {car_on(x, 0, 0, 0)};
            const Outcome outcome = drive_past(drive, 60);
            EXPECT_GT(outcome.clearance, 0.45) << speed << " m/s, van at " << x;
            EXPECT_GT(outcome.x, 300) << speed << " m/s, van at " << x;
            EXPECT_NEAR(outcome.at_end, 0, 0.1);
        }
}

TEST(Passing, AConeWithinALaneThatIsWideEnough) {
    Overtaker drive({1, false, 5.5});
    drive.place(ours, 20, 10);
    drive.props = {prop_on(120, -0.6)};
    const Outcome outcome = drive_past(drive, 40);
    EXPECT_GT(outcome.clearance, 0.45);
    EXPECT_LT(outcome.farthest_left, 2.75 - 0.9) << "it leaves its lane";
    EXPECT_GT(outcome.x, 300);
    EXPECT_FALSE(outcome.stood);
}

/// Who stands behind it leaves no room to go back.
TEST(Passing, WhoStandsALittleTooNearTurnsOutTightlyInTheEnd) {
    for (const double gap : {6.1, 6.5}) {
        Overtaker drive({2});
        drive.place(ours, 60, 0);
        world::CarState behind = car_on(60 - 1 - 0.5 - 3.7, 0, 0, 0, "sedan");
        behind.mutate_id(51);
        drive.cars = {car_on(60 + 3.7 + gap + 1.1, 0, 0, 0), behind};
        double clearance = 1e9;
        while (drive.seconds() < 60 && drive.car.x < 300) {
            drive.step();
            clearance = std::min(clearance, distance_to(drive, drive.cars[0]));
        }
        EXPECT_GT(clearance, 0.3) << gap << " m";
        EXPECT_GE(drive.car.x, 300) << gap << " m";
    }
}

/// Wide lanes are narrower than they say, in maps that have one width for all of a lane.
TEST(Passing, NotWhereAPoleStandsBesideTheThing) {
    world::Obstacle pole;
    pole.shape = world::Obstacle::Shape::cylinder;
    pole.half = {0.1, 0.1, 2};
    pole.radius = 0.1;
    for (const double x : {114.0, 120.0, 125.0}) {
        pole.position = {x, -2.2, 0};
        Overtaker drive({1, false, 7.7}, {&pole, 1});
        drive.place(ours, 20, 10);
        drive.props = {prop_on(120, 0.2)};
        double to_pole = 1e9;
        while (drive.seconds() < 60 && drive.car.x < 300) {
            drive.step();
            to_pole = std::min(to_pole, distance_to(drive, {x, -2.2}, 0, 0.07, 0.07));
        }
        EXPECT_GT(to_pole, 0.1) << "pole at " << x;
        EXPECT_GE(drive.car.x, 300) << "there is room on the other side";
    }
}

TEST(Passing, PeopleAndBicyclesAtAMetre) {
    for (const bool down : {true, false}) {
        Overtaker drive({2});
        drive.place(ours, 20, 10);
        drive.walkers = {person_on(120, 0.3, down)};
        const Outcome outcome = drive_past(drive, 60);
        EXPECT_GT(outcome.clearance, 0.95) << (down ? "lies" : "stands");
        EXPECT_GT(outcome.x, 300);
    }
    Overtaker drive({2});
    drive.place(ours, 20, 10);
    drive.cars = {car_on(60, 0, 0, 2.8, "bicycle")};
    const Outcome outcome = drive_past(drive, 60);
    EXPECT_GT(outcome.clearance, 0.95);
    EXPECT_GT(outcome.x, 399) << "stays behind it";
    EXPECT_NEAR(outcome.at_end, 0, 0.1);
}

TEST(Passing, ThroughTheOncomingLaneOnlyWhereItIsFree) {
    Overtaker alone({1, true});
    alone.place(ours, 20, 10);
    alone.cars = {car_on(120, 0, 0, 0)};
    const Outcome outcome = drive_past(alone, 60);
    EXPECT_GT(outcome.clearance, 0.45);
    EXPECT_GT(outcome.x, 300);

    for (const double from : {200.0, 240.0, 280.0, 320.0}) {
        Overtaker drive({1, true});
        drive.place(ours, 20, 10);
        world::CarState comer = car_on(from, 3.5, std::numbers::pi, 13, "sedan");
        comer.mutate_id(51);
        drive.cars = {car_on(120, 0, 0, 0), comer};
        bool in_its_way = false;
        while (drive.seconds() < 60 && drive.car.x < 300) {
            drive_past(drive, drive.seconds() + 0.04);
            const double ahead = drive.cars[1].position().x() - drive.car.x;
            in_its_way = in_its_way || (drive.car.y > 0.9 && ahead > 0 && ahead < 2 * 13 + 5);
        }
        EXPECT_FALSE(in_its_way) << "who came from " << from;
        EXPECT_GE(drive.car.x, 300);
    }
}

TEST(Passing, NobodyIsCutOffOnTheNextLane) {
    Overtaker drive({2});
    drive.place(ours, 60, 0);
    world::CarState faster = car_on(-40, 3.5, 0, 13, "sedan");
    faster.mutate_id(51);
    drive.cars = {car_on(75, 0, 0, 0), faster};
    std::optional<double> behind;  // when it is in the other's way
    while (drive.seconds() < 60 && drive.car.x < 200) {
        drive_past(drive, drive.seconds() + 0.04);
        if (drive.car.y > 0.9 && !behind)
            behind = drive.car.x - drive.cars[1].position().x();
    }
    ASSERT_TRUE(behind.has_value());
    EXPECT_TRUE(*behind > 30 || *behind < -4) << *behind << " m";
    EXPECT_GE(drive.car.x, 200);
}

TEST(Passing, WhereThereIsNoRoomItWaits) {
    for (const Street& street : {Street{1, false}, Street{2, false}}) {
        Overtaker drive(street);
        drive.place(ours, 20, 10);
        drive.cars = {car_on(120, 0, 0, 0)};
        if (street.lanes == 2) {
            world::CarState beside = car_on(124, 3.5, 0, 0);
            beside.mutate_id(51);
            drive.cars.push_back(beside);
        }
        const Outcome outcome = drive_past(drive, 60);
        EXPECT_GT(outcome.clearance, 1) << street.lanes;
        EXPECT_LT(outcome.x, 120) << street.lanes;
        EXPECT_LT(drive.car.speed, 0.1);
    }
}

/// For room he backed off, for want of it he drove up again, and so to and fro.
TEST(Passing, WhoFindsNoRoomStandsStillInTheEnd) {
    for (const double gap : {2.0, 3.0, 5.0})
        for (const double behind : {1.0, 2.0, 3.0}) {
            Overtaker drive({2});
            const world::VehicleModel& van =
                world::vehicle_models()[*world::find_vehicle_model("van")];
            drive.cars = {car_on(60, 0, 0, 0)};
            drive.place(ours, 0, 0);
            const double nose = drive.car.front();
            const double tail = world::vehicle_models()[drive.car.model].rear_overhang;
            drive.place(ours, 60 - van.rear_overhang - gap - nose, 0);
            drive.cars.push_back(
                car_on(drive.car.x - tail - behind - van.length + van.rear_overhang, 0, 0, 0));
            drive.cars.back().mutate_id(51);
            double moved = 0;  // [m] to and fro
            for (double x = 0; drive.seconds() < 90 && drive.car.x < 60; x = drive.car.x) {
                drive.step();
                moved += drive.seconds() > 30 ? std::abs(drive.car.x - x) : 0;
            }
            EXPECT_TRUE(drive.car.x >= 60 || moved < 0.3)
                << gap << " m, and " << behind << " m behind: " << moved << " m";
        }
}

TEST(Passing, NobodyUnasked) {
    for (const Street& street : {Street{2, true}, Street{1, false, 5.5}}) {
        Drive drive(town_of(street));
        drive.place(ours, 20, 10);
        drive.cars = {car_on(120, 0, 0, 0)};
        drive.props = {prop_on(100, -1)};
        const Outcome outcome = drive_past(drive, 60);
        EXPECT_LT(outcome.farthest_left, 0.1) << street.width;
        EXPECT_LT(outcome.x, 120) << street.width;
    }
}

TEST(Passing, WhoKeepsItsLaneWaits) {
    Overtaker drive({2, true});
    drive.autopilot->keep_lane(true);
    drive.place(ours, 20, 10);
    drive.cars = {car_on(120, 0, 0, 0)};
    const Outcome outcome = drive_past(drive, 60);
    EXPECT_LT(outcome.farthest_left, 0.1);
    EXPECT_LT(outcome.x, 120);
}

TEST(Passing, NobodyWhoDrivesOrWaits) {
    Overtaker behind({2, true});
    behind.place(ours, 20, 10);
    behind.cars = {car_on(60, 0, 0, 5)};
    EXPECT_LT(drive_past(behind, 50).farthest_left, 0.1) << "a car at 18 km/h";

    // Three in a queue, with their brake lamps on.
    Overtaker queue({2, true});
    queue.place(ours, 20, 10);
    for (int i = 0; i < 3; ++i) {
        world::CarState waiting = car_on(120 + 8 * i, 0, 0, 0, "sedan");
        waiting.mutate_id(static_cast<std::uint32_t>(50 + i));
        waiting.mutate_lamps(world::lamp_brake);
        queue.cars.push_back(waiting);
    }
    EXPECT_LT(drive_past(queue, 60).farthest_left, 0.1) << "a queue";
}

TEST(Passing, NobodyWhoseBrakeLampsGoOutToMoveUp) {
    Overtaker drive({2, true});
    drive.place(ours, 80, 5);
    drive.cars = {car_on(120, 0, 0, 0, "sedan")};
    while (drive.seconds() < 60) {
        // Two seconds of every twelve dark: that is all one sees of a queue that does not move
        // after all.
        const bool dark = std::fmod(drive.seconds(), 12) > 10;
        drive.cars[0].mutate_lamps(dark ? std::uint16_t{0} : std::uint16_t{world::lamp_brake});
        EXPECT_LT(drive_past(drive, drive.seconds() + 0.04).farthest_left, 0.1)
            << "at " << drive.seconds() << " s";
        ASSERT_GT(drive.car.speed, -0.1) << "it backs off, to get around";
        if (drive.seconds() > 14.9)
            break;  // behind has_no_reason's 15 s of standing it may
    }
}

/// junction_road with a lane back west, 3.5 m to the left of ours.
world::TownT two_way_junction() {
    using world::LaneKind;
    constexpr double west = std::numbers::pi;
    world::TownT town = junction_road(false);
    town.lanes.push_back(make_lane("from_east", Turtle(410, 3.5, west).ahead(200)));
    town.lanes.push_back(
        make_lane(":2", Turtle(210, 3.5, west).ahead(10), 13.89, LaneKind::internal));
    town.lanes.push_back(make_lane("to_west", Turtle(200, 3.5, west).ahead(200)));
    town.lanes[6].links = {make_link(8, 7, world::Turn::straight)};
    town.lanes[7].links = {make_link(8, world::none, world::Turn::straight)};
    town.lanes[6].junction = 0;
    town.lanes[0].opposite = 8;
    town.lanes[8].opposite = 0;
    town.lanes[2].opposite = 6;
    town.lanes[6].opposite = 2;
    return town;
}

TEST(Passing, AWreckInAJunctionOrJustBeforeIt) {
    for (const double x : {185.0, 195.0, 205.0, 212.0})
        for (const double yaw : {0.0, 0.6, quarter}) {
            Drive drive(two_way_junction());
            drive.autopilot->may_overtake(true);
            drive.place(ours, 100, 10);
            drive.cars = {car_on(x, yaw == quarter ? -2 : 0, yaw, 0, "sedan")};
            const Outcome outcome = drive_past(drive, 90);
            EXPECT_GT(outcome.clearance, 0.3) << x << " m, " << yaw;
            EXPECT_GT(outcome.x, 300) << x << " m, " << yaw;
            EXPECT_NEAR(outcome.at_end, 0, 0.1) << x << " m, " << yaw;
        }
}

/// As behind a step back: its way begins there, without the junction's gate.
TEST(Passing, AWreckAheadOfWhoStartsInTheJunction) {
    Drive drive(two_way_junction());
    drive.autopilot->may_overtake(true);
    drive.place(1, 1, 0);
    drive.cars = {car_on(214, 0, 0.3, 0, "sedan")};
    const Outcome outcome = drive_past(drive, 90);
    EXPECT_GT(outcome.clearance, 0.2);
    EXPECT_GT(outcome.x, 300);
}

TEST(Passing, NotOverAJunctionBesideTheRoad) {
    Drive drive(junction_road(false));  // one lane, and one that crosses it
    drive.autopilot->may_overtake(true);
    drive.place(ours, 150, 5);
    drive.cars = {car_on(195, 0, 0, 0, "sedan")};
    const Outcome outcome = drive_past(drive, 60);
    EXPECT_LT(outcome.farthest_left, 0.1);
    EXPECT_LT(outcome.x, 195);
}

TEST(Passing, NobodyWhoComesOverTheJunctionMeetsUsThere) {
    for (const double from : {260.0, 300.0, 340.0}) {
        Drive drive(two_way_junction());
        drive.autopilot->may_overtake(true);
        drive.place(ours, 180, 0);
        world::CarState comer = car_on(from, 3.5, std::numbers::pi, 10, "sedan");
        comer.mutate_id(51);
        drive.cars = {car_on(205, 0, 0, 0, "sedan"), comer};
        const Outcome outcome = drive_past(drive, 90);
        EXPECT_GT(outcome.clearance, 0.3) << from;
        EXPECT_GT(outcome.x, 300) << from;
    }
}

TEST(Passing, WhoWaitsForTheSameWreckDoesNotHoldUsForEver) {
    Drive drive(two_way_junction());
    drive.autopilot->may_overtake(true);
    drive.place(ours, 150, 5);
    world::CarState waits = car_on(230, 3.5, std::numbers::pi, 0, "sedan");
    waits.mutate_id(51);
    waits.mutate_lane(6);
    waits.mutate_lane_s(180);
    waits.mutate_lamps(world::lamp_brake);
    drive.cars = {car_on(200, 0.3, 0.3, 0, "sedan"), waits};
    const Outcome outcome = drive_past(drive, 90);
    EXPECT_GT(outcome.clearance, 0.3);
    EXPECT_GT(outcome.x, 300);
}

TEST(Passing, WhoDrivesOnBeforeHeIsPassedIsFollowed) {
    Overtaker drive({2});
    drive.place(ours, 20, 6);
    drive.cars = {car_on(80, 0, 0, 0)};
    while (drive.car.y < 0.3 && drive.seconds() < 60)
        drive_past(drive, drive.seconds() + 0.05);
    ASSERT_LT(drive.car.x, 76) << "it is beside it already";
    drive.cars[0].mutate_speed(20);
    const Outcome outcome = drive_past(drive, drive.seconds() + 10);
    EXPECT_NEAR(outcome.at_end, 0, 0.1) << "it stays out for as long as somebody is ahead";
}

TEST(Passing, WhoStandsNoseToNoseWithUs) {
    // Just before a junction, where one who stands on the brake in our direction would be a queue.
    Drive drive(two_way_junction());
    drive.autopilot->may_overtake(true);
    drive.place(ours, 100, 8);
    drive.cars = {car_on(185, 0, std::numbers::pi, 0, "sedan")};
    drive.cars[0].mutate_lamps(world::lamp_brake);
    const Outcome outcome = drive_past(drive, 120);
    EXPECT_GT(outcome.clearance, 0.3);
    EXPECT_GT(outcome.x, 300);
}

TEST(Passing, OutOfAGapBetweenTwoItGoesToAndFro) {
    constexpr double gap = 1;  // [m] before and behind it
    Drive drive(town_of({.lanes = 2}));
    drive.autopilot->may_overtake(true);
    drive.place(ours, 100, 0);
    const world::VehicleModel& own = world::vehicle_models()[drive.car.model];
    const world::VehicleModel& other = world::vehicle_models()[car_on(0, 0, 0, 0, "sedan").model()];
    const double ahead = 100 + drive.car.front() + gap + other.rear_overhang;
    const double behind = 100 - own.rear_overhang - gap - other.length + other.rear_overhang;
    drive.cars = {car_on(ahead, 0, 0, 0, "sedan"), car_on(behind, 0, 0, 0, "sedan")};
    drive.cars[0].mutate_lamps(world::lamp_left | world::lamp_right);
    drive.cars[1].mutate_id(51);
    drive.cars[1].mutate_lamps(world::lamp_brake);
    const Outcome outcome = drive_past(drive, 120);
    EXPECT_GT(outcome.clearance, 0.15);
    EXPECT_GT(outcome.x, 200);
    EXPECT_NEAR(outcome.at_end, 0, 0.1);
}

}  // namespace
}  // namespace reprise::test
