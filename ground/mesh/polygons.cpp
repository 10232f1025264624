#include "ground/mesh/polygons.h"

#include <algorithm>
#include <cmath>

#include <boost/polygon/polygon.hpp>

#include "ground/mesh/triangulation.h"

namespace reprise::ground {

namespace bp = boost::polygon;

namespace {

using GridPoint = bp::point_data<int>;
using Polygon = bp::polygon_data<int>;
using PolygonWithHoles = bp::polygon_with_holes_data<int>;

constexpr double units_per_metre = 1000;

__extension__ using Wide = __int128;

Wide cross(const GridPoint& origin, const GridPoint& first, const GridPoint& second) {
    return Wide(first.x() - origin.x()) * (second.y() - origin.y()) -
           Wide(first.y() - origin.y()) * (second.x() - origin.x());
}

/// Every corner lies inside of every side that it is not on, by two units: Boost leaves such a
/// polygon as it is, since none of its sides comes within rounding of another corner.
bool is_plainly_convex(const std::vector<GridPoint>& points) {
    constexpr std::size_t most = 8;
    constexpr int clearance = 2;
    if (points.size() > most)
        return false;
    const bool left = cross(points[0], points[1], points[2]) > 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t next = (i + 1) % points.size();
        const Wide squared_length = bp::distance_squared(points[i], points[next]);
        for (std::size_t k = 0; k < points.size(); ++k) {
            if (k == i || k == next)
                continue;
            const Wide side = cross(points[i], points[next], points[k]);
            if ((side > 0) != left || side * side < clearance * clearance * squared_length)
                return false;
        }
    }
    return true;
}

/// Twice the area, exact.
Wide doubled_area(const std::vector<GridPoint>& points) {
    Wide sum = 0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
        sum += cross(points[0], points[i], points[i + 1]);
    return sum < 0 ? -sum : sum;
}

/// Likewise of a clean set, whose edges are there once each.
Wide doubled_area(const bp::polygon_set_data<int>& clean) {
    if (clean.begin() == clean.end())
        return 0;
    const GridPoint origin = clean.begin()->first.first;
    Wide sum = 0;
    for (const auto& [edge, direction] : clean) {
        // Edges lie from left to right, and upright ones are said the other way round.
        const bool upright = edge.first.x() == edge.second.x();
        sum += (upright ? -direction : direction) * cross(origin, edge.first, edge.second);
    }
    return sum < 0 ? -sum : sum;
}

}  // namespace

struct Area::Set {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    bp::polygon_set_data<int> polygons;

    GridPoint inward(const Eigen::Vector2d& p) const {
        const Eigen::Vector2d local = (p - origin) * units_per_metre;
        return {static_cast<int>(std::lround(local.x())), static_cast<int>(std::lround(local.y()))};
    }

    Eigen::Vector2d outward(const GridPoint& p) const {
        return origin + Eigen::Vector2d(p.x(), p.y()) / units_per_metre;
    }

    template <typename Points>
    world::Loop loop(const Points& polygon) const {
        world::Loop result;
        for (auto point = polygon.begin(); point != polygon.end(); ++point)
            result.push_back(outward(*point));
        if (result.size() > 1 && result.front() == result.back())
            result.pop_back();
        return result;
    }
};

Area::Area() : Area(Eigen::Vector2d::Zero()) {}

Area::Area(const Eigen::Vector2d& origin) : set_(std::make_unique<Set>()) {
    set_->origin = origin;
}

Area::~Area() = default;
Area::Area(Area&&) noexcept = default;
Area& Area::operator=(Area&&) noexcept = default;

Area Area::copy() const {
    Area other(set_->origin);
    other.set_->polygons = set_->polygons;
    return other;
}

void Area::add(const world::Loop& loop) {
    std::vector<GridPoint> points;
    for (const Eigen::Vector2d& p : loop) {
        const GridPoint point = set_->inward(p);
        if (points.empty() || points.back() != point)
            points.push_back(point);
    }
    while (points.size() > 1 && points.front() == points.back())
        points.pop_back();
    if (points.size() < 3)
        return;
    const Polygon polygon(points.begin(), points.end());
    if (is_plainly_convex(points)) {
        set_->polygons.insert(polygon);
        return;
    }
    // On its own first: a lobe that turns the other way would cancel what is there already.
    bp::polygon_set_data<int> turned_with;
    turned_with.insert(polygon);
    turned_with.clean();
    set_->polygons.insert(turned_with);
    // One that does not cross itself has no lobes. Boost's area takes as long as all the rest.
    if (doubled_area(turned_with) == doubled_area(points))
        return;
    // Where the lobes that turn with the whole are more than the whole, others turn against it.
    const auto whole = std::abs(static_cast<double>(bp::area(polygon)));
    constexpr double rounding = 1000;  // [mm2]
    if (static_cast<double>(bp::area(turned_with)) <= whole + rounding)
        return;
    bp::polygon_set_data<int> turned_against;
    turned_against.insert(polygon, true);
    turned_against.clean();
    set_->polygons.insert(turned_against);
}

void Area::merge(const Area& other) {
    using namespace bp::operators;
    set_->polygons |= other.set_->polygons;
}

void Area::subtract(const Area& other) {
    using namespace bp::operators;
    set_->polygons -= other.set_->polygons;
}

void Area::intersect(const Area& other) {
    using namespace bp::operators;
    set_->polygons &= other.set_->polygons;
}

void Area::shrink(double width) {
    set_->polygons.resize(-static_cast<int>(std::lround(width * units_per_metre)));
}

double Area::size() const {
    set_->polygons.clean();
    return static_cast<double>(doubled_area(set_->polygons)) /
           (2 * units_per_metre * units_per_metre);
}

std::vector<world::Loop> Area::pieces() const {
    std::vector<PolygonWithHoles> polygons;
    set_->polygons.get(polygons);
    std::vector<world::Loop> borders;
    const auto add = [&](const auto& polygon) {
        borders.emplace_back();
        for (auto point = polygon.begin(); point != polygon.end(); ++point)
            borders.back().emplace_back(point->x(), point->y());
    };
    for (const PolygonWithHoles& polygon : polygons) {
        add(polygon);
        for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole)
            add(*hole);
    }
    std::vector<world::Loop> loops;
    for (const auto& triangle : triangulate(borders)) {
        loops.emplace_back();
        for (const Eigen::Vector2d& corner : triangle)
            loops.back().push_back(set_->origin + corner / units_per_metre);
    }
    return loops;
}

std::vector<world::Loop> Area::borders() const {
    std::vector<PolygonWithHoles> polygons;
    set_->polygons.get(polygons);
    std::vector<world::Loop> loops;
    for (const PolygonWithHoles& polygon : polygons) {
        loops.push_back(set_->loop(polygon));
        if (world::signed_area(loops.back()) < 0)
            std::reverse(loops.back().begin(), loops.back().end());
        for (auto hole = polygon.begin_holes(); hole != polygon.end_holes(); ++hole) {
            loops.push_back(set_->loop(*hole));
            if (world::signed_area(loops.back()) > 0)
                std::reverse(loops.back().begin(), loops.back().end());
        }
    }
    return loops;
}

std::vector<Area> Area::parts() const {
    std::vector<PolygonWithHoles> polygons;
    set_->polygons.get(polygons);
    std::vector<Area> parts;
    for (const PolygonWithHoles& polygon : polygons) {
        Area part(set_->origin);
        part.set_->polygons.insert(polygon);
        // Rounding to whole millimetres leaves nothing of some slivers.
        if (part.size() > 0)
            parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace reprise::ground
