#include "world/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace reprise {

namespace {

using testing::HasSubstr;
using testing::StartsWith;
using world::did_you_mean;

std::string message_of(const auto& action) {
    try {
        action();
    } catch (const world::CheckFailed& failed) {
        return failed.what();
    }
    return "nothing was thrown";
}

const std::vector<std::string> models{"hatchback", "sedan", "suv", "van", "lorry", "bus"};

}  // namespace

TEST(Check, SaysWhatBrokeAndWhere) {
    const std::string message = message_of([] {
        const int wheels = 3;
        REPRISE_CHECK(wheels == 4, "tick 17: " + std::to_string(wheels) + " wheels");
    });
    EXPECT_THAT(message, StartsWith("world/check_test.cpp:"));
    EXPECT_THAT(message, HasSubstr("wheels == 4"));
    EXPECT_THAT(message, HasSubstr("tick 17: 3 wheels"));
}

TEST(Check, EvaluatesTheMessageOnlyOnFailure) {
    int evaluated = 0;
    const auto values = [&] {
        ++evaluated;
        return std::string();
    };
    REPRISE_CHECK(true, values());
    EXPECT_EQ(evaluated, 0);
    EXPECT_THROW(REPRISE_CHECK(false, values()), world::CheckFailed);
    EXPECT_EQ(evaluated, 1);
}

TEST(Check, IsNotTheUsersMistake) {
    EXPECT_FALSE((std::is_base_of_v<world::Error, world::CheckFailed>));
}

TEST(DidYouMean, SuggestsTheNearestName) {
    EXPECT_EQ(did_you_mean("sedna", models), " (did you mean 'sedan'?)");
    EXPECT_EQ(did_you_mean("hatchbak", models), " (did you mean 'hatchback'?)");
    EXPECT_EQ(did_you_mean("vn", models), " (did you mean 'van'?)");
}

TEST(DidYouMean, SuggestsANameThatSaysItsUnitAsWell) {
    const std::vector<std::string> keys{"name", "type", "fov_deg", "yaw_deg", "size", "rate_hz"};
    EXPECT_EQ(did_you_mean("fov", keys), " (did you mean 'fov_deg'?)");
    EXPECT_EQ(did_you_mean("yaw", keys), " (did you mean 'yaw_deg'?)");
    EXPECT_EQ(did_you_mean("rate", keys), " (did you mean 'rate_hz'?)");
    EXPECT_EQ(did_you_mean("far", keys), "");
}

TEST(DidYouMean, SuggestsTheSameNameInOtherLetters) {
    EXPECT_EQ(did_you_mean("RGB", {"rgb", "depth", "dvs"}), " (did you mean 'rgb'?)");
    EXPECT_EQ(did_you_mean("NUSCENES", {"kitti", "coco", "nuscenes"}),
              " (did you mean 'nuscenes'?)");
}

TEST(DidYouMean, KeepsQuietWhenNothingIsNear) {
    EXPECT_EQ(did_you_mean("submarine", models), "");
    const std::vector<std::string> weathers{"clear_noon", "clear_night", "soft_rain_night"};
    EXPECT_EQ(did_you_mean("rainy_night", weathers), " (did you mean 'soft_rain_night'?)");
    EXPECT_EQ(did_you_mean("night", weathers), " (did you mean 'clear_night'?)");
    EXPECT_EQ(did_you_mean("NightRain", weathers), " (did you mean 'soft_rain_night'?)");
    EXPECT_EQ(did_you_mean("thunderstorm", weathers), "");
    EXPECT_EQ(did_you_mean("x", {}), "");
}

}  // namespace reprise
