#include "traffic/cars/fleet.h"

#include <array>

#include <gtest/gtest.h>

#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {
namespace {

TEST(Fleet, IsMostlyCars) {
    std::array<int, 16> counts{};
    for (int i = 0; i < 1000; ++i)
        ++counts.at(demand_model((i + 0.5) / 1000, world::permitted("", "")));
    int cars = 0;
    for (std::uint16_t i = 0; i < counts.size(); ++i) {
        EXPECT_GT(counts.at(i), 0) << world::vehicle_models()[i].name;
        if (std::string_view(world::vehicle_models()[i].sumo_class) == "passenger")
            cars += counts.at(i);
    }
    EXPECT_GT(cars, 800);
}

TEST(Fleet, LeavesOutWhatTheRoadsAreClosedTo) {
    const world::ClassSet roads = world::permitted("", "bicycle bus");
    for (int i = 0; i < 1000; ++i) {
        const std::uint16_t model = demand_model((i + 0.5) / 1000, roads);
        EXPECT_NE(model_class(model) & roads, 0U) << world::vehicle_models()[model].name;
    }
}

TEST(Fleet, EveryModelHasAClassThatSumoKnows) {
    for (std::uint16_t i = 0; i < world::vehicle_models().size(); ++i)
        EXPECT_NE(model_class(i), 0U) << world::vehicle_models()[i].name;
}

}  // namespace
}  // namespace reprise::traffic
