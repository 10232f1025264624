#include "replay/table/value_text.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace reprise::replay {

namespace {

TEST(ValueText, ShowsTheShortestDecimalThatReadsBackAndTheBits) {
    EXPECT_EQ(value_text(0.1), "0.1 (0x3fb999999999999a)");
    EXPECT_EQ(value_text(0.1f), "0.1 (0x3dcccccd)");
    EXPECT_EQ(value_text(-0.0), "-0 (0x8000000000000000)");
}

TEST(ValueText, CountsUnitsInTheLastPlaceAcrossZeroAndPowersOfTwo) {
    EXPECT_EQ(distance_text(1.0, std::nextafter(1.0, 2.0)), "1 unit in the last place apart");
    EXPECT_EQ(distance_text(1.0, std::nextafter(1.0, 0.0)), "1 unit in the last place apart");
    const double tiny = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(distance_text(-tiny, tiny), "2 units in the last place apart");
    EXPECT_EQ(distance_text(-0.0, 0.0), "they differ in the sign of zero");
    EXPECT_EQ(distance_text(1.0f, std::nextafter(1.0f, 2.0f)), "1 unit in the last place apart");
}

TEST(ValueText, SaysNoDistanceWhereItWouldNotHelp) {
    EXPECT_EQ(distance_text(1.0, 2.0), "");
    EXPECT_EQ(distance_text(1.0, std::nan("")), "");
}

TEST(ValueText, ShowsOnlyTheLineOfLongTextsThatDiffers) {
    const auto [left, right] = text_pair("one\ntwo\nthree", "one\ntwo!\nthree");
    EXPECT_EQ(left, "line 2: 'two'");
    EXPECT_EQ(right, "line 2: 'two!'");
}

}  // namespace

}  // namespace reprise::replay
