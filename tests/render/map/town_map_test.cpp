#include "render/map/town_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "ground/mesh/build_ground.h"
#include "ground/paint/markings.h"
#include "render/map/road_mask.h"
#include "tests/support/worlds.h"
#include "world/town.h"

namespace reprise::render {
namespace {

using Colour = std::array<int, 3>;

world::SensorFrame map_of(const world::TownT& town, const MapView& view) {
    return town_map(town, ground::build_ground(town), ground::build_markings(town), view);
}

Colour at(const world::SensorFrame& map, int x, int y) {
    const std::size_t first = static_cast<std::size_t>((y * map.width + x) * 3);
    return {map.data[first], map.data[first + 1], map.data[first + 2]};
}

/// Of the place in the middle of the map: a region of 24 m around it, whose middle is the picture's
/// to a few pixels, as heading and legend are as high.
std::vector<Colour> around(const world::TownT& town, double x, double y) {
    MapView view;
    view.size = 400;
    view.region.take({x - 12, y - 12});
    view.region.take({x + 12, y + 12});
    const world::SensorFrame map = map_of(town, view);
    std::vector<Colour> colours;
    for (int dy = -4; dy <= 4; ++dy)
        for (int dx = -4; dx <= 4; ++dx)
            colours.push_back(at(map, map.width / 2 + dx, map.height / 2 + dy));
    return colours;
}

bool is_grey(const Colour& colour) {
    return std::abs(colour[0] - colour[2]) < 22 && colour[0] < 180 && colour[0] > 80;
}

TEST(TownMap, IsAsLargeAsAskedFor) {
    for (const int size : {200, 777}) {
        const world::SensorFrame map = map_of(test::straight_road(100), {{}, size});
        EXPECT_EQ(std::max(map.width, map.height), size);
        EXPECT_EQ(map.data.size(), static_cast<std::size_t>(map.width * map.height * 3));
    }
    // A long and narrow part fills the sheet's longer side only.
    MapView view;
    view.size = 600;
    view.region.take({0, -5});
    view.region.take({20, 95});
    const world::SensorFrame tall = map_of(test::straight_road(100), view);
    EXPECT_EQ(tall.height, 600);
    EXPECT_LT(tall.width, 600);
}

TEST(TownMap, IsTheSameBytesEveryTime) {
    const world::TownT town = test::straight_road(100, 2);
    EXPECT_EQ(map_of(town, {{}, 400}).data, map_of(town, {{}, 400}).data);
}

TEST(TownMap, ShowsRoadWhereTheRoadIs) {
    const world::TownT town = test::straight_road(200);
    const std::vector<Colour> road = around(town, 130, -1.9);
    EXPECT_TRUE(std::all_of(road.begin(), road.end(), is_grey));
    const std::vector<Colour> land = around(town, 130, -20);
    for (const Colour& colour : land)
        EXPECT_GT(colour[1], colour[2] + 10) << "land is greenish";
}

TEST(TownMap, ShowsBuildingsAndPlants) {
    world::TownT town = test::straight_road(200);
    town.buildings.clear();
    town.trees.clear();
    const Colour land = around(town, 130, 20)[40];
    world::Building building;
    building.mutable_centre() = world::Vec3(130, 20, 0);
    building.mutate_length(10);
    building.mutate_width(10);
    building.mutate_height(6);
    town.buildings.push_back(building);
    EXPECT_NE(around(town, 130, 20)[40], land);
    town.buildings.clear();
    world::Tree tree;
    tree.mutable_position() = world::Vec3(130, 20, 0);
    tree.mutate_crown_radius(4);
    tree.mutate_height(8);
    town.trees.push_back(tree);
    const Colour green = around(town, 130, 20)[40];
    EXPECT_GT(green[1], green[0] + 20);
}

TEST(TownMap, BearsNamesThatItCannotWrite) {
    world::TownT town = test::straight_road(200);
    for (const char* name : {"\xC3\x9C"
                             "ber den Linden",
                             "\xD0\x9D\xD0\xB5\xD0\xB2\xD0\xB0",
                             "\xC3",
                             ""}) {
        for (world::LaneT& lane : town.lanes)
            lane.street = name;
        EXPECT_GT(map_of(town, {{}, 300}).data.size(), 0U);
    }
}

TEST(RoadMask, IsWhiteWhereALaneIsAndBlackBesideTheRoad) {
    const world::TownT town = test::straight_road(200);
    const world::Box region{{-20, -40}, {150, 40}};
    constexpr double pixel = 0.1;
    const world::SensorFrame mask = road_mask(ground::build_ground(town), region, pixel);
    ASSERT_EQ(mask.width, 1700);
    ASSERT_EQ(mask.height, 800);
    // As nuScenes' devkit looks a place up: rows count from the top.
    const auto at_place = [&](double x, double y) {
        const auto column = std::lround((x - region.low.x()) / pixel);
        const auto row = mask.height - std::lround((y - region.low.y()) / pixel);
        return mask.data[static_cast<std::size_t>(row * mask.width + column)];
    };
    double south = 1e9;
    double north = -1e9;
    for (const world::LaneT& lane : town.lanes)
        for (double s = 1; s < 140; s += 7) {
            const Eigen::Vector3d on = world::point_at(lane, s).position;
            if (on.x() < 1 || on.x() > 140)
                continue;
            for (const double aside : {-0.45, 0.0, 0.45})
                EXPECT_EQ(at_place(on.x(), on.y() + aside * lane.width), 255) << s;
            south = std::min(south, on.y() - lane.width / 2);
            north = std::max(north, on.y() + lane.width / 2);
        }
    ASSERT_LT(south, north);
    for (double x = 1; x < 140; x += 7)
        for (const double beside : {1.5, 6.0})
            for (const double y : {south - beside, north + beside})
                EXPECT_EQ(at_place(x, y), 0) << x << ' ' << y;
    EXPECT_TRUE(std::all_of(mask.data.begin(), mask.data.end(), [](std::uint8_t value) {
        return value == 0 || value == 255;
    }));
}

}  // namespace
}  // namespace reprise::render
