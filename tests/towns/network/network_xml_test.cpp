#include "towns/network/network_xml.h"

#include <gtest/gtest.h>

#include "world/models/vehicle_classes.h"

namespace reprise::towns {

TEST(NetworkXml, ReadsShapesThatMixTwoAndThreeDimensions) {
    const auto shape = parse_shape("1.5,-2 3,4,5.25  6,7");
    ASSERT_EQ(shape.size(), 3U);
    EXPECT_EQ(shape[0], world::Vec3(1.5, -2, 0));
    EXPECT_EQ(shape[1], world::Vec3(3, 4, 5.25));
    EXPECT_EQ(shape[2], world::Vec3(6, 7, 0));
}

TEST(NetworkXml, DropsRepeatedPoints) {
    EXPECT_EQ(parse_shape("0,0 0,0 0,0.0004 1,0 1,0").size(), 2U);
    EXPECT_TRUE(parse_shape("").empty());
    EXPECT_TRUE(parse_shape(" \n ").empty());
}

TEST(NetworkXml, PermissionsFollowSumosRules) {
    const world::ClassSet car = world::class_bit("passenger");
    const world::ClassSet bus = world::class_bit("bus");
    EXPECT_NE(world::permitted("", "") & car, 0U);
    EXPECT_EQ(world::permitted("", "all"), 0U);
    EXPECT_EQ(world::permitted("bus", ""), bus);
    EXPECT_EQ(world::permitted("", "passenger") & car, 0U);
    EXPECT_EQ(world::permitted("", "passenger") & bus, bus);
    EXPECT_NE(world::permitted("all", "passenger") & car, 0U) << "allow wins";
    EXPECT_EQ(world::permitted("drone bus", ""), bus) << "unknown words are ignored";
}

TEST(NetworkXml, CountsLinesFromOne) {
    EXPECT_EQ(line_of("a\nb\nc", 0), 1U);
    EXPECT_EQ(line_of("a\nb\nc", 2), 2U);
    EXPECT_EQ(line_of("a\nb\nc", 400), 3U);
}

TEST(NetworkXml, NumbersAreReadInNoLocale) {
    EXPECT_EQ(number("13.89", 0), 13.89);
    EXPECT_EQ(number("", 7), 7);
    EXPECT_EQ(number("fast", 7), 7);
    EXPECT_EQ(number("nan", 7), 7);
    EXPECT_EQ(number("7x8", 1), 1);
}

}  // namespace reprise::towns
