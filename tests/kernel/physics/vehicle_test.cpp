#include "kernel/physics/vehicle.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/kernel/physics/physics_rig.h"
#include "world/frames.h"

namespace reprise::kernel {

namespace {

using test::coasting;
using test::drive;
using test::ProvingGround;
using test::speed_of;
using test::tick_seconds;

const world::VehicleModel& model(const char* name) {
    return world::vehicle_models()[world::find_vehicle_model(name).value()];
}

std::vector<const char*> all_models() {
    std::vector<const char*> names;
    for (const world::VehicleModel& m : world::vehicle_models())
        names.push_back(m.name);
    return names;
}

class EveryModel : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Catalogue,
                         EveryModel,
                         testing::ValuesIn(all_models()),
                         [](const auto& test) { return std::string(test.param); });

/// Gillespie, eq. 4-2 and 4-12: m dv/dt = -(0.5 rho cdA v^2 + f m g).
TEST_P(EveryModel, CoastsDownByAirAndRollingResistance) {
    const world::CarModel car = world::car_model(model(GetParam()));
    for (const double speed : {10.0, 20.0, 30.0}) {
        ProvingGround ground;
        ground.add_vehicle(GetParam(), speed);
        for (int tick = 0; tick < 20; ++tick)
            ground.step(coasting());
        const double before = speed_of(ground.vehicle());
        for (int tick = 0; tick < 20; ++tick)
            ground.step(coasting());
        const double after = speed_of(ground.vehicle());
        const double mean = (before + after) / 2;
        const double expected = 0.5 * world::air_density * car.catalogue->drag_area * mean * mean /
                                    car.catalogue->mass +
                                car.rolling_resistance * world::gravity;
        EXPECT_NEAR((before - after) / (20 * tick_seconds), expected, 0.01 * expected) << speed;
    }
}

/// Gillespie, ch. 3: a is the lesser of what brakes and tyres can do, and the air brakes along:
/// m / (2 k) ln(1 + k v^2 / (m a)), k = 0.5 rho cdA. Only a bicycle is light enough to feel it.
TEST_P(EveryModel, StopsWithinTheTextbooksDistance) {
    const world::CarModel car = world::car_model(model(GetParam()));
    for (const double friction : {1.0, 0.7, 0.4, 0.15}) {
        const double speed = (friction > 0.5 ? 100 : 50) / 3.6;
        ProvingGround ground;
        ground.road_friction = friction;
        ground.add_vehicle(GetParam(), speed);
        const double distance = test::distance_to_stop(ground, drive(0, 1));
        const double by_tyres = car.grip * friction * world::gravity;
        const double deceleration = std::min(car.brake_deceleration, by_tyres);
        const double air =
            0.5 * world::air_density * car.catalogue->drag_area / car.catalogue->mass;
        const double expected = std::log1p(air * speed * speed / deceleration) / (2 * air);
        EXPECT_NEAR(distance, expected, 0.05 * expected) << friction;
        const double by_grip = speed * speed / (2 * by_tyres);
        if (friction == 1) {
            EXPECT_NEAR(distance, by_grip, 0.16 * by_grip);
        }
    }
}

TEST(Vehicle, StopsOnDryRoadWithinTenPercentOfWhatItsTyresAllow) {
    const double speed = 50 / 3.6;
    ProvingGround ground;
    ground.add_vehicle("sedan", speed);
    const double expected = speed * speed / (2 * 1.05 * world::gravity);
    EXPECT_NEAR(test::distance_to_stop(ground, drive(0, 1)), expected, 0.1 * expected);
}

/// Gillespie, ch. 6: R = L / tan(steer), of the rear axle's middle, at walking pace.
TEST_P(EveryModel, TurnsAboutTheAckermannCentreAtLowSpeed) {
    const world::VehicleModel& m = model(GetParam());
    for (const double steer : {0.3, -0.6, 1.0}) {
        ProvingGround ground;
        ground.add_vehicle(GetParam(), 2);
        // Steering takes at most 1.2 s; the motor works against rolling resistance only.
        const auto hold_speed = [&](double speed) { return std::clamp(2 - speed, 0.0, 1.0) * 0.5; };
        double throttle = 0;
        for (int tick = 0; tick < 100; ++tick)
            throttle = hold_speed(speed_of(ground.step(drive(throttle, 0, steer))));
        double yawed = 0;
        const double start = ground.vehicle().odometer();
        for (int tick = 0; tick < 60; ++tick) {
            throttle = hold_speed(speed_of(ground.step(drive(throttle, 0, steer))));
            yawed += ground.vehicle().angular_velocity().z() * tick_seconds;
        }
        const double radius = (ground.vehicle().odometer() - start) / yawed;
        const double expected = m.wheelbase / std::tan(steer * m.max_steering_angle);
        EXPECT_NEAR(radius, expected, 0.03 * std::abs(expected)) << steer;
    }
}

/// Gillespie, ch. 2: never more than the best gear gives, and nearly that; no faster than where
/// air and power are even.
TEST_P(EveryModel, AcceleratesAsItsBestGearAllows) {
    const world::CarModel car = world::car_model(model(GetParam()));
    const world::VehicleModel& m = *car.catalogue;
    ProvingGround ground;
    ground.add_vehicle(GetParam(), 0);
    double last = 0;
    int by_power = 0;
    int as_best = 0;
    for (int tick = 0; tick < 400; ++tick) {
        const double speed = speed_of(ground.step(drive(1, 0)));
        const double mean = (speed + last) / 2;
        const double drag = 0.5 * world::air_density * m.drag_area * mean * mean +
                            car.rolling_resistance * m.mass * world::gravity;
        // The body's squat when it starts and when gears change moves the rear axle's speed.
        if (tick > 20 && mean * m.max_drive_force > 1.2 * m.power) {
            const double best = (car.powertrain.largest_force(mean) - drag) / m.mass;
            const double got = (speed - last) / tick_seconds;
            EXPECT_LT(got, best + 0.3);
            ++by_power;
            as_best += got > 0.9 * best - 0.1 ? 1 : 0;
        }
        last = speed;
    }
    EXPECT_GT(by_power, 0);
    EXPECT_GT(as_best, 0.85 * by_power);
    EXPECT_LT(last, std::cbrt(m.power / (0.5 * world::air_density * m.drag_area)));
}

TEST_P(EveryModel, StandsStillForTenSeconds) {
    for (const double brake : {0.0, 1.0}) {
        ProvingGround ground;
        ground.add_vehicle(GetParam(), 0, 12, -7, 0.4);
        const world::Vec3 start = ground.step(drive(0, brake)).position();
        for (int tick = 0; tick < 200; ++tick)
            ground.step(drive(0, brake));
        const Eigen::Vector3d crept =
            world::to_eigen(ground.vehicle().position()) - world::to_eigen(start);
        EXPECT_LT(crept.norm(), 1e-3);
        EXPECT_LT(std::abs(ground.vehicle().position().z()), 0.02);
    }
}

TEST_P(EveryModel, HoldsOnASlopeWithEitherBrake) {
    for (const bool hand_brake : {false, true}) {
        ProvingGround ground(test::inclined_ground(0.10));
        const double pitch = std::atan(0.10);
        ground.physics().add_vehicle(
            1, world::find_vehicle_model(GetParam()).value(), world::pose({0, 0, 0}, 0, pitch), 0);
        const world::Control control(0, hand_brake ? 0 : 1, 0, 1, 0, hand_brake, false);
        for (int tick = 0; tick < 40; ++tick)  // the springs find their new balance
            ground.step(control);
        const world::Vec3 start = ground.vehicle().position();
        for (int tick = 0; tick < 200; ++tick)
            ground.step(control);
        const Eigen::Vector3d crept =
            world::to_eigen(ground.vehicle().position()) - world::to_eigen(start);
        EXPECT_LT(crept.norm(), 1e-3) << hand_brake;
    }
}

TEST_P(EveryModel, ClimbsAHillOfTenPercent) {
    ProvingGround ground(test::inclined_ground(0.10));
    ground.physics().add_vehicle(1,
                                 world::find_vehicle_model(GetParam()).value(),
                                 world::pose({0, 0, 0}, 0, std::atan(0.10)),
                                 0);
    for (int tick = 0; tick < 200; ++tick)
        ground.step(drive(1, 0));
    EXPECT_GT(speed_of(ground.vehicle()), 2);
    EXPECT_GT(ground.vehicle().position().z(), 1);
}

TEST_P(EveryModel, StandsOnItsSpringsFromTheFirstTick) {
    ProvingGround ground;
    ground.add_vehicle(GetParam(), 0);
    for (int tick = 0; tick < 60; ++tick) {
        ground.step(coasting());
        EXPECT_LT(std::abs(ground.vehicle().position().z()), 0.03) << tick;
        double load = 0;
        for (const world::WheelState& wheel : ground.tick().tick.wheels) {
            EXPECT_TRUE(wheel.in_contact());
            EXPECT_EQ(wheel.surface(), static_cast<std::uint8_t>(ground::Surface::road));
            load += wheel.suspension_force();
        }
        const double weight = model(GetParam()).mass * world::gravity;
        EXPECT_NEAR(load, weight, 0.01 * weight);
    }
}

TEST_P(EveryModel, ClimbsAKerbWithoutLeavingTheGroundForLong) {
    ProvingGround ground(test::kerb_ground(12, ground::kerb_height));
    ground.add_vehicle(GetParam(), 5);
    double highest = 0;
    double fastest_turn = 0;
    for (int tick = 0; tick < 120; ++tick) {
        const double speed = speed_of(ground.step(coasting()));
        ground.step(drive(speed < 5 ? 0.3 : 0, 0));
        highest = std::max(highest, ground.vehicle().position().z());
        fastest_turn =
            std::max(fastest_turn, world::to_eigen(ground.vehicle().angular_velocity()).norm());
    }
    EXPECT_LT(highest, ground::kerb_height + 0.15);
    EXPECT_LT(fastest_turn, 2);
    EXPECT_NEAR(ground.vehicle().position().z(), ground::kerb_height, 0.02);
    EXPECT_GT(ground.vehicle().position().x(), 14);
    for (const world::WheelState& wheel : ground.tick().tick.wheels)
        EXPECT_EQ(wheel.surface(), static_cast<std::uint8_t>(ground::Surface::sidewalk));
}

/// Gillespie, ch. 9: the rollover threshold t / (2 h) g. Where the tyres slide first, they save it.
TEST_P(EveryModel, SlidesOrRollsOverInAFastTurn) {
    const world::CarModel car = world::car_model(model(GetParam()));
    const double threshold = car.catalogue->track / (2 * car.com_height);
    ProvingGround ground;
    ground.add_vehicle(GetParam(), 20);
    double last = 20;
    for (int tick = 0; tick < 100; ++tick) {
        ground.step(drive(0.2, 0, 0.25));
        last = (world::to_eigen(ground.vehicle().orientation()) * Eigen::Vector3d::UnitZ()).z();
    }
    if (threshold > car.grip)
        EXPECT_GT(last, 0.9);
    else
        EXPECT_LT(last, 0.5);
}

Eigen::Vector3d speed_of_mass(const world::CarModel& car, const world::VehicleState& state) {
    const Eigen::Vector3d arm =
        world::to_eigen(state.orientation()) * Eigen::Vector3d(car.com_ahead, 0, car.com_height);
    return world::to_eigen(state.velocity()) + world::to_eigen(state.angular_velocity()).cross(arm);
}

/// Newton: nothing but the tyres and the air pushes the mass.
TEST_P(EveryModel, TurnsNoTighterThanItsGripAllows) {
    const world::CarModel car = world::car_model(model(GetParam()));
    for (const double friction : {0.7, 0.4, 0.2}) {
        ProvingGround ground;
        ground.road_friction = friction;
        ground.add_vehicle(GetParam(), 15);
        Eigen::Vector3d last(15, 0, 0);
        double most = 0;
        for (int tick = 0; tick < 60; ++tick) {
            ground.step(drive(0, 0, 0.5));
            const Eigen::Vector3d velocity = speed_of_mass(car, ground.vehicle());
            most = std::max(most, (velocity - last).head<2>().norm() / tick_seconds);
            last = velocity;
        }
        const double air = 0.5 * world::air_density * car.catalogue->drag_area * 15 * 15;
        const double by_tyres = car.grip * friction * world::gravity;
        EXPECT_LT(most, 1.05 * (by_tyres + air / car.catalogue->mass)) << friction;
        EXPECT_GT(most, 0.85 * by_tyres) << friction;
    }
}

TEST(Vehicle, SteersLeftForPositiveSteeringAndAtALimitedRate) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 8);
    ground.step(drive(0, 0, 1));
    EXPECT_NEAR(ground.vehicle().steering_angle(), world::steering_rate * tick_seconds, 1e-12);
    for (int tick = 0; tick < 40; ++tick)
        ground.step(drive(0.1, 0, 1));
    EXPECT_NEAR(ground.vehicle().steering_angle(), model("sedan").max_steering_angle, 1e-12);
    EXPECT_GT(ground.vehicle().angular_velocity().z(), 0.1);
    const auto& wheels = ground.tick().tick.wheels;
    EXPECT_GT(wheels[0].steering_angle(),
              wheels[1].steering_angle());  // the inner wheel turns more
}

