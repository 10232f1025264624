#include "wheel/pace.h"

#include <gtest/gtest.h>

namespace reprise::wheel {
namespace {

constexpr double pace_step = 0.05;

/// Ticks that need `work` [s] each, from the answer to the tick before; returns when the last is
/// answered.
double played(Pace& pace, double& now, std::uint64_t from, std::uint64_t to, double work) {
    for (std::uint64_t tick = from; tick <= to; ++tick) {
        now += work;
        now += pace.wait(tick, now);
    }
    return now;
}

TEST(Pace, SimulatedSecondsTakeAsManyOfTheClock) {
    for (const double factor : {1.0, 0.5, 4.0}) {
        Pace pace(factor, pace_step);
        double now = 100;
        const double first = played(pace, now, 7, 7, 0.001);
        EXPECT_NEAR(played(pace, now, 8, 607, 0.001) - first, 600 * pace_step / factor, 1e-9)
            << factor;
        EXPECT_NEAR(pace.factor(), factor, 0.02 * factor);
    }
}

TEST(Pace, WithoutOneNothingIsWaitedFor) {
    Pace pace(0, pace_step);
    double now = 0;
    played(pace, now, 1, 100, 0.001);
    EXPECT_NEAR(now, 0.1, 1e-9);
    EXPECT_NEAR(pace.factor(), 50, 1e-6);
}

TEST(Pace, SaysHowSlowASlowRunIs) {
    Pace pace(1, pace_step);
    double now = 0;
    EXPECT_EQ(pace.factor(), 0) << "nothing is known yet";
    played(pace, now, 1, 40, 4 * pace_step);
    EXPECT_NEAR(now, 40 * 4 * pace_step, 1e-9) << "and does not wait on top";
    EXPECT_NEAR(pace.factor(), 0.25, 1e-6);
}

TEST(Pace, MakesUpALittleAndForgivesMuch) {
    Pace pace(1, pace_step);
    double now = 0;
    const double begin = played(pace, now, 1, 1, 0);
    now += 0.08;
    EXPECT_EQ(pace.wait(2, now), 0) << "late by 30 ms";
    EXPECT_NEAR(played(pace, now, 3, 10, 0.001) - begin, 9 * pace_step, 1e-9) << "in time again";
    now += 30;
    const double late = played(pace, now, 11, 11, 0);
    EXPECT_NEAR(played(pace, now, 12, 31, 0.001) - late, 20 * pace_step, 1e-9)
        << "no race behind it";
}

}  // namespace
}  // namespace reprise::wheel
