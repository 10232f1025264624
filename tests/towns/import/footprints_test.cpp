#include "towns/import/footprints.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/support/worlds.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/town.h"

namespace reprise::towns {
namespace {

using Points = std::vector<std::pair<double, double>>;

using testing::IsEmpty;
using testing::SizeIs;

constexpr double edge = 3.5 + 2.5 + 0.2;  ///< [m] from the street's axis: lane, sidewalk, margin

MapShape shape(const std::string& id, const Tags& tags, const Points& points) {
    MapShape made{id, tags, {}};
    for (const auto& [x, y] : points)
        made.line.emplace_back(x, y, 0.0);
    made.line.push_back(made.line.front());
    return made;
}

MapShape building(const std::string& id, const Points& points) {
    return shape(id, {{"building", "yes"}}, points);
}

Points rectangle(double x, double y, double width, double depth) {
    return {{x, y}, {x + width, y}, {x + width, y + depth}, {x, y + depth}};
}

Points points_of(const std::vector<world::Vec3>& outline) {
    Points points;
    for (const world::Vec3& p : outline)
        points.emplace_back(p.x(), p.y());
    return points;
}

double size_of(const std::vector<world::Vec3>& outline) {
    return world::signed_area(world::in_plan(outline));
}

class Footprints : public testing::Test {
  protected:
    FootprintReport place(const std::vector<MapShape>& shapes) {
        place_ = {};
        return place_footprints(shapes, roads_, place_);
    }

