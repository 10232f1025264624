#include "kernel/side_thread.h"

#include <atomic>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/one_processor.h"

namespace reprise::kernel {

namespace {

TEST(SideThread, DoesBothEveryTime) {
    SideThread side;
    constexpr int times = 20'000;
    int here = 0;
    int there = 0;
    for (int i = 1; i <= times; ++i) {
        side.both([&] { ++here; }, [&] { ++there; });
        ASSERT_EQ(here, i);
        ASSERT_EQ(there, i);
    }
}

TEST(SideThread, ThrowsWhatEitherThrewOnceBothAreDone) {
    SideThread side;
    const auto said = [&](bool here_fails, bool there_fails) -> std::string {
        int done = 0;
        const auto work = [&](bool fails, const char* who) {
            ++done;
            if (fails)
                throw std::runtime_error(who);
        };
        try {
            side.both([&] { work(here_fails, "here"); }, [&] { work(there_fails, "there"); });
        } catch (const std::runtime_error& error) {
            EXPECT_EQ(done, 2);
            return error.what();
        }
        return "nothing";
    };
    EXPECT_EQ(said(false, true), "there");
    EXPECT_EQ(said(true, false), "here");
    EXPECT_EQ(said(true, true), "here");
    EXPECT_EQ(said(false, false), "nothing") << "goes on behind a fault";
}

/// Copies of it have one thread each: what another one held when they were made nobody gives back.
TEST(SideThread, LeavesTheProcessAloneWhereItRests) {
    const auto threads = [] {
        const std::filesystem::directory_iterator all("/proc/self/task");
        return std::distance(begin(all), end(all));
    };
    const auto before = threads();
    SideThread side;
    for (int times = 0; times < 3; ++times) {
        int done = 0;
        side.both([&] { ++done; }, [] {});
        EXPECT_EQ(done, 1);
        side.offer([] {});
        side.rest();
        EXPECT_EQ(threads(), before);
    }
}

TEST(SideThread, WhatIsOfferedIsDoneOnceOrNotAtAll) {
    constexpr int times = 5'000;
    std::atomic<int> offered = 0;
    int there = 0;
    int taken = 0;
    SideThread side;
    for (int i = 1; i <= times; ++i) {
        const int before = offered;
        side.offer([&] { ++offered; });
        if (i % 2 == 0)  // enough of them for it to begin
            for (int waits = 0; offered == before && waits < 1000; ++waits)
                std::this_thread::yield();
        side.drop();
        const int now = offered;
        ASSERT_TRUE(now == before || now == before + 1);
        taken += now - before;
        side.both([] {}, [&] { ++there; });
        ASSERT_EQ(there, i);
        ASSERT_EQ(offered, now) << "begun behind drop";
    }
    EXPECT_GT(taken, 0);
    side.offer([] { throw std::runtime_error("offered"); });
    try {
        side.drop();  // may come before it has begun
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(std::string(error.what()), "offered");
    }
    side.both([] {}, [&] { ++there; });
    EXPECT_EQ(there, times + 1) << "goes on behind a fault";
    side.offer([&] { ++offered; });  // and ends with it
}

TEST(SideThread, OnOneProcessorNothingThatIsOfferedIsDone) {
    const test::OneProcessor alone;
    SideThread side;
    side.offer([] { FAIL(); });
    side.drop();
}

TEST(SideThread, OnOneProcessorDoesBothInTheThreadThatAsks) {
    const test::OneProcessor alone;
    SideThread side;
    std::vector<std::thread::id> who;
    const auto sign = [&] { who.push_back(std::this_thread::get_id()); };
    side.both(sign, sign);
    EXPECT_EQ(who, std::vector(2, std::this_thread::get_id()));
}

}  // namespace

}  // namespace reprise::kernel
