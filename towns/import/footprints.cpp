// What it must do: turn a map's areas into buildings and plots that a town can use: simple
// polygons,
//   counter-clockwise, near the roads, buildings clear of the lanes.
// What it assumes: polyconvert has projected them; each carries its tags as <param>.
// How it goes: read and sort out the areas; drop courtyards (inner rings come as areas of their
// own);
//   clip to the neighbourhood of the roads; cut the lanes' strips out of buildings.
// What it keeps: nothing.
// GCC 12 believes that Boost's boxes are read before they are set, once it inlines them.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include "towns/import/footprints.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/index/rtree.hpp>

#include "towns/import/mapped_building.h"
#include "towns/maps/map_area.h"
#include "world/digest.h"

namespace reprise::towns {

namespace {

namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;
using Polygon = bg::model::polygon<Point, false>;  // counter-clockwise
using Polygons = bg::model::multi_polygon<Polygon>;
using Line = bg::model::linestring<Point>;
using Box = bg::model::box<Point>;
using Tree = bg::index::rtree<std::pair<Box, std::uint32_t>, bg::index::rstar<16>>;

constexpr double neighbourhood = 300;                        ///< [m] from a road
constexpr double smallest_building = 6, smallest_plot = 15;  ///< [m2]

struct Area {
    std::string id;
    Tags tags;
    Polygon outline;
};

std::vector<Area> to_areas(const std::vector<MapShape>& shapes) {
    std::vector<Area> areas;
    for (const MapShape& shape : shapes) {
        Area area{shape.id, shape.tags, {}};
        for (const world::Vec3& point : shape.line)
            area.outline.outer().emplace_back(point.x(), point.y());
        bg::correct(area.outline);
        areas.push_back(std::move(area));
    }
    return areas;
}

/// polyconvert gives the inner rings of a multipolygon as areas with the same tags. Returns how
/// many of them are courtyards of buildings.
int drop_courtyards(std::vector<Area>& areas) {
    const auto is_ring = [](const Area& area) {
        const auto type = area.tags.find("type");
        return type != area.tags.end() && type->second == "multipolygon";
    };
    std::vector<bool> inner(areas.size(), false);
    for (std::size_t i = 0; i < areas.size(); ++i)
        for (std::size_t j = 0; j < areas.size() && is_ring(areas[i]); ++j)
            if (i != j && areas[i].tags == areas[j].tags &&
                bg::area(areas[i].outline) < bg::area(areas[j].outline) &&
                bg::covered_by(areas[i].outline.outer().front(), areas[j].outline))
                inner[i] = true;
    std::vector<Area> kept;
    int courtyards = 0;
    for (std::size_t i = 0; i < areas.size(); ++i)
        if (!inner[i])
            kept.push_back(std::move(areas[i]));
        else
            courtyards += is_building(areas[i].tags) ? 1 : 0;
    areas = std::move(kept);
    return courtyards;
}

Line centre_of(const world::LaneT& lane) {
    Line line;
    for (const world::Vec3& point : lane.centre)
        line.emplace_back(point.x(), point.y());
    return line;
}

/// Lanes by the boxes of their strips.
Tree tree_of(const world::TownT& roads) {
    std::vector<std::pair<Box, std::uint32_t>> boxes;
    for (std::uint32_t i = 0; i < roads.lanes.size(); ++i) {
        Box box = bg::return_envelope<Box>(centre_of(roads.lanes[i]));
        bg::buffer(box, box, roads.lanes[i].width);
        boxes.emplace_back(box, i);
    }
    return Tree(boxes);
}

Box reach(const Tree& lanes) {
    Box box;
    bg::convert(lanes.bounds(), box);
    bg::buffer(box, box, neighbourhood);
    return box;
}

bool is_near_road(const Polygon& outline, const Tree& lanes) {
    Box around = bg::return_envelope<Box>(outline);
    bg::buffer(around, around, neighbourhood);
    return lanes.qbegin(bg::index::intersects(around)) != lanes.qend();
}

/// The strip of a lane and a little more.
Polygons strip(const world::LaneT& lane) {
    constexpr double margin = 0.2;  // [m] so that no wall touches a kerb
    Polygons found;
    bg::buffer(centre_of(lane),
               found,
               bg::strategy::buffer::distance_symmetric<double>(lane.width / 2 + margin),
               bg::strategy::buffer::side_straight(),
               bg::strategy::buffer::join_miter(2),
               bg::strategy::buffer::end_flat(),
               bg::strategy::buffer::point_square());
    return found;
}

const Polygon* largest(const Polygons& pieces) {
    const auto found =
        std::max_element(pieces.begin(), pieces.end(), [](const auto& p, const auto& q) {
            return bg::area(p) < bg::area(q);
        });
    return found == pieces.end() ? nullptr : &*found;
}

/// What is left of a footprint beside the lanes; nothing when that is less than half of it.
std::optional<Polygon> beside_lanes(const Polygon& outline,
                                    const world::TownT& roads,
                                    const Tree& lanes) {
    std::vector<std::uint32_t> near;
    for (auto found = lanes.qbegin(bg::index::intersects(bg::return_envelope<Box>(outline)));
         found != lanes.qend();
         ++found)
        near.push_back(found->second);
    std::sort(near.begin(), near.end());
    Polygons rest{outline};
    for (const std::uint32_t lane : near) {
        Polygons less;
        bg::difference(rest, strip(roads.lanes[lane]), less);
        rest = std::move(less);
    }
    const Polygon* piece = largest(rest);
    if (piece == nullptr || bg::area(*piece) < bg::area(outline) / 2)
        return std::nullopt;
    return *piece;
}

/// The outer ring without its closing point, rounded to millimetres as it will be written.
std::vector<world::Vec3> outline_of(const Polygon& polygon) {
    std::vector<world::Vec3> outline;
    for (std::size_t i = 0; i + 1 < polygon.outer().size(); ++i)
        outline.emplace_back(polygon.outer()[i].x(), polygon.outer()[i].y(), 0.0);
    return outline;
}

void place_building(const Area& area,
                    const world::TownT& roads,
                    const Tree& lanes,
                    const Streets& streets,
                    Place& place,
                    FootprintReport& report) {
    const std::optional<Polygon> rest = beside_lanes(area.outline, roads, lanes);
    if (!rest || bg::area(*rest) < smallest_building) {
        ++report.on_roads;
        return;
    }
    report.cut += bg::area(*rest) < bg::area(area.outline) - 0.01 ? 1 : 0;
    place.buildings.push_back(
        mapped_building(area.tags, outline_of(*rest), streets, world::digest128(area.id).low()));
    ++report.buildings;
}

void place_plot(const Area& area, const Box& box, Place& place, FootprintReport& report) {
    Polygons pieces;
    bg::intersection(area.outline, box, pieces);
    for (const Polygon& piece : pieces) {
        if (bg::area(piece) < smallest_plot)
            continue;
        world::PlotT plot;
        plot.kind = *plot_kind(area.tags);
        plot.outline = outline_of(piece);
        place.plots.push_back(std::move(plot));
        ++report.plots;
    }
}

}  // namespace

FootprintReport place_footprints(const std::vector<MapShape>& shapes,
                                 const world::TownT& roads,
                                 Place& place) {
    FootprintReport report;
    std::vector<Area> areas = to_areas(shapes);
    report.filled = drop_courtyards(areas);
    // Large areas first: smaller ones lie over them.
    std::stable_sort(areas.begin(), areas.end(), [](const Area& left, const Area& right) {
        return bg::area(left.outline) > bg::area(right.outline);
    });
    const Tree lanes = tree_of(roads);
    const Box box = reach(lanes);
    const Streets streets(roads);
    for (const Area& area : areas) {
        if (!is_near_road(area.outline, lanes))
            continue;
        try {
            if (!bg::is_valid(area.outline) || bg::area(area.outline) < 1)
                ++report.broken;
            else if (is_building(area.tags))
                place_building(area, roads, lanes, streets, place, report);
            else
                place_plot(area, box, place, report);
        } catch (const bg::exception&) {
            ++report.broken;  // what Boost cannot cut
        }
    }
    return report;
}

}  // namespace reprise::towns