TEST(Vehicle, DrivesBackwardsUpToItsReverseSpeed) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 0);
    world::Control backwards = drive(1, 0);
    backwards.mutate_reverse(true);
    for (int tick = 0; tick < 300; ++tick)
        ground.step(backwards);
    EXPECT_LT(speed_of(ground.vehicle()), -0.9 * world::reverse_speed);
    EXPECT_GT(speed_of(ground.vehicle()), -1.01 * world::reverse_speed);
    EXPECT_EQ(ground.vehicle().lamps(), world::lamp_reverse);
}

TEST(Vehicle, WheelsRollByTheDistanceDriven) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 10);
    double turned = 0;
    double last = 0;
    for (int tick = 0; tick < 40; ++tick) {
        ground.step(drive(0.1, 0));
        const double rotation = ground.tick().tick.wheels[0].rotation();
        EXPECT_GE(rotation, 0);
        EXPECT_LT(rotation, 2 * M_PI);
        turned += std::fmod(rotation - last + 2 * M_PI, 2 * M_PI);
        last = rotation;
    }
    const double rolled = turned * model("sedan").wheel_radius;
    EXPECT_NEAR(rolled, ground.vehicle().odometer(), 0.01 * rolled);
}

TEST(Vehicle, HandBrakeLocksTheRearWheelsOnly) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 10);
    ground.step(coasting());
    const double front = ground.tick().tick.wheels[0].rotation();
    const double rear = ground.tick().tick.wheels[2].rotation();
    world::Control pulled = coasting();
    pulled.mutate_hand_brake(true);
    ground.step(pulled);
    EXPECT_NE(ground.tick().tick.wheels[0].rotation(), front);
    EXPECT_NEAR(ground.tick().tick.wheels[2].rotation(), rear, 1e-12);
    EXPECT_LT(ground.tick().tick.wheels[2].skid(), 1.0F);
}

