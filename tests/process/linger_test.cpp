#include "process/linger.h"

#include <chrono>

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

/// Who looks for a millisecond has not been alone: to it that is a rival's turn.
TEST(Lingering, EndsWhereSomebodyElseGotTheProcessor) {
    int looks = 0;
    linger(ages, [&] {
        ++looks;
        const auto begin = std::chrono::steady_clock::now();
        while (std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(1)) {
        }
        return false;
    });
    EXPECT_EQ(looks, processors() > 1 ? 1 : 0);
}

}  // namespace
}  // namespace reprise::process
