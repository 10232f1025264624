#include "process/copy.h"

#include <csignal>
#include <new>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "process/program.h"
#include "tests/process/scratch.h"
#include "world/check.h"

namespace reprise::process {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;
using How = CopyResult::How;

std::string in_copy(const std::function<std::string()>& work, const Limits& limits = {}) {
    return run_copy({.subject = "x.osm", .work = work, .limits = limits});
}

TEST(Copy, ReturnsWhatItsWorkReturns) {
    const std::string long_one(3'000'000, 'a');
    EXPECT_EQ(in_copy([&] { return long_one; }), long_one);
    EXPECT_EQ(in_copy([] { return std::string("a\0b\n", 4); }), std::string("a\0b\n", 4));
    EXPECT_EQ(in_copy([] { return ""; }), "");
}

TEST(Copy, WorksInAProcessOfItsOwn) {
    int seen = 1;
    const std::string there = in_copy([&] {
        const int before = seen;
        seen = 2;
        return std::to_string(before);
    });
    EXPECT_EQ(there, "1");
    EXPECT_EQ(seen, 1);
}

TEST(Copy, ThrowsWhatItsWorkThrows) {
    EXPECT_THAT([] { in_copy([]() -> std::string { throw world::Error("x.osm:3: no map"); }); },
                ThrowsMessage<world::Error>("x.osm:3: no map"));
    EXPECT_THAT([] { in_copy([]() -> std::string { throw std::logic_error("ours"); }); },
                ThrowsMessage<std::runtime_error>("ours"));
}

TEST(Copy, NeedsNoMoreMemoryThanItMay) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer maps terabytes";
#endif
    const auto greedy = [] { return std::string(std::size_t{9} << 30, 'a').substr(0, 1); };
    EXPECT_THAT([&] { in_copy(greedy, {.memory = std::uint64_t{8} << 30}); },
                ThrowsMessage<world::Error>("x.osm: more than 8 GB of memory would be needed"));
}

TEST(Copy, NeedsNoMoreProcessorTimeThanItMay) {
    const auto busy = []() -> std::string {
        for (volatile bool for_ever = true; for_ever;) {
        }
        return "";
    };
    EXPECT_THAT([&] { in_copy(busy, {.seconds = 1}); },
                ThrowsMessage<world::Error>("x.osm: the work on it was stopped: it needed more "
                                            "than 1 s of processor time"));
}

TEST(Copy, ThatCrashesLeavesUsAliveAndIsToldAsSuch) {
    const auto crash = []() -> std::string {
        raise(SIGKILL);
        return "";
    };
    EXPECT_THAT(
        [&] { in_copy(crash); },
        ThrowsMessage<std::runtime_error>("x.osm: the work on it crashed (signal 9, Killed)"));
    EXPECT_THAT([&] { in_copy([]() -> std::string { _exit(70); }); },
                ThrowsMessage<std::runtime_error>("x.osm: the work on it ended with exit code 70"));
    EXPECT_THAT([&] { in_copy([]() -> std::string { _exit(0); }); },
                ThrowsMessage<std::runtime_error>("x.osm: the work on it ended with exit code 0"));
}

TEST(Copy, ResultsOfManyAreInTheirOrderAndOneFaultLeavesTheOthersAlone) {
    std::vector<Copy> copies;
    for (int i = 0; i < 20; ++i)
        copies.push_back({"x.osm", [i]() -> std::string {
                              if (i == 3)
                                  throw world::Error("three");
                              if (i == 4)
                                  raise(SIGKILL);
                              return std::to_string(i);
                          }});
    const std::vector<CopyResult> results = run_copies(Children(), copies);
    ASSERT_EQ(results.size(), copies.size());
    for (std::size_t i = 0; i < results.size(); ++i) {
        EXPECT_EQ(results[i].how, i == 3 ? How::mistake : i == 4 ? How::fault : How::returned);
        EXPECT_EQ(results[i].text,
                  i == 3   ? "three"
                  : i == 4 ? "x.osm: the work on it crashed (signal 9, Killed)"
                           : std::to_string(i));
    }
}

TEST(Copy, WritesWhatWeHadNotYetWrittenOnlyOnce) {
    ::testing::internal::CaptureStdout();
    std::printf("once ");
    in_copy([] {
        std::printf("there ");
        return "";
    });
    std::printf("here");
    std::fflush(stdout);
    EXPECT_EQ(::testing::internal::GetCapturedStdout(), "once there here");
}

TEST(Copy, AndItsOwnProgramsAreGoneWhenWeAreToldToEnd) {
    test::LifeLine life;
    const auto work = []() -> std::string {
        run_program(
            {"sh", {"-c", "sleep 1000 & kill -TERM " + std::to_string(getppid()) + "; wait"}});
        return "";
    };
    EXPECT_THAT([&] { in_copy(work); }, ThrowsMessage<Stopped>("stopped (Terminated)"));
    life.expect_all_gone();
}

TEST(Copy, ThatIsToldToEndItselfEndsItsProgramsAndSaysSo) {
    test::LifeLine life;
    const auto work = []() -> std::string {
        run_program({"sh", {"-c", "sleep 1000 & kill -TERM $PPID; wait"}});
        return "";
    };
    EXPECT_THAT([&] { in_copy(work); }, ThrowsMessage<world::Error>("stopped (Terminated)"));
    life.expect_all_gone();
}

// The last one: the other thread may be seen for a moment after it was joined.
TEST(Copy, IsRefusedWhileAnotherThreadRuns) {
    int hold[2];
    ASSERT_EQ(pipe(hold), 0);
    std::thread other([&] {
        char none = 0;
        EXPECT_EQ(read(hold[0], &none, 1), 0);
    });
    EXPECT_THROW(in_copy([] { return ""; }), world::CheckFailed);
    close(hold[1]);
    other.join();
    close(hold[0]);
}

}  // namespace
}  // namespace reprise::process