TEST(Vehicle, ShowsBrakeLampsBesideThoseOfItsDriver) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 10);
    world::Control control = drive(0, 0.1);
    control.mutate_lamps(world::lamp_left);
    EXPECT_EQ(ground.step(control).lamps(), world::lamp_left | world::lamp_brake);
}

TEST(Vehicle, AccelerationIsTheChangeOfItsVelocity) {
    ProvingGround ground;
    ground.add_vehicle("sedan", 15);
    Eigen::Vector3d last(15, 0, 0);
    for (int tick = 0; tick < 20; ++tick) {
        ground.step(drive(0, tick % 2, 0.2));
        const Eigen::Vector3d velocity = world::to_eigen(ground.vehicle().velocity());
        const Eigen::Vector3d expected = (velocity - last) / tick_seconds;
        EXPECT_LT((world::to_eigen(ground.vehicle().acceleration()) - expected).norm(), 1e-9);
        last = velocity;
    }
}

TEST(Ackermann, WheelsStandOnCirclesAboutOneCentre) {
    const double wheelbase = 2.8;
    const double track = 1.57;
    for (const double angle : {-0.6, -0.1, 0.02, 0.5}) {
        const world::AckermannAngles angles = world::ackermann(angle, wheelbase, track);
        const double centre = wheelbase / std::tan(angle);
        EXPECT_NEAR(wheelbase / std::tan(angles.left) + track / 2, centre, 1e-9);
        EXPECT_NEAR(wheelbase / std::tan(angles.right) - track / 2, centre, 1e-9);
    }
}

TEST(BrushTyre, StartsWithItsStiffnessAndEndsAtItsGrip) {
    const double stiffness = 10;
    const double grip = 1.05;
    const double small = 1e-6;
    EXPECT_NEAR(grip * world::brush_share(small, stiffness, grip), stiffness * small, 1e-9);
    EXPECT_DOUBLE_EQ(world::brush_share(3 * grip / stiffness, stiffness, grip), 1);
    EXPECT_DOUBLE_EQ(world::brush_share(9, stiffness, grip), 1);
    EXPECT_DOUBLE_EQ(world::brush_share(-0.1, stiffness, grip),
                     world::brush_share(0.1, stiffness, grip));
}

}  // namespace

}  // namespace reprise::kernel
