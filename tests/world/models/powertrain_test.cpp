#include "world/models/powertrain.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "world/models/car_model.h"

namespace reprise::world {

namespace {

template <typename Check>
void for_every_engine(const Check& check) {
    for (const VehicleModel& model : vehicle_models()) {
        const CarModel car = car_model(model);
        if (car.powertrain.gears > 0) {
            SCOPED_TRACE(model.name);
            check(car);
        }
    }
}

/// At its peak speed an engine gives its largest power. The diesel's published coefficients are
/// rounded: 0.2 % more a little later.
TEST(Powertrain, GivesItsPowerAtThePeakAndNowhereMore) {
    for_every_engine([](const CarModel& car) {
        const Powertrain& train = car.powertrain;
        for (int gear = 3; gear <= train.gears; ++gear) {  // the low ones are held back
            const double ratio = train.engine_speed(gear, 1);
            const double peak = train.peak_speed / ratio;
            EXPECT_NEAR(train.force(gear, peak) * peak, train.power, 1e-6 * train.power) << gear;
        }
        for (double speed = 1; speed < 80; speed += 0.5)
            EXPECT_LE(train.largest_force(speed) * speed, 1.003 * train.power) << speed;
    });
}

/// Where the engine's power is spent on air and rolling, it turns at its peak.
TEST(Powertrain, IsGearedForItsTopSpeed) {
    for_every_engine([](const CarModel& car) {
        const VehicleModel& m = *car.catalogue;
        const Powertrain& train = car.powertrain;
        double nearest = INFINITY;
        for (int gear = 1; gear <= train.gears; ++gear) {
            const double speed = train.peak_speed / train.engine_speed(gear, 1);
            const double spent = 0.5 * air_density * m.drag_area * speed * speed * speed +
                                 car.rolling_resistance * m.mass * gravity * speed;
            nearest = std::min(nearest, std::abs(spent / m.power - 1));
        }
        EXPECT_LT(nearest, 1e-6);
    });
}

TEST(Powertrain, GivesNothingBeyondItsLimitAndMostInTheFirstGear) {
    for_every_engine([](const CarModel& car) {
        const Powertrain& train = car.powertrain;
        EXPECT_EQ(train.force(1, 1.01 * train.limit_speed / train.engine_speed(1, 1)), 0);
        for (int gear = 2; gear <= train.gears; ++gear)
            EXPECT_LE(train.force(gear, 0), train.force(gear - 1, 0)) << gear;
        EXPECT_LT(train.force(train.gears, 0), train.force(1, 0));
        EXPECT_EQ(train.largest_force(0), train.force(1, 0));
    });
}

/// What the best gear gives is never far below the engine's power, or what the wheels may get.
TEST(Powertrain, HasItsGearsCloseEnough) {
    for_every_engine([](const CarModel& car) {
        const Powertrain& train = car.powertrain;
        const double first = train.peak_speed / train.engine_speed(1, 1);
        const double direct = train.peak_speed / train.engine_speed(6, 1);
        for (double speed = first; speed < direct; speed += 0.5)
            EXPECT_GT(train.largest_force(speed) * speed,
                      0.999 * std::min(0.7 * train.power, train.most_force * speed))
                << speed;
    });
}

TEST(DriveForce, IsAShareOfTheBestGearsForceAndNoneAgainstTheWay) {
    const CarModel car = car_model(vehicle_models()[0]);
    EXPECT_DOUBLE_EQ(drive_force(car, 0.5, false, 20), 0.5 * car.powertrain.largest_force(20));
    EXPECT_DOUBLE_EQ(drive_force(car, 0.5, true, 0), -0.5 * car.powertrain.force(1, 0));
    EXPECT_EQ(drive_force(car, 1, true, 3), 0);
    EXPECT_EQ(drive_force(car, 1, false, -3), 0);
    EXPECT_EQ(drive_force(car, 1, true, -reverse_speed), 0);
}

/// Pacejka, 3.2.3: the force of a brush with equal stiffness points against the slip.
TEST(HeldShare, LeavesSideForceToAWheelThatIsHeldFromLocking) {
    const double grip = 0.35;
    const double along = held_share(0, front_cornering, grip);
    EXPECT_DOUBLE_EQ(along, 1);  // on snow the whole contact slides
    for (const double slip : {0.02, 0.1, 0.3}) {
        const double share = held_share(slip, longitudinal_stiffness, grip);
        EXPECT_NEAR(share, held_slip / std::hypot(held_slip, slip), 1e-12);
        EXPECT_DOUBLE_EQ(held_share(-slip, front_cornering, grip),
                         held_share(slip, front_cornering, grip));
    }
    EXPECT_GT(held_share(0, front_cornering, 1.05), 0.98);
}

}  // namespace

}  // namespace reprise::world
