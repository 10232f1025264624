#include "towns/maps/map_area.h"

#include <gtest/gtest.h>

#include "world/models/building_models.h"

namespace reprise::towns {
namespace {

TEST(MapArea, ReadsLengthsAsPeopleWriteThem) {
    EXPECT_EQ(length_of("11.5"), 11.5);
    EXPECT_EQ(length_of("11.5 m"), 11.5);
    EXPECT_EQ(length_of("12m"), 12);
    EXPECT_NEAR(length_of("60'").value(), 18.288, 1e-12);
    EXPECT_NEAR(length_of("10 ft").value(), 3.048, 1e-12);
    for (const char* wrong : {"", "high", "-3", "0", "5 floors", "1,5 km"})
        EXPECT_FALSE(length_of(wrong)) << wrong;
}

TEST(MapArea, KnowsWhatFillsItsOutline) {
    EXPECT_TRUE(is_building({{"building", "yes"}}));
    for (const char* open : {"no", "roof", "carport", "canopy"})
        EXPECT_FALSE(is_building({{"building", open}})) << open;
    EXPECT_FALSE(is_building({{"building", "yes"}, {"location", "underground"}}));
    EXPECT_FALSE(is_building({{"building", "yes"}, {"layer", "-1"}}));
    EXPECT_FALSE(is_building({{"leisure", "park"}}));
}

TEST(MapArea, HeightsComeFromTagsThenFloorsThenTheKind) {
    EXPECT_EQ(eaves_height({{"building", "yes"}, {"height", "11.5 m"}, {"building:levels", "9"}}),
              11.5);
    EXPECT_EQ(eaves_height({{"building", "yes"}, {"height", "12"}, {"roof:height", "4"}}), 8);
    EXPECT_EQ(eaves_height({{"building", "house"}, {"building:levels", "5"}}), 15);
    EXPECT_EQ(eaves_height({{"building", "bungalow"}}), 3);
    EXPECT_GT(eaves_height({{"building", "apartments"}}), eaves_height({{"building", "house"}}));
    EXPECT_EQ(eaves_height({{"building", "yes"}, {"height", "0.1"}}), 2.2) << "never flat";
    EXPECT_EQ(eaves_height({{"building", "yes"}, {"height", "99999"}}), 500) << "nor a space lift";
}

TEST(MapArea, ModelsSuitTheKindAndTheFloors) {
    const auto model = [](const Tags& tags, std::uint64_t draw) {
        return world::building_models()[model_of(tags, draw) - 1];
    };
    EXPECT_STREQ(model({{"building", "church"}}, 5).name, "church");
    for (std::uint64_t draw = 0; draw < 40; ++draw) {
        EXPECT_EQ(model({{"building", "house"}}, draw).use, world::BuildingUse::house);
        EXPECT_EQ(model({{"building", "yes"}, {"building:levels", "12"}}, draw).use,
                  world::BuildingUse::tower);
        const world::BuildingModel flats =
            model({{"building", "apartments"}, {"building:levels", "7"}}, draw);
        EXPECT_EQ(flats.use, world::BuildingUse::flats);
        EXPECT_GE(flats.most_floors, 7);
        EXPECT_EQ(model({{"building", "yes"}, {"shop", "bakery"}}, draw).use,
                  world::BuildingUse::shop);
    }
    EXPECT_NE(model_of({{"building", "house"}}, 0), model_of({{"building", "house"}}, 1));
}

TEST(MapArea, LandIsKnownByItsTags) {
    EXPECT_EQ(plot_kind({{"leisure", "park"}}), world::PlotKind::park);
    EXPECT_EQ(plot_kind({{"natural", "water"}, {"name", "Pond"}}), world::PlotKind::water);
    EXPECT_EQ(plot_kind({{"amenity", "parking"}}), world::PlotKind::car_park);
    EXPECT_EQ(plot_kind({{"landuse", "forest"}}), world::PlotKind::forest);
    EXPECT_FALSE(plot_kind({{"landuse", "residential"}}));
    EXPECT_FALSE(plot_kind({}));
}

}  // namespace
}  // namespace reprise::towns
