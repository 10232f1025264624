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

constexpr double ages = 3600;    // [s]
constexpr double moment = 1e-9;  // [s] one look

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

TEST_F(PollingOnSeveralProcessors, ThatFindNothingSleepThroughMoreAndMoreWaits) {
    Polling polling(moment);
    for (const unsigned asleep : {2, 4, 8, 16, 32, 64, 64}) {
        Looks never;
        EXPECT_FALSE(finds(polling, never));
        EXPECT_EQ(never.count, 1U);
        Looks unasked{1};
        for (unsigned wait = 0; wait < asleep; ++wait)
            EXPECT_FALSE(finds(polling, unasked));
        EXPECT_EQ(unasked.count, 0U);
    }
    Looks there{1}, never;
    EXPECT_TRUE(finds(polling, there));
    EXPECT_FALSE(finds(polling, never));
    EXPECT_FALSE(finds(polling, never));
    EXPECT_FALSE(finds(polling, never));
    EXPECT_EQ(never.count, 1U) << "two waits asleep, as after the first one in vain";
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
