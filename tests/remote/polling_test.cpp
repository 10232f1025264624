#include "remote/polling.h"

#include <sched.h>
#include <thread>

#include <gtest/gtest.h>

namespace reprise::remote {
namespace {

/// Counts how often it is looked at; there is something from the `from`-th time on, or never.
struct Looks {
    bool operator()() { return ++count == from; }

    unsigned from = 0;
    unsigned count = 0;
};

bool finds(Polling& polling, Looks& looks) {
    return polling.finds([&] { return looks(); });
}

/// A thread that gets this share of a processor. Each look at a clock takes a second.
class Shared {
  public:
    Polling::Clocks clocks() {
        return {[this] { return now_ += 1; }, [this] { return own_ += share; }};
    }

    double share = 1;

  private:
    double now_ = 0;
    double own_ = 0;
};

constexpr double ages = 3600;   // [s]
constexpr double moment = 0.5;  // [s] two looks at such a clock

class PollingOnSeveralProcessors : public testing::Test {
  protected:
    void SetUp() override {
        if (std::thread::hardware_concurrency() < 2)
            GTEST_SKIP() << "on one it never polls";
    }
};

TEST_F(PollingOnSeveralProcessors, LooksUntilThereIsSomething) {
    Polling polling(ages);
    Looks looks{5};
    EXPECT_TRUE(finds(polling, looks));
    EXPECT_EQ(looks.count, 5U);
}

TEST(Polling, OfNoTimeNeverLooks) {
    Polling polling;
    Looks looks{1};
    EXPECT_FALSE(finds(polling, looks));
    EXPECT_EQ(looks.count, 0U);
}

TEST_F(PollingOnSeveralProcessors, ThatFoundNothingSleepsThroughTwoWaits) {
    Shared thread;
    Polling polling(moment, thread.clocks());
    for (unsigned time = 0; time < 10; ++time) {
        Looks never, unasked{1};
        EXPECT_FALSE(finds(polling, never));
        EXPECT_EQ(never.count, 2U);
        EXPECT_FALSE(finds(polling, unasked));
        EXPECT_FALSE(finds(polling, unasked));
        EXPECT_EQ(unasked.count, 0U);
    }
    Looks there{1};
    EXPECT_TRUE(finds(polling, there));
}

/// Waits that are over at the second look: how many of the next so many are polled.
unsigned polled(Polling& polling, unsigned waits) {
    unsigned count = 0;
    for (unsigned wait = 0; wait < waits; ++wait) {
        Looks looks{2};
        count += finds(polling, looks) ? 1 : 0;
    }
    return count;
}

TEST_F(PollingOnSeveralProcessors, LeaveThemToWhoWantsThemLongerAndLonger) {
    Shared thread;
    thread.share = 0.5;
    Polling polling(ages, thread.clocks());
    for (const unsigned asleep : {16, 32, 64, 128, 256, 512, 1024, 1024}) {
        EXPECT_EQ(polled(polling, 8), 8U) << "a scheduler has some waits to part them";
        EXPECT_EQ(polled(polling, asleep), 0U);
    }
    thread.share = 1;
    EXPECT_EQ(polled(polling, 64), 64U);
    thread.share = 0.5;
    EXPECT_EQ(polled(polling, 8), 8U);
    EXPECT_EQ(polled(polling, 16), 0U) << "long undisturbed: as in the beginning";
    EXPECT_EQ(polled(polling, 1), 1U);
}

TEST_F(PollingOnSeveralProcessors, DisturbedNowAndThenGoOn) {
    Shared thread;
    Polling polling(ages, thread.clocks());
    for (unsigned wait = 0; wait < 300; ++wait) {
        thread.share = wait % 3 == 0 ? 0.5 : 1;
        EXPECT_EQ(polled(polling, 1), 1U);
    }
}

TEST(Polling, WithOneProcessorLeavesItToWhomItWaitsFor) {
    std::thread([] {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(static_cast<unsigned>(sched_getcpu()), &one);
        ASSERT_EQ(sched_setaffinity(0, sizeof(one), &one), 0);
        Polling polling(ages);
        Looks looks{1};
        EXPECT_FALSE(finds(polling, looks));
        EXPECT_EQ(looks.count, 0U);
    }).join();
}

}  // namespace
}  // namespace reprise::remote
