#include "scripting/spawned_names.h"

#include <gtest/gtest.h>

namespace reprise::scripting {
namespace {

TEST(SpawnedNames, AreTextsOfTheScript) {
    EXPECT_TRUE(may_name("spawn{ name = 'ego' }", "ego"));
    EXPECT_TRUE(may_name("spawn{ name = \"ego\" }", "ego"));
    EXPECT_TRUE(may_name("spawn{ name = 'car_' .. i }", "car_12"));
    EXPECT_TRUE(may_name("spawn{ name = side .. '_car' }", "left_car"));
    EXPECT_TRUE(may_name("spawn{ name = string.format('car_%02d', i) }", "car_12"));
    EXPECT_TRUE(may_name("'ego'", "ego")) << "a parameter's value";
}

TEST(SpawnedNames, OfWhoGotNoneAreThoseOfModels) {
    const char* two = "spawn{ model = 'sedan' } spawn{ model = 'sedan' }";
    EXPECT_TRUE(may_name(two, "sedan"));
    EXPECT_TRUE(may_name(two, "sedan_2"));
    EXPECT_FALSE(may_name(two, "van_2"));
    EXPECT_FALSE(may_name(two, "sedan2"));
    EXPECT_FALSE(may_name("local cars_2 = {}", "cars_2"));
}

TEST(SpawnedNames, AreNotWhatOnlyLooksAlike) {
    const char* one = "-- ego2 and 7\nspawn{ name = 'ego', x = 7 } -- 'later'";
    for (const char* name : {"ego2", "e", "7", "go", "name", "later", "_2"})
        EXPECT_FALSE(may_name(one, name)) << name;
}

}  // namespace
}  // namespace reprise::scripting
