// What a street map draws, outlines of buildings and plots, stands in the town.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ground/mesh/roofs.h"
#include "tests/towns/import/imports.h"
#include "tests/towns/street_map.h"
#include "towns/network/place.h"
#include "world/models/building_models.h"

namespace reprise::towns {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(Imports, FootprintsKeepTheirPlaceAndHeight) {
    const std::string report = import_town({village(), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("courtyards: 1 were built over"));
    const Place place = read_place(bytes(folder_ / "t/village.place.xml"), "village.place.xml");
    // One lies 2 km away, one is the courtyard of another.
    ASSERT_EQ(place.buildings.size(), 7U);
    const auto side = [](const world::DrawnBuildingT& b, std::size_t i) {
        return std::hypot(b.outline[i].x() - b.outline[i + 1].x(),
                          b.outline[i].y() - b.outline[i + 1].y());
    };
    const auto with_ridge = [&](double height) {
        return std::find_if(place.buildings.begin(), place.buildings.end(), [&](const auto& b) {
            const auto [y, x] = std::minmax({side(b, 0) / 2, side(b, 1) / 2});
            const float rise = ground::roof_rise(world::building_models()[b.model - 1],
                                                 static_cast<float>(x),
                                                 static_cast<float>(y),
                                                 ground::building_seed(b.style));
            return std::abs(b.height + static_cast<double>(rise) - height) < 0.01;
        });
    };
    const auto church = with_ridge(18.288);  // 60'
    ASSERT_NE(church, place.buildings.end());
    EXPECT_EQ(church->model, *world::find_building_model("church") + 1);
    // 16 m x 40 m on the map; projected, within the scale of UTM.
    ASSERT_EQ(church->outline.size(), 4U);
    EXPECT_NEAR(std::min(side(*church, 0), side(*church, 1)), 16, 0.1);
    EXPECT_NEAR(std::max(side(*church, 0), side(*church, 1)), 40, 0.1);
    EXPECT_NE(with_ridge(11.5), place.buildings.end());
    EXPECT_TRUE(std::any_of(place.buildings.begin(), place.buildings.end(), [](const auto& b) {
        return b.height == 15;
    })) << "five floors";
    std::multiset<world::PlotKind> kinds;
    for (const world::PlotT& plot : place.plots)
        kinds.insert(plot.kind);
    EXPECT_EQ(kinds,
              (std::multiset<world::PlotKind>{world::PlotKind::park,
                                              world::PlotKind::water,
                                              world::PlotKind::car_park,
                                              world::PlotKind::playground,
                                              world::PlotKind::lawn}));
}

double area_of(const std::vector<world::Vec3>& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const world::Vec3& p = outline[i];
        const world::Vec3& q = outline[(i + 1) % outline.size()];
        twice += p.x() * q.y() - q.x() * p.y();
    }
    return twice / 2;
}

TEST_F(Imports, BuildingsAreCutBackToTheRoadsOrLeftOut) {
    // One that a road grazes, one in the middle of it; drawn clockwise, in degrees.
    std::string map = bytes(village());
    const auto add = [&](int id, double north, double depth) {
        constexpr double metre = 1 / 111'200.0, metre_east = metre / 0.6232;
        std::string nodes, way = "<way id=\"" + std::to_string(id) + "\">";
        const double corners[4][2] = {{170, 0}, {170, depth}, {190, depth}, {190, 0}};
        for (int i = 0; i < 5; ++i) {
            const int node = id * 10 + i % 4;
            if (i < 4)
                nodes += "<node id=\"" + std::to_string(node) + "\" lat=\"" +
                         std::to_string(51.4520 + (north + corners[i][1]) * metre) + "\" lon=\"" +
                         std::to_string(-2.59 + corners[i][0] * metre_east) + "\"/>";
            way += "<nd ref=\"" + std::to_string(node) + "\"/>";
        }
        map.insert(map.find(" <way"), nodes);
        map.insert(map.rfind("</osm>"), way + "<tag k=\"building\" v=\"yes\"/></way>\n");
    };
    add(9001, 178, 18);  // North Road runs at 180 m: its strip is cut off
    add(9002, 178, 8);   // too little is left
    const std::string report = import_town({write("cut.osm", map), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("8 with their own footprints; 1 cut back"));
    EXPECT_THAT(report, HasSubstr("1 left out"));
    const Place place = read_place(bytes(folder_ / "t/cut.place.xml"), "cut.place.xml");
    for (const world::DrawnBuildingT& building : place.buildings)
        EXPECT_GT(area_of(building.outline), 0) << "counter-clockwise";
}

/// A rectangle: its corners, and two ways around it, both from the first to the third corner.
struct Halves {
    std::vector<int> corners;
    int south_east = 0, north_west = 0;
};

Halves halves(StreetMap& map,
              double west,
              double width,
              double depth,
              const Tagged& tags = {},
              double south = 30) {
    Halves made;
    for (const auto& [east, north] :
         {std::pair{0.0, 0.0}, {width, 0.0}, {width, depth}, {0.0, depth}})
        made.corners.push_back(map.node(west + east, south + north));
    const std::vector<int>& c = made.corners;
    made.south_east = map.way({c[0], c[1], c[2]}, tags);
    made.north_west = map.way({c[0], c[3], c[2]}, tags);
    return made;
}

TEST_F(Imports, OutlinesOfSeveralWaysAreClosed) {
    StreetMap map;
    map.way({map.node(0, 0), map.node(300, 0)}, {{"highway", "residential"}});
    // Two houses of one relation, the second way of each drawn against the first.
    const Halves one = halves(map, 20, 20, 10), two = halves(map, 60, 30, 10);
    map.multipolygon({{one.south_east, "outer"},
                      {two.north_west, "outer"},
                      {one.north_west, "outer"},
                      {two.south_east, ""}},
                     {{"building", "house"}, {"height", "7"}});
    // A park, drawn as a fence; the northern half of it is an edge of a wood, too.
    const Halves park = halves(map, 110, 50, 40, {{"barrier", "fence"}});
    const int far = map.node(100, 110);
    const int around = map.way({park.corners[2], far, park.corners[0]}, {});
    map.multipolygon({{park.south_east, "outer"}, {park.north_west, "outer"}},
                     {{"leisure", "park"}});
    map.multipolygon({{park.north_west, "outer"}, {around, "outer"}}, {{"natural", "wood"}});
    // One half is missing.
    const Halves cut = halves(map, 200, 30, 10);
    map.multipolygon({{cut.south_east, "outer"}, {777, "outer"}}, {{"building", "yes"}});
    const std::string report =
        import_town({write("rings.osm", map.text()), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("buildings: 2 with"));
    EXPECT_THAT(
        report,
        HasSubstr("lost: areas, or parts of them, whose outline does not close in the map: 1"));
    const Place place = read_place(bytes(folder_ / "t/rings.place.xml"), "rings.place.xml");
    std::multiset<long> areas;
    for (const world::DrawnBuildingT& building : place.buildings) {
        areas.insert(std::lround(area_of(building.outline) / 10));
        EXPECT_GT(building.height, 3);
        EXPECT_LE(building.height, 7) << "of the eaves; the ridge has the map's height";
    }
    EXPECT_EQ(areas, (std::multiset<long>{20, 30}));
    std::multiset<world::PlotKind> kinds;
    for (const world::PlotT& plot : place.plots) {
        kinds.insert(plot.kind);
        if (plot.kind == world::PlotKind::park) {
            EXPECT_NEAR(area_of(plot.outline), 50 * 40, 10);
        }
    }
    EXPECT_EQ(kinds, (std::multiset{world::PlotKind::park, world::PlotKind::forest}));
}

TEST_F(Imports, OutlinesAreClosedInEveryEncoding) {
    StreetMap map;
    map.way({map.node(0, 0), map.node(300, 0)}, {{"highway", "residential"}});
    const Halves house = halves(map, 20, 20, 10);
    map.multipolygon({{house.south_east, "outer"}, {house.north_west, "outer"}},
                     {{"building", "yes"}, {"name", "H\xF6he"}});
    const fs::path file =
        write("latin.osm",
              "<?xml version='1.0' encoding='ISO-8859-1'?>\n<!-- <relation> -->" + map.text());
    EXPECT_THAT(import_town({file, "", false, false}, empty("t")), HasSubstr("buildings: 1 with"));
}

TEST_F(Imports, CourtyardsOfSeveralWaysAreCountedAndFilled) {
    StreetMap map;
    map.way({map.node(0, 0), map.node(300, 0)}, {{"highway", "residential"}});
    const Halves yard = halves(map, 40, 10, 10);
    const Halves block = halves(map, 30, 40, 30, {}, 20);
    map.multipolygon({{block.south_east, "outer"},
                      {block.north_west, "outer"},
                      {yard.south_east, "inner"},
                      {yard.north_west, "inner"}},
                     {{"building", "yes"}});
    const std::string report =
        import_town({write("yard.osm", map.text()), "", false, false}, empty("t"));
    EXPECT_THAT(report, HasSubstr("buildings: 1 with"));
    EXPECT_THAT(report, HasSubstr("courtyards: 1 were built over"));
    EXPECT_THAT(report, Not(HasSubstr("lost")));
}

}  // namespace
}  // namespace reprise::towns
