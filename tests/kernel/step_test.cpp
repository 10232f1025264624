// What a whole step promises beyond its stages.
#include <algorithm>
#include <cstdint>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <xmmintrin.h>

#include "tests/kernel/whole_run.h"
#include "world/check.h"
#include "world/digest.h"

namespace reprise::test {

namespace {

/// Another mode of the floating-point unit, as a careless library would leave it behind.
class OtherMode {
  public:
    explicit OtherMode(unsigned mxcsr_bits) : before_(_mm_getcsr()) {
        _mm_setcsr(before_ | mxcsr_bits);
    }

    ~OtherMode() { _mm_setcsr(before_); }

    OtherMode(const OtherMode&) = delete;
    OtherMode& operator=(const OtherMode&) = delete;

  private:
    unsigned before_;
};

/// The same of the x87 unit, which long double uses.
class OtherX87Mode {
  public:
    explicit OtherX87Mode(std::uint16_t word) {
        asm("fnstcw %0" : "=m"(before_));
        asm("fldcw %0" : : "m"(word));
    }

    ~OtherX87Mode() { asm("fldcw %0" : : "m"(before_)); }

    OtherX87Mode(const OtherX87Mode&) = delete;
    OtherX87Mode& operator=(const OtherX87Mode&) = delete;

  private:
    std::uint16_t before_ = 0;
};

TEST(Step, EndsTheRunWhenALibraryLeftTheFloatingPointUnitInAnotherMode) {
    const world::Recording recording = in_town1("wait(60)", 0, 10);
    constexpr unsigned flush_to_zero = 0x8000;
    constexpr unsigned denormals_are_zero = 0x0040;
    constexpr unsigned round_up = 0x4000;
    for (const unsigned mode : {flush_to_zero, denormals_are_zero, round_up}) {
        kernel::Kernel kernel(recording);
        EXPECT_EQ(kernel.step().view().index(), 1U);
        const OtherMode other(mode);
        EXPECT_THROW(kernel.step(), world::CheckFailed) << mode;
    }
    kernel::Kernel kernel(recording);
    constexpr std::uint16_t double_mantissa = 0x027f;
    const OtherX87Mode other(double_mantissa);
    EXPECT_THROW(kernel.step(), world::CheckFailed);
}

TEST(Step, TheChainGoesOnFromTheTickBefore) {
    const std::vector<KeptTick> ticks = run(in_town1("wait(60)", 1, 1));
    ASSERT_EQ(ticks.size(), 20U);
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        const auto digests = [&](std::size_t at) {
            return *ticks[at].recorded().view.tick->digests();
        };
        EXPECT_EQ(digests(i).chain(), world::chain(digests(i - 1).chain(), digests(i).state()));
    }
}

TEST(Step, FinishIsTheLastTick) {
    const world::Recording recording = in_town1("wait_ticks(3) finish 'enough'", 0, 10);
    kernel::Kernel kernel(recording);
    int ticks = 0;
    while (!kernel.finished()) {
        kernel.step();
        ++ticks;
    }
    EXPECT_EQ(ticks, 4);
    EXPECT_EQ(kernel.outcome().reason, "enough");
}

/// The ticks of a run whose car is told something else in each; `ahead`: steps are begun before.
std::vector<KeptTick> driven(const world::Recording& recording, bool ahead) {
    kernel::Kernel kernel(recording);
    std::vector<KeptTick> ticks;
    while (!kernel.finished()) {
        const std::size_t count = ticks.size();
        const bool left = count % 40 < 10;
        const world::Control said{left ? 0.4 : 0.1, 0, left ? 0.2 : -0.05, 1, 0, false, false};
        ticks.emplace_back(kernel.step({&said, 1}));
        if (ahead && !kernel.finished())
            kernel.begin_step();
        if (ahead && !kernel.finished() && count % 3 == 0)
            kernel.begin_step();  // once more is nothing
    }
    return ticks;
}

TEST(Step, BegunWhileDriversThinkItIsTheSameStep) {
    const world::Recording recording = in_town1(R"(
        local road = pick_lane{ length = 80 }
        local car = spawn{ model = 'sedan', driver = 'external', lane = road, s = 20 }
        spawn{ model = 'sedan' }
        spawn{ model = 'adult', lane = road, s = 45 }
        check.never('hit', function() return car:collided() end)
        wait_ticks(60)
        set_weather 'hard_rain_sunset'
        wait_ticks(60)
        finish 'enough')",
                                                20,
                                                60);
    const std::vector<KeptTick> ahead = driven(recording, true);
    const std::vector<KeptTick> plain = driven(recording, false);
    ASSERT_EQ(ahead.size(), 121U);
    ASSERT_EQ(plain.size(), ahead.size());
    for (std::size_t i = 0; i < plain.size(); ++i) {
        const replay::RecordedTick one = ahead[i].recorded();
        const replay::RecordedTick other = plain[i].recorded();
        ASSERT_TRUE(std::ranges::equal(one.tick_bytes, other.tick_bytes)) << i;
        ASSERT_TRUE(std::ranges::equal(one.traffic_bytes, other.traffic_bytes)) << i;
    }
}

