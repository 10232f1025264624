#include "exchange/carla/carla_models.h"

#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "world/models/catalogue.h"

namespace reprise::exchange {
namespace {

CarlaActor actor(std::string blueprint, std::map<std::string, std::string> attributes = {}) {
    CarlaActor made;
    made.blueprint = std::move(blueprint);
    made.attributes = std::move(attributes);
    return made;
}

std::string vehicle(const CarlaActor& actor, const std::optional<CarlaBox>& box = {}) {
    return world::vehicle_models()[vehicle_model_for(actor, box).model].name;
}

const world::WalkerModel& walker(const CarlaActor& actor) {
    return world::walker_models()[walker_model_for(actor).model];
}

std::string pedestrian(int number) {
    return fmt::format("walker.pedestrian.{:04}", number);
}

TEST(CarlaModels, TakeServicesAndTwoWheelersForWhatTheyAre) {
    EXPECT_EQ(vehicle(actor("vehicle.ford.crown")), "taxi");
    EXPECT_EQ(vehicle(actor("vehicle.dodge.charger_police_2020")), "police");
    EXPECT_EQ(vehicle(actor("vehicle.dodge.charger_2020")), "sedan");
    EXPECT_EQ(vehicle(actor("vehicle.ford.ambulance")), "ambulance");
    EXPECT_EQ(vehicle(actor("vehicle.yamaha.yzf")), "motorcycle");
    EXPECT_EQ(vehicle(actor("vehicle.bh.crossbike")), "bicycle");
    EXPECT_EQ(vehicle(actor("vehicle.new.bike", {{"base_type", "bicycle"}})), "bicycle");
}

TEST(CarlaModels, GiveNobodyAServicesPaintByItsSize) {
    for (const world::VehicleModel& model : world::vehicle_models()) {
        CarlaBox box;
        box.middle = Eigen::Vector3d::Zero();
        box.extent = Eigen::Vector3d(model.length, model.width, model.height) * 50;  // [cm], half
        const CarlaModel found = vehicle_model_for(actor("vehicle.new.car"), box);
        EXPECT_EQ(found.guessed_by, "by its size");
        EXPECT_EQ(world::vehicle_models()[found.model].livery, world::Livery::plain);
        if (model.livery == world::Livery::plain) {
            EXPECT_STREQ(world::vehicle_models()[found.model].name, model.name);
        }
    }
}

TEST(CarlaModels, SpreadBlueprintsOverThePedestriansOfTheirAge) {
    std::set<std::string> adults;
    for (int number = 1; number <= 52; ++number) {
        const world::WalkerModel& model = walker(actor(pedestrian(number)));
        const bool is_child = (number >= 9 && number <= 14) || number == 48 || number == 49;
        EXPECT_EQ(model.age, is_child ? world::Age::child : world::Age::adult) << number;
        EXPECT_NE(model.clothing, world::Clothing::uniform) << model.name;
        if (!is_child)
            adults.insert(model.name);
    }
    EXPECT_GT(adults.size(), 12U);
    EXPECT_EQ(walker(actor(pedestrian(21))).name, walker(actor(pedestrian(21))).name);
}

TEST(CarlaModels, BelieveAttributesOfAgeAndGender) {
    for (int number = 1; number <= 52; ++number) {
        const auto with = [&](const char* age, const char* gender) -> const world::WalkerModel& {
            return walker(actor(pedestrian(number), {{"age", age}, {"gender", gender}}));
        };
        EXPECT_EQ(with("elderly", "").age, world::Age::senior);
        EXPECT_EQ(with("teenager", "female").age, world::Age::teen);
        const world::WalkerModel& man = with("adult", "male");
        EXPECT_NE(man.clothing, world::Clothing::skirt) << man.name;
        EXPECT_NE(man.clothing, world::Clothing::dress) << man.name;
        EXPECT_NE(with("adult", "female").name, man.name);
    }
}

}  // namespace
}  // namespace reprise::exchange
