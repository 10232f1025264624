#include "world/story/wording.h"

#include <gtest/gtest.h>

namespace reprise::world {

TEST(Wording, CountsOneAndMany) {
    EXPECT_EQ(count_of(0, "check"), "0 checks");
    EXPECT_EQ(count_of(1, "check"), "1 check");
    EXPECT_EQ(count_of(2, "check"), "2 checks");
    EXPECT_EQ(count_of(1, "child", "children"), "1 child");
    EXPECT_EQ(count_of(12, "child", "children"), "12 children");
}

TEST(Wording, ArticlesGoByTheFirstLetter) {
    EXPECT_EQ(with_article("van"), "a van");
    EXPECT_EQ(with_article("adult"), "an adult");
    EXPECT_EQ(with_article("imu"), "an imu");
    EXPECT_EQ(with_article("rgb"), "an rgb");
    EXPECT_EQ(with_article("gnss"), "a gnss");
}

TEST(Wording, ThousandsHaveCommas) {
    EXPECT_EQ(with_thousands(0), "0");
    EXPECT_EQ(with_thousands(-0.2), "0");
    EXPECT_EQ(with_thousands(999.4), "999");
    EXPECT_EQ(with_thousands(999.6), "1,000");
    EXPECT_EQ(with_thousands(12300), "12,300");
    EXPECT_EQ(with_thousands(-1234567), "-1,234,567");
}

TEST(Wording, ZeroHasNoSign) {
    EXPECT_EQ(with_decimals(-0.04, 1), "0.0");
    EXPECT_EQ(with_decimals(-0.0, 0), "0");
    EXPECT_EQ(with_decimals(-0.05, 2), "-0.05");
    EXPECT_EQ(with_decimals(1.25, 1), "1.2");
}

}  // namespace reprise::world
