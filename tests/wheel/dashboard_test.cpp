#include "wheel/dashboard.h"

#include <gtest/gtest.h>

namespace reprise::wheel {
namespace {

TEST(Dashboard, SaysWhatIsKnownAndNothingElse) {
    EXPECT_EQ(to_line({.speed = 10}), "36 km/h  D  0:00");
    EXPECT_EQ(to_line({.speed = -2, .reverse = true, .time = 61.9}), "7 km/h  R  1:01");
    EXPECT_EQ(to_line({.speed = 10,
                       .limit = 50 / 3.6,
                       .gap = 22.6,
                       .way = {remote::Turning::left, 340.2},
                       .time = 12,
                       .factor = 0.987,
                       .paused = true}),
              "36 km/h  D  limit 50  gap 23 m  turn left, goal 340 m  0:12  0.99 x real time  "
              "paused");
}

}  // namespace
}  // namespace reprise::wheel
