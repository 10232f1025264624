#include "wheel/hands.h"

#include <cmath>

#include <gtest/gtest.h>

namespace reprise::wheel {
namespace {

constexpr double hands_step = 0.05;

class HandsOfSedan : public testing::Test {
  protected:
    const world::VehicleModel& model_ =
        world::vehicle_models()[world::find_vehicle_model("sedan").value()];

    remote::Client::Wheel held(const Wishes& wishes, double speed, int ticks) {
        remote::Client::Wheel wheel;
        for (int i = 0; i < ticks; ++i) {
            const double before = wheel.steer;
            wheel = hands_.advance(wishes, speed, hands_step);
            if (i > 0)
                largest_turn_ = std::max(largest_turn_, std::abs(wheel.steer - before));
        }
        return wheel;
    }

    Hands hands_{model_};
    double largest_turn_ = 0;  ///< in a tick
};

TEST_F(HandsOfSedan, NothingHeldIsNothingDone) {
    const auto wheel = held({}, 10, 5);
    EXPECT_EQ(wheel.throttle, 0);
    EXPECT_EQ(wheel.brake, 0);
    EXPECT_EQ(wheel.steer, 0);
    EXPECT_FALSE(wheel.hand_brake);
    EXPECT_FALSE(wheel.reverse);
}

TEST_F(HandsOfSedan, WheelTurnsToTheSideThatIsHeldAndComesBack) {
    EXPECT_GT(held({.left = true}, 0, 1).steer, 0);
    EXPECT_EQ(held({.left = true}, 0, 20).steer, 1);
    EXPECT_LE(largest_turn_, 0.1) << "no jump: its whole way takes half a second at least";
    EXPECT_EQ(held({}, 0, 10).steer, 0);
    EXPECT_EQ(held({.right = true}, 0, 20).steer, -1);
    EXPECT_EQ(held({.left = true, .right = true}, 0, 20).steer, 0);
}

TEST_F(HandsOfSedan, WheelTurnsLessTheFasterOneGoes) {
    double last = 1.1;
    for (const double speed : {0.0, 8.0, 15.0, 30.0}) {
        const double steer = held({.left = true}, speed, 40).steer;
        EXPECT_LT(steer, last) << speed;
        const double angle = steer * model_.max_steering_angle;
        EXPECT_LE(speed * speed * std::tan(angle) / model_.wheelbase, 5.01)
            << "[m/s^2] sideways, at " << speed << " m/s";
        last = steer;
    }
    EXPECT_GT(last, 0);
    held({.left = true}, 30, 40);
    EXPECT_EQ(held({.left = true}, -1, 40).steer, 1) << "backwards and slow: all of it";
}

TEST_F(HandsOfSedan, BrakeIsStrongerThanThrottle) {
    EXPECT_EQ(held({.ahead = true}, 5, 20).throttle, 1);
    const auto both = held({.ahead = true, .back = true}, 5, 20);
    EXPECT_EQ(both.throttle, 0);
    EXPECT_EQ(both.brake, 1);
    EXPECT_TRUE(held({.hand_brake = true}, 5, 1).hand_brake);
}

TEST_F(HandsOfSedan, GearChangesWhenTheCarStands) {
    EXPECT_FALSE(held({.gear = 1}, 5, 1).reverse) << "not while it rolls";
    EXPECT_TRUE(held({.gear = 1}, 0.2, 1).reverse);
    EXPECT_TRUE(held({.ahead = true}, -3, 5).reverse) << "it stays in";
    EXPECT_TRUE(held({.gear = 2}, 0, 1).reverse) << "there and back";
    EXPECT_FALSE(held({.gear = 1}, 0, 1).reverse);
}

TEST_F(HandsOfSedan, AxesCountAsTheyAre) {
    const auto wheel = held({.steer = -0.25, .throttle = 0.5, .brake = 0.125}, 20, 1);
    EXPECT_EQ(wheel.steer, -0.25);
    EXPECT_EQ(wheel.throttle, 0.5);
    EXPECT_EQ(wheel.brake, 0.125);
}

}  // namespace
}  // namespace reprise::wheel