    const world::TownT roads_ = test::straight_road(200);
    Place place_;
};

TEST_F(Footprints, BesideTheRoadKeepTheirPointsCounterClockwise) {
    // With a point in the middle of a side, as map makers leave them; finer than a millimetre, as
    // projections do.
    const Points house{{50.0004, 10.1252},
                       {75, 10.1252},
                       {90.0014, 10.1252},
                       {91.6767, 40.5004},
                       {50.2503, 41.3336}};
    Points clockwise = house;
    std::reverse(clockwise.begin() + 1, clockwise.end());
    for (const Points& drawn : {house, clockwise}) {
        EXPECT_EQ(place({building("1", drawn)}).buildings, 1);
        ASSERT_THAT(place_.buildings, SizeIs(1));
        EXPECT_EQ(points_of(place_.buildings[0].outline), house);
    }
}

TEST_F(Footprints, OnTheSidewalkAreCutBackToItsEdge) {
    const FootprintReport report = place({building("1", rectangle(50, 4, 10, 16)),
                                          building("2", rectangle(80, -30, 10, 26)),
                                          building("3", rectangle(90, edge, 10, 20))});
    EXPECT_EQ(report.buildings, 3);
    EXPECT_EQ(report.cut, 2);
    ASSERT_THAT(place_.buildings, SizeIs(3));
    EXPECT_NEAR(size_of(place_.buildings[0].outline), 10 * (30 - edge), 0.02) << "largest first";
    EXPECT_NEAR(size_of(place_.buildings[1].outline), 10 * 20, 1e-9) << "beside it";
    EXPECT_NEAR(size_of(place_.buildings[2].outline), 10 * (20 - edge), 0.02);
    for (const world::DrawnBuildingT& each : place_.buildings)
        for (const world::Vec3& p : each.outline)
            EXPECT_GE(std::abs(p.y()), edge - 0.0011);
}

TEST_F(Footprints, AcrossTheRoadKeepTheirLargerPartOrNothing) {
    EXPECT_EQ(place({building("1", rectangle(50, -20, 10, 60))}).cut, 1);
    ASSERT_THAT(place_.buildings, SizeIs(1));
    EXPECT_NEAR(size_of(place_.buildings[0].outline), 10 * (40 - edge), 0.02);
    const FootprintReport report = place({building("1", rectangle(50, -25, 10, 50)),
                                          building("2", rectangle(80, 2, 10, 8)),
                                          building("3", rectangle(100, edge - 1, 1.9, 3.9))});
    EXPECT_EQ(report.on_roads, 3) << "less than half is left; less than 6 m2 are left";
    EXPECT_THAT(place_.buildings, IsEmpty());
}

/// Two lanes that meet at a right angle, without a curve between them: a bus cuts the corner.
TEST(FootprintsInABend, AreCutBackToWhereABusSweeps) {
    // Also where a piece of a lane, as maps have them, is all that lies behind the bend.
    for (const double piece : {0.0, 0.3}) {
        world::TownT town;
        town.lanes.resize(3);
        town.lanes[0].centre = {{0, 0, 0}, {50, 0, 0}};
        town.lanes[1].centre = {{50, 0, 0}, {50, piece, 0}};
        town.lanes[2].centre = {{50, piece, 0}, {50, 50, 0}};
        for (std::uint32_t i = 0; i < 3; ++i) {
            town.lanes[i].width = 3;
            town.lanes[i].length = i == 1 ? piece : 50;
            if (i < 2)
                town.lanes[i].links = {
                    world::Link(i + 1, world::none, world::none, world::Turn::left, false, 0)};
        }
        if (piece == 0) {
            town.lanes.erase(town.lanes.begin() + 1);
            town.lanes[0].links[0].mutate_to(1);
        }
        Place place;
        const FootprintReport report =
            place_footprints({building("1", rectangle(30, 2, 18, 15))}, town, place);
        EXPECT_EQ(report.cut, 1);
        ASSERT_THAT(place.buildings, SizeIs(1));
        // As a ladder slides down a wall: its middle comes half its length to the corner.
        const world::VehicleModel& bus =
            world::vehicle_models()[world::find_vehicle_model("bus").value()];
        const double reach = (bus.length - bus.rear_overhang) / 2 * std::sqrt(0.5);
        const world::Loop left = world::in_plan(place.buildings[0].outline);
        EXPECT_FALSE(world::contains(left, {50 - reach, reach})) << piece;
        EXPECT_TRUE(world::contains(left, {34, 12}));
    }
}

/// A block around a yard that the map says nothing of, and a street in it.
TEST_F(Footprints, AroundALaneStandOnBothSidesOfIt) {
    const Points block = rectangle(-40, -30, 280, 60);
    const FootprintReport report = place({building("1", block)});
    EXPECT_EQ(report.buildings, 1);
    EXPECT_EQ(report.cut, 1);
    ASSERT_THAT(place_.buildings, SizeIs(2));
    double size = 0;
    for (const world::DrawnBuildingT& each : place_.buildings) {
        const world::Loop loop = world::in_plan(each.outline);
        size += world::signed_area(loop);
        for (const world::LaneT& lane : roads_.lanes)
            for (double s = 1; s < lane.length - 1; s += 1)
                EXPECT_FALSE(world::contains(loop, world::point_at(lane, s).position.head<2>()));
    }
    EXPECT_NEAR(size, 280 * 60 - 202 * 2 * edge, 1);
}

TEST_F(Footprints, MayOverlapEachOther) {
    EXPECT_EQ(place({building("1", rectangle(50, 10, 10, 10)),
                     building("2", rectangle(55, 15, 10, 10)),
                     building("3", rectangle(52, 12, 4, 4))})
                  .buildings,
              3);
}

TEST_F(Footprints, InnerRingsAreCourtyardsAlsoWhereTheyTouchTheOuterOne) {
    const Tags tags{{"building", "yes"}, {"type", "multipolygon"}};
    const Tags pond{{"natural", "water"}, {"type", "multipolygon"}};
    const FootprintReport report = place(
        {shape("1", tags, rectangle(50, 10, 40, 40)),
         shape("2", tags, rectangle(60, 20, 10, 10)),
         shape("3", tags, {{90, 40}, {85, 42}, {85, 38}}),
         shape("4", pond, rectangle(120, 10, 40, 40)),
         shape("5", pond, rectangle(130, 20, 10, 10)),
         shape("6", {{"building", "house"}, {"type", "multipolygon"}}, rectangle(62, 22, 5, 5))});
    EXPECT_EQ(report.filled, 2) << "islands in water are none";
    EXPECT_EQ(report.buildings, 2) << "the block, and a house in its yard";
    EXPECT_EQ(report.plots, 1);
}

TEST_F(Footprints, OutlinesThatAreNotSimpleAreCountedAndLeftOut) {
    const std::vector<Points> broken{
        {{50, 10}, {60, 20}, {60, 10}, {50, 20}},  // a bow tie: no area at all
        {{50, 10}, {60, 20}, {60, 10}, {48, 20}},  // one with a larger side
        {{50, 10}, {60, 10}, {60, 20}, {50, 20}, {50, 10}, {60, 10}, {60, 20}, {50, 20}},  // twice
        {{50, 10}, {60, 10}, {60, 20}, {55, 20}, {55, 30}, {55, 20}, {50, 20}},  // with a spike
        {{50, 10}, {60, 20}, {70, 10}, {70, 30}, {60, 20}, {50, 30}},  // pinched off to a point
        {{50, 10}, {50.5, 10}, {50.5, 11}},                            // below a square metre
        {{50, 10}, {60, 10}},
    };
    for (const Points& points : broken) {
        const FootprintReport report = place({building("1", points)});
        EXPECT_EQ(report.broken, 1) << testing::PrintToString(points);
        EXPECT_THAT(place_.buildings, IsEmpty());
    }
}

TEST_F(Footprints, PlotsEnd300MetresFromTheRoads) {
    const FootprintReport report =
        place({shape("1", {{"landuse", "forest"}}, rectangle(-900, -900, 2000, 2000)),
               shape("2", {{"leisure", "park"}}, rectangle(-50, 20, 40, 40)),
               shape("3", {{"leisure", "park"}}, rectangle(900, 20, 40, 40)),
               building("4", rectangle(900, 20, 10, 10))});
    EXPECT_EQ(report.plots, 2);
    EXPECT_EQ(report.buildings + report.broken, 0) << "those out there do not count";
    ASSERT_THAT(place_.plots, SizeIs(2));
    EXPECT_EQ(place_.plots[0].kind, world::PlotKind::forest) << "larger ones lie below";
    const world::Box box = world::box_around(world::in_plan(place_.plots[0].outline));
    EXPECT_NEAR(box.low.x(), -300, 4);
    EXPECT_NEAR(box.high.x(), 500, 4);
    EXPECT_NEAR(box.high.y(), 306, 4);
    EXPECT_EQ(points_of(place_.plots[1].outline), rectangle(-50, 20, 40, 40));
}

TEST_F(Footprints, AForestLargerThanACountryIsRefused) {
    EXPECT_EQ(place({shape("1", {{"landuse", "forest"}}, rectangle(-5e6, -5e6, 1e7, 1e7))}).broken,
              1);
    EXPECT_EQ(place({shape("1", {{"landuse", "forest"}}, rectangle(-4e5, -4e5, 8e5, 8e5))}).plots,
              1);
}

}  // namespace
}  // namespace reprise::towns
