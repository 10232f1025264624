#include "process/linger.h"

#include <atomic>
#include <chrono>
#include <sched.h>
#include <thread>

#include <gtest/gtest.h>

#include "process/processors.h"

namespace reprise::process {
namespace {

constexpr double ages = 3600;  // [s]

TEST(Lingering, EndsAsSoonAsItIsThere) {
    int looks = 0;
    linger(ages, [&] { return ++looks == 1; });
    EXPECT_EQ(looks, processors() > 1 ? 1 : 0);
}

TEST(Lingering, EndsAfterItsTime) {
    int looks = 0;
    linger(0, [&] {
        ++looks;
        return false;
    });
    EXPECT_EQ(looks, processors() > 1 ? 1 : 0);
}

/// Keeps the calling thread, and those it starts, on the processor that it is on.
class OnOneProcessor {
  public:
    OnOneProcessor() {
        sched_getaffinity(0, sizeof(before_), &before_);
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(sched_getcpu(), &one);
        sched_setaffinity(0, sizeof(one), &one);
    }

    ~OnOneProcessor() { sched_setaffinity(0, sizeof(before_), &before_); }

    OnOneProcessor(const OnOneProcessor&) = delete;
    OnOneProcessor& operator=(const OnOneProcessor&) = delete;

  private:
    cpu_set_t before_;
};

TEST(Lingering, EndsWhereSomebodyElseWantsTheProcessor) {
    linger(0, [] { return true; });  // it asks for its processors once
    const OnOneProcessor here;
    std::atomic<bool> over = false;
    std::thread rival([&] {
        while (!over) {
        }
    });
    const auto begin = std::chrono::steady_clock::now();
    bool stayed = false;
    linger(ages, [&] {
        stayed = std::chrono::steady_clock::now() - begin > std::chrono::seconds(20);
        return stayed;
    });
    over = true;
    rival.join();
    EXPECT_FALSE(stayed);
}

}  // namespace
}  // namespace reprise::process
