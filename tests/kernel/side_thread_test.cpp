#include "kernel/side_thread.h"

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
