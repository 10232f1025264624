#include "render/scene/shelter.h"

#include <gtest/gtest.h>

#include "render/scene/town_scene.h"
#include "tests/support/places.h"

namespace reprise::render {
namespace {

/// A floor of 60 m by 60 m, and a roof of 8 m by 8 m over its middle.
struct Pavilion {
    explicit Pavilion(float height) {
        add_quad(floor.mesh, square(30, 0), {Material::asphalt});
        add_quad(roof.mesh, square(4, height), {Material::roof});
        still.resize(2);
        still[0].prototype = &floor;
        still[0].kind = Kind::ground;
        still[1].prototype = &roof;
    }

    static std::array<Eigen::Vector3f, 4> square(float half, float z) {
        return {Eigen::Vector3f(-half, -half, z),
                Eigen::Vector3f(half, -half, z),
                Eigen::Vector3f(half, half, z),
                Eigen::Vector3f(-half, half, z)};
    }

    Prototype floor;
    Prototype roof;
    std::vector<Instance> still;
};

TEST(Shelter, KeepsDryWhatLiesBelowARoof) {
    const Pavilion pavilion(3);
    const Shelter shelter(pavilion.still);
    for (const float x : {-20.0F, -5.0F, 5.0F, 20.0F})
        EXPECT_EQ(shelter.openness({x, 0, 0}), 1) << x << ": beside it";
    for (const float x : {-3.0F, 0.0F, 3.0F})
        EXPECT_EQ(shelter.openness({x, 1, 0}), 0) << x << ": below it";
    EXPECT_EQ(shelter.openness({0, 0, 3}), 1) << "on the roof itself";
    EXPECT_EQ(shelter.openness({0, 0, 9}), 1) << "above it";
    EXPECT_EQ(shelter.openness({1e6F, 0, 0}), 1) << "out of the town";
}

TEST(Shelter, HasASoftEdge) {
    const Pavilion pavilion(3);
    const Shelter shelter(pavilion.still);
    float last = 0;
    for (float x = 3; x < 5; x += 0.01F) {
        const float open = shelter.openness({x, 0, 0});
        EXPECT_GE(open, last);
        EXPECT_LT(open, last + 0.03F);
        last = open;
    }
    EXPECT_EQ(last, 1);
}

TEST(Shelter, OfATableIsNone) {
    const Pavilion table(0.8F);
    EXPECT_EQ(Shelter(table.still).openness({0, 0, 0}), 1);
}

TEST(Shelter, IsBelowABridgeAndNotOnIt) {
    const TownScene town(test::bridge(), false);
    const auto at = [&](double x, double y, double z) {
        return town.shelter().openness((Eigen::Vector3d(x, y, z) - town.origin()).cast<float>());
    };
    EXPECT_EQ(at(0, 0, 0), 0) << "the road below";
    EXPECT_EQ(at(20, 0, 0), 1) << "the same road farther on";
    EXPECT_EQ(at(0, 0, 6), 1) << "the road above";
    EXPECT_EQ(at(0, 60, 2), 1) << "and its ramp";
}

}  // namespace
}  // namespace reprise::render
