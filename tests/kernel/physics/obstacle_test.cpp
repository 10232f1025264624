#include <gtest/gtest.h>

#include "tests/kernel/physics/physics_rig.h"
#include "world/tick.h"

namespace reprise::kernel {
namespace {

using test::ProvingGround;
using world::PropKind;
using world::Vec3;

/// Sum of impulses that a sedan meets in 3 s, driving along x from the origin at 10 m/s. [N s]
double impulse_in(const world::TownT& town, double y = 0) {
    ProvingGround ground(test::flat_ground(), town);
    ground.add_vehicle("sedan", 10, 0, y);
    double impulse = 0;
    for (int tick = 0; tick < 60; ++tick) {
        ground.step(test::coasting());
        for (const kernel::Impact& impact : ground.physics().impacts())
            impulse += impact.impulse;
    }
    return impulse;
}

world::Prop prop(PropKind kind, double length, double width, double height) {
    return {
        Vec3(15, 0, 0), 1.57, length, width, height, 0U, std::uint16_t{0}, kind, std::uint8_t{0}};
}

/// An L around the quarter x > 20, y > 0.
world::DrawnBuildingT corner_house() {
    world::DrawnBuildingT drawn;
    drawn.outline = {Vec3(10, -10, 0),
                     Vec3(40, -10, 0),
                     Vec3(40, -4, 0),
                     Vec3(20, -4, 0),
                     Vec3(20, 12, 0),
                     Vec3(10, 12, 0)};
    drawn.height = 6;
    return drawn;
}

TEST(Obstacle, AllThatStandsStopsAVehicle) {
    for (const world::Prop& each : {prop(PropKind::wall, 8, 0.3, 1),
                                    prop(PropKind::fence, 8, 0.1, 1),
                                    prop(PropKind::hedge, 8, 0.6, 1.2),
                                    prop(PropKind::parked_vehicle, 4.6, 1.8, 1.5),
                                    prop(PropKind::street_light, 2, 0.16, 7.5),
                                    prop(PropKind::bus_stop, 4, 1.3, 2.5)}) {
        world::TownT town;
        town.props.push_back(each);
        EXPECT_GT(impulse_in(town), 5000) << static_cast<int>(each.kind());
    }
    world::TownT town;
    town.heads.emplace_back();
    town.heads[0].foot = Vec3(15, 0, 0);
    EXPECT_GT(impulse_in(town), 5000);
}

TEST(Obstacle, NobodyDrivesUnderAHouse) {
    world::TownT town;
    town.buildings.emplace_back(Vec3(20, 0, 2.5), 0, 10, 8, 6, 0U, 1U);
    EXPECT_GT(impulse_in(town), 5000) << "its floor is over the car's roof";
}

TEST(Obstacle, BushesStopAVehicleThatDrivesIntoTheirMiddle) {
    for (const auto kind : {world::PlantKind::round_bush,
                            world::PlantKind::tall_bush,
                            world::PlantKind::flowering_bush}) {
        world::TownT town;
        town.trees.emplace_back(Vec3(15, 0, 0), 1.5, 0.8, 0U, kind);
        EXPECT_GT(impulse_in(town), 5000) << static_cast<int>(kind);
        EXPECT_EQ(impulse_in(town, 1.6), 0) << "leaves brush along it";
    }
}

TEST(Obstacle, DrawnBuildingsStopWhereTheirWallsAre) {
    world::TownT town;
    town.drawn_buildings.push_back(corner_house());
    EXPECT_GT(impulse_in(town, 8), 5000) << "into the upright of the L";
    EXPECT_GT(impulse_in(town, -7), 5000) << "into its foot";
    EXPECT_EQ(impulse_in(town, 15), 0) << "past it";
    // In the courtyard, between both arms.
    ProvingGround ground(test::flat_ground(), town);
    ground.add_vehicle("sedan", 10, 24, 3);
    for (int tick = 0; tick < 40; ++tick) {
        ground.step(test::coasting());
        EXPECT_TRUE(ground.tick().tick.events.empty()) << tick;
    }
}

}  // namespace
}  // namespace reprise::kernel
