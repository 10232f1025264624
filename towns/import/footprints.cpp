// What it must do: turn a map's areas into buildings and plots that a town can use: simple
//   polygons, counter-clockwise, near the roads, buildings clear of the lanes.
// What it assumes: polyconvert has projected them, in millimetres; each carries its tags as
//   <param>.
// How it goes: sort out what crosses itself and courtyards (inner rings are areas of their own);
//   clip plots to the neighbourhood of the roads; cut the lanes' strips out of buildings. What
//   needs no cut keeps its points; one around a lane becomes two beside it.
// What it keeps: nothing.
#include "towns/import/footprints.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "ground/mesh/polygons.h"
#include "towns/import/lane_strips.h"
#include "towns/import/mapped_building.h"
#include "towns/maps/map_area.h"
#include "world/digest.h"
#include "world/geometry2d.h"

namespace reprise::towns {

namespace {

using world::Box;
using world::Loop;

constexpr double neighbourhood = 300;                        ///< [m] from a road
constexpr double smallest_building = 6, smallest_plot = 15;  ///< [m2]
constexpr double widest = 1e6;  ///< [m] of an outline, along either axis

/// Something that the map shows, as it will be placed.
struct Outline {
    std::string id;
    Tags tags;
    Loop loop;        ///< counter-clockwise
    double size = 0;  ///< [m2]
};

std::vector<Outline> to_outlines(const std::vector<MapShape>& shapes) {
    std::vector<Outline> outlines;
    for (const MapShape& shape : shapes) {
        Outline outline{shape.id, shape.tags, world::in_plan(shape.line), 0};
        if (outline.loop.size() > 1 && outline.loop.front() == outline.loop.back())
            outline.loop.pop_back();
        outline.size = world::signed_area(outline.loop);
        if (outline.size < 0)
            std::reverse(outline.loop.begin() + 1, outline.loop.end());
        outline.size = std::abs(outline.size);
        outlines.push_back(std::move(outline));
    }
    return outlines;
}

/// polyconvert gives the inner rings of a multipolygon as areas with the same tags. Returns how
/// many of them are courtyards of buildings.
int drop_courtyards(std::vector<Outline>& outlines) {
    const auto is_ring = [](const Outline& outline) {
        const auto type = outline.tags.find("type");
        return type != outline.tags.end() && type->second == "multipolygon";
    };
    const auto is_on = [](const Eigen::Vector2d& p, const Loop& loop) {
        return world::distance_to(loop, p, p) <= 0;
    };
    std::vector<bool> inner(outlines.size(), false);
    for (std::size_t i = 0; i < outlines.size(); ++i)
        for (std::size_t j = 0; j < outlines.size() && is_ring(outlines[i]); ++j)
            if (i != j && outlines[i].tags == outlines[j].tags &&
                outlines[i].size < outlines[j].size &&
                is_on(outlines[i].loop.front(), outlines[j].loop))
                inner[i] = true;
    std::vector<Outline> kept;
    int courtyards = 0;
    for (std::size_t i = 0; i < outlines.size(); ++i)
        if (!inner[i])
            kept.push_back(std::move(outlines[i]));
        else
            courtyards += is_building(outlines[i].tags) ? 1 : 0;
    outlines = std::move(kept);
    return courtyards;
}

/// ground::Area computes within 1000 km of it; whole metres, so that millimetres stay what they
/// are.
Eigen::Vector2d origin_of(const Loop& loop) {
    return loop.front().array().round();
}

ground::Area area_of(const Loop& loop, const Eigen::Vector2d& origin) {
    ground::Area area(origin);
    area.add(loop);
    return area;
}

double perimeter(const Loop& loop) {
    double length = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        length += (loop[(i + 1) % loop.size()] - loop[i]).norm();
    return length;
}

/// As ground::Area takes it, and as it will be written.
Loop in_whole_millimetres(Loop loop) {
    for (Eigen::Vector2d& p : loop)
        p = (p * 1000).array().round() / 1000;
    return loop;
}

/// Does it enclose one piece of land, and nothing twice? Then its border is the outline itself.
bool is_simple(const Outline& outline) {
    constexpr double rounding = 0.01;  // [m], [m2]
    const Box box = world::box_around(outline.loop);
    if ((box.high - box.low).maxCoeff() > widest || outline.size < 1)
        return false;
    const Loop loop = in_whole_millimetres(outline.loop);
    const std::vector<Loop> borders = area_of(loop, origin_of(loop)).borders();
    return borders.size() == 1 &&
           std::abs(world::signed_area(borders.front()) - world::signed_area(loop)) < rounding &&
           std::abs(perimeter(borders.front()) - perimeter(loop)) < rounding;
}

/// A part of an outline, without its holes.
struct Piece {
    Loop loop;
    double size = 0;  ///< [m2] holes do not count
};

std::vector<Piece> pieces_of(const ground::Area& area) {
    std::vector<Piece> pieces;
    for (const ground::Area& part : area.parts())
        pieces.push_back({part.borders().front(), part.size()});
    return pieces;
}

Loop rectangle(const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
    return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

/// Adds the pieces of an area, which is one part, cut through each of its holes.
void cut_at_holes(ground::Area area, const Eigen::Vector2d& origin, std::vector<Piece>& pieces) {
    constexpr double narrowest = 0.01;                 // [m]
    const std::vector<Loop> borders = area.borders();  // the outer one, and holes
    const Box whole = world::box_around(borders.front());
    const Box hole = world::box_around(borders.back());
    if (borders.size() < 2 || hole.high.x() - hole.low.x() < narrowest) {
        pieces.push_back({borders.front(), area.size()});
        return;
    }
    const double middle = std::round((hole.low.x() + hole.high.x()) * 500) / 1000;
    for (const ground::Area& side :
         {area_of(rectangle(whole.low, {middle, whole.high.y()}), origin),
          area_of(rectangle({middle, whole.low.y()}, whole.high), origin)}) {
        ground::Area half = area.copy();
        half.intersect(side);
        for (ground::Area& part : half.parts())
            cut_at_holes(std::move(part), origin, pieces);
    }
}

/// What is left of a footprint beside the lanes; nothing when that is less than half of it. In two
/// or more pieces where lanes lie within it, as in a yard.
std::vector<Piece> beside_lanes(const Outline& outline, const LaneStrips& lanes) {
    const Eigen::Vector2d origin = origin_of(outline.loop);
    ground::Area rest = area_of(outline.loop, origin);
    const double whole = rest.size();
    rest.subtract(lanes.around(outline.loop, origin));
    if (rest.size() >= whole)
        return {{outline.loop, outline.size}};
    std::vector<ground::Area> parts = rest.parts();
    const auto largest = std::max_element(
        parts.begin(), parts.end(), [](const ground::Area& one, const ground::Area& other) {
            return one.size() < other.size();
        });
    std::vector<Piece> pieces;
    if (largest != parts.end() && largest->size() >= outline.size / 2)
        cut_at_holes(std::move(*largest), origin, pieces);
    std::erase_if(pieces, [](const Piece& piece) { return piece.size < smallest_building; });
    return pieces;
}

/// What lies in the box. [m]
std::vector<Piece> clip(const Outline& outline, const Box& box) {
    const Box own = world::box_around(outline.loop);
    const Eigen::Vector2d low = own.low.cwiseMax(box.low), high = own.high.cwiseMin(box.high);
    if (low == own.low && high == own.high)
        return {{outline.loop, outline.size}};
    const Eigen::Vector2d origin = origin_of(outline.loop);
    ground::Area inside = area_of(outline.loop, origin);
    inside.intersect(area_of(rectangle(low, high), origin));
    return pieces_of(inside);
}

std::vector<world::Vec3> on_the_ground(const Loop& loop) {
    std::vector<world::Vec3> points;
    for (const Eigen::Vector2d& p : loop)
        points.emplace_back(p.x(), p.y(), 0.0);
    return points;
}

void place_building(const Outline& outline,
                    const LaneStrips& lanes,
                    const Streets& streets,
                    Place& place,
                    FootprintReport& report) {
    const std::vector<Piece> pieces = beside_lanes(outline, lanes);
    double size = 0;
    for (const Piece& piece : pieces) {
        place.buildings.push_back(mapped_building(
            outline.tags, on_the_ground(piece.loop), streets, world::digest128(outline.id).low()));
        size += piece.size;
    }
    if (pieces.empty())
        ++report.on_roads;
    else
        ++report.buildings;
    report.cut += !pieces.empty() && size < outline.size - 0.01 ? 1 : 0;
}

void place_plot(const Outline& outline, const Box& box, Place& place, FootprintReport& report) {
    for (const Piece& piece : clip(outline, box)) {
        if (piece.size < smallest_plot)
            continue;
        world::PlotT plot;
        plot.kind = *plot_kind(outline.tags);
        plot.outline = on_the_ground(piece.loop);
        place.plots.push_back(std::move(plot));
        ++report.plots;
    }
}

}  // namespace

FootprintReport place_footprints(const std::vector<MapShape>& shapes,
                                 const world::TownT& roads,
                                 Place& place) {
    FootprintReport report;
    std::vector<Outline> outlines = to_outlines(shapes);
    report.filled = drop_courtyards(outlines);
    // Large areas first: smaller ones lie over them.
    std::stable_sort(
        outlines.begin(), outlines.end(), [](const Outline& left, const Outline& right) {
            return left.size > right.size;
        });
    const LaneStrips lanes(roads);
    const Box box = lanes.box(neighbourhood);
    const Streets streets(roads);
    for (const Outline& outline : outlines) {
        if (!lanes.is_near(outline.loop, neighbourhood))
            continue;
        if (!is_simple(outline))
            ++report.broken;
        else if (is_building(outline.tags))
            place_building(outline, lanes, streets, place, report);
        else
            place_plot(outline, box, place, report);
    }
    return report;
}

}  // namespace reprise::towns
