// The paper's driver, behind the same interface.
#include "drivers/control/pid_driver.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/drivers/kinematic_car.h"

namespace reprise::test {
namespace {

world::TownT way_of(const Turtle& turtle) {
    world::TownT town;
    town.name = "way";
    town.lanes.push_back(make_lane("way", turtle));
    return town;
}

TEST(PidDriver, KeepsTwentyKilometresAnHourAndItsLane) {
    Drive drive(way_of(Turtle(0, 0, 0).ahead(120).turn(quarter, 25).ahead(200)));
    drive.autopilot.emplace(1u, std::uint16_t{0}, drive.start, drive.map, world::Pilot::pid);
    drive.place(0, 5, 0);
    double farthest = 0;
    while (drive.seconds() < 50) {
        drive.step();
        farthest = std::max(farthest, drive.off_centre());
        if (drive.seconds() > 10) {
            EXPECT_NEAR(drive.car.speed, 20 / 3.6, 0.5) << "at " << drive.seconds() << " s";
        }
    }
    EXPECT_LT(farthest, 0.8) << "it cuts the corner";
}

TEST(PidDriver, StopsForWhoStandsInTheWayAndGoesOn) {
    Drive drive(way_of(Turtle(0, 0, 0).ahead(300)));
    drive.autopilot.emplace(1u, std::uint16_t{0}, drive.start, drive.map, world::Pilot::pid);
    drive.place(0, 5, 5);
    drive.cars = {car_at(9, 60, 0)};
    while (drive.seconds() < 30)
        drive.step();
    EXPECT_LT(drive.car.speed, 0.1);
    EXPECT_LT(drive.car.x + drive.car.front(), 59);
    EXPECT_GT(drive.car.x, 40);
    drive.cars.clear();
    while (drive.seconds() < 60)
        drive.step();
    EXPECT_GT(drive.car.x, 150);
}

}  // namespace
}  // namespace reprise::test
