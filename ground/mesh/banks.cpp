// Must: leave no edge of a road in the air, where one would look under it.
// Assumes: what build_ground gives: faces are counter-clockwise from above, terrain never rises
//   above a road.
// Goes: an edge that belongs to one triangle only, and beside which plumb lines fall onto terrain
//   more than a step lower, hangs. A strip goes from it outwards and down, as earth is heaped up,
//   until it is below the terrain, or to where other ground begins. Strips of edges that share a
//   corner share its foot; where a row of them ends, a triangle closes the side.
// Keeps: the strips lie outside all roads in plan.
#include "ground/mesh/banks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "ground/mesh/decks.h"
#include "ground/mesh/ground_builder.h"
#include "ground/mesh/ground_probe.h"
#include "ground/mesh/slabs.h"
#include "ground/mesh/terrain.h"

namespace reprise::ground {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double least_step = terrain_depth + 0.03;  ///< [m] lower ones show no gap
constexpr double probe_offset = 0.15;                ///< [m] from an edge, where one asks
constexpr double longest_stretch = 2;                ///< [m] of an edge: half a cell of terrain
constexpr double steepness = 0.75;  ///< of a bank; a sun at noon shines on both sides
constexpr double buried = 0.1;      ///< [m] that a foot is below the terrain
constexpr double widest = 3;        ///< [m] of a bank
constexpr double highest = 3;       ///< [m] what hangs higher is no bank's

/// In whole millimetres: corners of neighbours are equal but for rounding.
using Place = std::array<std::int64_t, 3>;

Place place_of(const Vector3d& p) {
    return {std::llround(p.x() * 1000), std::llround(p.y() * 1000), std::llround(p.z() * 1000)};
}

/// A stretch of an edge from which a bank may go down.
struct Edge {
    Vector3d from;
    Vector3d to;         ///< its right side is the outside
    double covered = 0;  ///< [m] down to here something is drawn already

    Vector2d outward() const {
        const Vector2d along = (to - from).head<2>();
        return Vector2d(along.y(), -along.x()).normalized();
    }
};

void add_stretches(const Edge& edge, std::vector<Edge>& stretches) {
    const Vector3d along = edge.to - edge.from;
    const double length = along.head<2>().norm();
    if (length < 2e-3)
        return;
    const int count = static_cast<int>(std::ceil(length / longest_stretch));
    for (int i = 0; i < count; ++i)
        stretches.push_back({edge.from + along * (static_cast<double>(i) / count),
                             edge.from + along * (static_cast<double>(i + 1) / count),
                             edge.covered});
}

bool is_road(Surface surface) {
    return surface == Surface::road || surface == Surface::crossing;
}

/// A side of a triangle, from one vertex to another.
std::uint64_t side_of(const std::array<std::uint32_t, 3>& triangle, std::size_t side) {
    return std::uint64_t{triangle[side]} << 32 | triangle[(side + 1) % 3];
}

/// Ascending.
std::vector<std::uint64_t> sides_of_roads(const GroundMesh& ground) {
    std::vector<std::uint64_t> sides;
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        for (std::size_t side = 0; is_road(ground.surfaces[i]) && side < 3; ++side)
            sides.push_back(side_of(ground.triangles[i], side));
    std::sort(sides.begin(), sides.end());
    return sides;
}

/// Where roads end, and kerbs reach the height of the terrain in flat towns.
std::vector<Edge> borders(const GroundMesh& ground) {
    const std::vector<std::uint64_t> sides = sides_of_roads(ground);
    const auto has_neighbour = [&](std::uint64_t side) {
        return std::binary_search(sides.begin(), sides.end(), side << 32 | side >> 32);
    };
    const double up = kerb_depth - terrain_depth;
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        for (std::size_t side = 0; side < 3; ++side) {
            const auto& triangle = ground.triangles[i];
            const Vector3d& from = ground.vertices[triangle[side]];
            const Vector3d& to = ground.vertices[triangle[(side + 1) % 3]];
            const double top = ground.vertices[triangle[(side + 2) % 3]].z();
            if (is_road(ground.surfaces[i]) && !has_neighbour(side_of(triangle, side)))
                add_stretches({from, to}, edges);
            if (ground.surfaces[i] == Surface::kerb && from.z() < top && to.z() < top)
                add_stretches({from + up * Vector3d::UnitZ(), to + up * Vector3d::UnitZ(), up},
                              edges);
        }
    return edges;
}

/// Turned over, so that plumb lines from above find them.
GroundMesh undersides_of(const GroundMesh& ground) {
    GroundMesh decks;
    for (std::size_t i = 0; i < ground.triangles.size(); ++i) {
        if (ground.surfaces[i] != Surface::deck)
            continue;
        const auto first = static_cast<std::uint32_t>(decks.vertices.size());
        for (const std::uint32_t vertex : ground.triangles[i])
            decks.vertices.push_back(ground.vertices[vertex]);
        decks.triangles.push_back({first, first + 2, first + 1});
        decks.surfaces.push_back(Surface::road);
    }
    return decks;
}

class Banks {
  public:
    explicit Banks(const GroundMesh& ground)
        : probe_(ground),
          decks_(undersides_of(ground)),
          undersides_(decks_) {}

    GroundMesh build(const std::vector<Edge>& borders);

