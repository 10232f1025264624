#include "towns/import/mapped_building.h"

#include <gtest/gtest.h>

#include "ground/mesh/roofs.h"
#include "tests/support/worlds.h"

namespace reprise::towns {
namespace {

using world::RoofKind;

std::vector<world::Vec3> footprint_of(double length, double width) {
    return {world::Vec3(100, 40, 0),
            world::Vec3(100 + length, 40, 0),
            world::Vec3(100 + length, 40 + width, 0),
            world::Vec3(100, 40 + width, 0)};
}

class MappedBuilding : public testing::Test {
  protected:
    world::DrawnBuildingT build(const Tags& tags,
                                const std::vector<world::Vec3>& outline,
                                std::uint64_t draw) const {
        return mapped_building(tags, outline, streets_, draw << 48 | draw);
    }

    /// What stands there in the end; nothing: a prism.
    std::optional<Footprint> standing(const world::DrawnBuildingT& building) const {
        const auto site = rectangular_site(world::in_plan(building.outline), streets_);
        return site ? fit(model(building), *site, streets_) : std::nullopt;
    }

    static const world::BuildingModel& model(const world::DrawnBuildingT& building) {
        return world::building_models()[building.model - 1];
    }

    const Streets streets_{test::straight_road()};
};

TEST_F(MappedBuilding, IsAsHighAsTheMapSays) {
    for (const auto& [tag, ridge] : {std::pair{"house", 8.5}, {"house", 4.2}, {"yes", 7}})
        for (std::uint64_t draw = 1; draw < 30; ++draw) {
            const auto building = build({{"building", tag}, {"height", std::to_string(ridge)}},
                                        footprint_of(12, 9.5),
                                        draw);
            const auto f = standing(building);
            ASSERT_TRUE(f) << tag << ridge;
            const float rise = ground::roof_rise(model(building),
                                                 static_cast<float>(f->length / 2),
                                                 static_cast<float>(f->width / 2),
                                                 ground::building_seed(building.style));
            EXPECT_NEAR(building.height + static_cast<double>(rise), ridge, 0.01)
                << model(building).name;
            EXPECT_GT(building.height, 2.2);
        }
}

TEST_F(MappedBuilding, ItsModelSuitsKindAndSize) {
    for (std::uint64_t draw = 1; draw < 30; ++draw) {
        const auto house = build({{"building", "house"}}, footprint_of(10, 8.5), draw);
        EXPECT_EQ(model(house).use, world::BuildingUse::house);
        EXPECT_TRUE(standing(house)) << model(house).name;
        EXPECT_EQ(house.height, 6) << "two floors; the roof is over them";
        const auto terrace = build({{"building", "terrace"}}, footprint_of(30, 10), draw);
        EXPECT_EQ(model(terrace).use, world::BuildingUse::terrace);
        EXPECT_TRUE(standing(terrace)) << model(terrace).name;
    }
    EXPECT_STREQ(model(build({{"building", "church"}}, footprint_of(28, 13), 3)).name, "church");
    EXPECT_STREQ(model(build({{"building", "church"}}, footprint_of(11, 7), 3)).name, "chapel");
}

TEST_F(MappedBuilding, SpiresEndWhereTheMapSaysIfANaveIsLeft) {
    const auto high = build({{"building", "church"}, {"height", "45"}}, footprint_of(28, 13), 3);
    const auto f = standing(high);
    ASSERT_TRUE(f);
    const auto y = static_cast<float>(f->width / 2);
    const double rise = static_cast<double>(ground::roof_rise(
        model(high), static_cast<float>(f->length / 2), y, ground::building_seed(high.style)));
    EXPECT_NEAR(
        high.height + rise + static_cast<double>(ground::spire_rise(model(high), y)), 45, 0.01);
    const auto low = build({{"building", "church"}, {"height", "14"}}, footprint_of(28, 13), 3);
    EXPECT_NEAR(low.height + rise, 14, 0.01) << "of the nave";
}

TEST_F(MappedBuilding, OddOutlinesKeepTheirHeightToo) {
    const std::vector<world::Vec3> corner{world::Vec3(100, 40, 0),
                                          world::Vec3(120, 40, 0),
                                          world::Vec3(120, 48, 0),
                                          world::Vec3(108, 48, 0),
                                          world::Vec3(108, 60, 0),
                                          world::Vec3(100, 60, 0)};
    EXPECT_EQ(build({{"building", "house"}, {"height", "9"}}, corner, 2).height, 9) << "flat";
    std::vector<world::Vec3> kite = footprint_of(12, 10);
    kite[2].mutate_x(104);
    for (std::uint64_t draw = 1; draw < 20; ++draw) {
        const auto building = build({{"building", "house"}, {"height", "9"}}, kite, draw);
        EXPECT_FALSE(standing(building));
        const RoofKind roof = model(building).roof;
        const bool pitched = roof == RoofKind::gabled || roof == RoofKind::hipped;
        EXPECT_NEAR(
            building.height + (pitched ? ground::hipped_rise(world::in_plan(kite)) : 0), 9, 1e-9);
    }
}

}  // namespace
}  // namespace reprise::towns