TEST(Step, WhatIsBegunIsToldWhenItIsMade) {
    const world::Recording recording = in_town1(
        "check.never('late', function() return time() > 0.12 end) wait_ticks(3) finish 'enough'",
        0,
        10);
    kernel::Kernel kernel(recording);
    for (int i = 0; i < 3; ++i)
        kernel.step();
    using Status = world::CheckResult::Status;
    ASSERT_EQ(kernel.checks().at(0).status, Status::not_evaluated);
    kernel.begin_step();
    EXPECT_FALSE(kernel.finished());
    EXPECT_EQ(kernel.outcome().reason, "");
    EXPECT_EQ(kernel.outcome().ticks, 3U);
    EXPECT_EQ(kernel.checks().at(0).status, Status::not_evaluated);
    kernel.step();
    EXPECT_TRUE(kernel.finished());
    EXPECT_EQ(kernel.outcome().reason, "enough");
    EXPECT_EQ(kernel.checks().at(0).status, Status::fail);
}

TEST(Step, AMistakeInWhatIsBegunIsToldByTheStep) {
    const world::Recording recording = in_town1("wait_ticks(1) spam()", 0, 10);
    kernel::Kernel kernel(recording);
    kernel.step();
    EXPECT_NO_THROW(kernel.begin_step());
    EXPECT_THROW(kernel.step(), world::Error);
}

TEST(Step, PhysicsMeetsTheWalkersOfItsTick) {
    const std::vector<KeptTick> ticks = run(in_town1(R"(
        local road = pick_lane{ length = 80 }
        spawn{ model = 'sedan', driver = 'manual', lane = road, s = 20, speed = 10 }
            :control{ throttle = 0.3 }
        spawn{ model = 'adult', lane = road, s = 40 }
        wait(9))",
                                                     0,
                                                     4));
    int hits = 0;
    for (const KeptTick& tick : ticks)
        for (const world::Event* event : *tick.recorded().view.tick->events())
            hits += event->kind() == world::EventKind::collision && event->other() == 2 ? 1 : 0;
    EXPECT_EQ(hits, 1);
}

TEST(Step, SetWeatherBringsItsRoadFriction) {
    const world::Recording dry =
        in_town1("wait_ticks(4) set_weather 'hard_rain_sunset' wait(9)", 0, 1);
    const std::vector<KeptTick> ticks = run(dry);
    EXPECT_EQ(ticks.at(0).recorded().view.tick->road_friction(), 1);
    const world::TickView rainy = ticks.back().recorded().view;
    EXPECT_LT(rainy.tick->road_friction(), 0.9);
    EXPECT_GT(rainy.tick->weather()->rain(), 0);
}

TEST(Step, ACarBrakesLongerUnderTheRainThatSetWeatherBrought) {
    const auto braked = [](const std::string& weather) {
        const std::vector<KeptTick> ticks = run(in_town1("set_weather '" + weather + R"('
            local car = spawn{ model = 'sedan', driver = 'manual', speed = 15,
                               lane = pick_lane{ length = 80 }, s = 10 }
            wait_ticks(1)
            car:control{ brake = 1 }
            wait(9))",
                                                         0,
                                                         8));
        return ticks.back().recorded().view.vehicles()[0].odometer();
    };
    EXPECT_GT(braked("hard_rain_sunset"), 1.2 * braked("clear_noon"));
}

}  // namespace

}  // namespace reprise::test
