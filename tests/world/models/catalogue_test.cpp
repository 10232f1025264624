#include "world/models/catalogue.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "world/check.h"
#include "world/models/prop_models.h"
#include "world/tick.h"

namespace reprise::world {
namespace {

TEST(Catalogue, HasSixteenVehiclesAndFiftyWalkersOfDistinctNames) {
    EXPECT_EQ(vehicle_models().size(), 16U);
    EXPECT_EQ(walker_models().size(), 50U);
    const std::vector<std::string> names = model_names();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(),
              16U + 50U + prop_models().size());
    for (std::size_t i = 0; i < vehicle_models().size(); ++i)
        EXPECT_EQ(find_vehicle_model(vehicle_models()[i].name), i);
    for (std::size_t i = 0; i < walker_models().size(); ++i)
        EXPECT_EQ(find_walker_model(walker_models()[i].name), i);
}

TEST(Catalogue, KeepsTheIndicesThatOlderTracesHold) {
    EXPECT_EQ(find_vehicle_model("sedan"), 0);
    EXPECT_EQ(find_vehicle_model("bus"), 5);
    EXPECT_EQ(find_walker_model("adult"), 0);
    EXPECT_EQ(find_walker_model("senior"), 2);
}

TEST(Catalogue, VehiclesStandOnTheirWheels) {
    for (const VehicleModel& m : vehicle_models()) {
        EXPECT_LT(m.rear_overhang + m.wheelbase, m.length) << m.name;
        EXPECT_LT(m.track, m.width) << m.name;
        EXPECT_LT(2 * m.wheel_radius, m.height) << m.name;
        // Lighter than water, heavier than a tenth of it.
        const double density = m.mass / (m.length * m.width * m.height);
        EXPECT_GT(density, 45) << m.name;
        EXPECT_LT(density, 250) << m.name;
        // Climbs 10 % with what its lowest gear gives.
        EXPECT_GT(m.max_drive_force, 1.2 * 0.1 * m.mass * 9.81) << m.name;
    }
}

TEST(Catalogue, WalkersAreBuiltLikePeople) {
    for (const WalkerModel& m : walker_models()) {
        const double index = m.mass / (m.height * m.height);
        EXPECT_GT(index, 13) << m.name;
        EXPECT_LT(index, 31) << m.name;
        EXPECT_GT(m.girth, 0.33 * m.height) << m.name;
        EXPECT_LT(m.girth, 0.68 * m.height) << m.name;
        EXPECT_NEAR(m.shoulder_width / m.height, 0.255, 0.03) << m.name;
        EXPECT_EQ(m.age == Age::child, m.height < 1.4) << m.name;
    }
}

TEST(Look, IsDrawnFromSeedAndIdAlone) {
    std::set<std::uint32_t> looks;
    for (std::uint32_t id = 1; id <= 1000; ++id) {
        const Look look = drawn_look(7, id);
        EXPECT_EQ(look.actor(), id);
        EXPECT_NE(look.look(), 0U);
        EXPECT_EQ(look.look(), drawn_look(7, id).look());
        EXPECT_NE(look.look(), drawn_look(8, id).look());
        looks.insert(look.look());
    }
    EXPECT_EQ(looks.size(), 1000U);
}

}  // namespace
}  // namespace reprise::world