  private:
    struct Foot {
        Vector2d outward = Vector2d::Zero();  ///< sum over all stretches that meet here
        int stretches = 0;
        Vector3d place;
    };

    std::optional<GroundProbe::Hit> outside(const Vector3d& edge,
                                            const Vector2d& outward,
                                            double away) const {
        return probe_.below(
            {edge.x() + away * outward.x(), edge.y() + away * outward.y(), edge.z() + beside_step});
    }

    bool is_deck(const Vector3d& edge, const Vector2d& outward) const;
    bool hangs(const Edge& edge) const;
    Vector3d foot(const Vector3d& top, const Vector2d& outward, double most) const;
    void place_feet(const Edge& edge);
    void add_bank(const Edge& edge, GroundBuilder& banks) const;

    GroundProbe probe_;
    GroundMesh decks_;
    GroundProbe undersides_;
    std::map<Place, Foot> feet_;
};

/// Is the road of an edge a bridge at that place beside it?
bool Banks::is_deck(const Vector3d& edge, const Vector2d& outward) const {
    constexpr double inside = 0.3;  // [m]
    const Vector2d p = edge.head<2>() - inside * outward;
    const auto underside = undersides_.below({p.x(), p.y(), edge.z()});
    return underside && underside->z > edge.z() - deck_depth - beside_step;
}

/// Does one look under it?
bool Banks::hangs(const Edge& edge) const {
    const Vector3d middle = (edge.from + edge.to) / 2;
    const auto next = outside(middle, edge.outward(), probe_offset);
    return next && next->surface == Surface::terrain &&
           next->z < middle.z() - std::max(least_step, edge.covered) &&
           next->z > middle.z() - highest && !is_deck(middle, edge.outward());
}

/// Where a bank from `top` ends, `most` metres outwards at most.
Vector3d Banks::foot(const Vector3d& top, const Vector2d& outward, double most) const {
    constexpr double step = 0.25;  // [m]
    double away = 0;
    double z = top.z() - least_step;
    if (const auto hit = outside(top, outward, probe_offset); hit && hit->z < z)
        z = hit->z - buried;
    for (double next = step / 2; next <= most; next += step) {
        const auto hit = outside(top, outward, next);
        if (!hit || hit->surface != Surface::terrain)
            break;
        away = next;
        z = hit->z - buried;
        if (hit->z > top.z() - steepness * next)
            break;
    }
    return {top.x() + away * outward.x(), top.y() + away * outward.y(), z};
}

/// Sets the feet of an edge's ends; beside a bridge's side the bank becomes as upright as that.
void Banks::place_feet(const Edge& edge) {
    const Vector2d along = (edge.to - edge.from).head<2>().normalized();
    for (const double way : {-1.0, 1.0}) {
        const Vector3d& top = way < 0 ? edge.from : edge.to;
        Foot& at = feet_.at(place_of(top));
        const Vector3d beyond(top.x() + way * along.x(), top.y() + way * along.y(), top.z());
        const bool narrows = at.stretches == 1 && is_deck(beyond, edge.outward());
        const bool folds = at.outward.norm() < 0.3;  // edges back to back
        at.place =
            foot(top, folds ? edge.outward() : at.outward.normalized(), narrows ? 0 : widest);
    }
}

void Banks::add_bank(const Edge& edge, GroundBuilder& banks) const {
    const Foot& first = feet_.at(place_of(edge.from));
    const Foot& last = feet_.at(place_of(edge.to));
    banks.add_triangle(edge.from, first.place, last.place, Surface::terrain);
    banks.add_triangle(edge.from, last.place, edge.to, Surface::terrain);
    // The sides of a row of banks.
    if (first.stretches == 1)
        banks.add_triangle(edge.from,
                           {edge.from.x(), edge.from.y(), first.place.z()},
                           first.place,
                           Surface::terrain);
    if (last.stretches == 1)
        banks.add_triangle(
            edge.to, last.place, {edge.to.x(), edge.to.y(), last.place.z()}, Surface::terrain);
}

GroundMesh Banks::build(const std::vector<Edge>& borders) {
    std::vector<Edge> edges;
    std::copy_if(borders.begin(), borders.end(), std::back_inserter(edges), [&](const Edge& edge) {
        return hangs(edge);
    });
    for (const Edge& edge : edges)
        for (const Vector3d& top : {edge.from, edge.to}) {
            Foot& foot = feet_[place_of(top)];
            foot.outward += edge.outward();
            ++foot.stretches;
        }
    for (const Edge& edge : edges)
        place_feet(edge);
    GroundBuilder banks;
    for (const Edge& edge : edges)
        add_bank(edge, banks);
    return banks.take();
}

/// As in decks.cpp, of the ground: are all roads at one height?
bool is_flat(const GroundMesh& ground) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < ground.triangles.size(); ++i)
        for (const std::uint32_t vertex : ground.triangles[i]) {
            if (ground.surfaces[i] != Surface::road)
                continue;
            low = std::min(low, ground.vertices[vertex].z());
            high = std::max(high, ground.vertices[vertex].z());
        }
    return high - low < least_step;
}

}  // namespace

GroundMesh build_banks(const GroundMesh& ground) {
    if (is_flat(ground))
        return {};
    return Banks(ground).build(borders(ground));
}

}  // namespace reprise::ground
