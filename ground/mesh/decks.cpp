#include "ground/mesh/decks.h"

#include <algorithm>
#include <cmath>

#include "ground/mesh/ground_probe.h"
#include "ground/mesh/ribbon.h"
#include "world/frames.h"
#include "world/town.h"

namespace reprise::ground {

namespace {

using Eigen::Vector3d;

constexpr double probe_spacing = 4;  ///< [m] along a lane, between questions whether it hangs

bool is_town_flat(const world::TownT& town) {
    double low = 0;
    double high = 0;
    bool first = true;
    for (const world::LaneT& lane : town.lanes)
        for (const world::Vec3& p : lane.centre) {
            low = first ? p.z() : std::min(low, p.z());
            high = first ? p.z() : std::max(high, p.z());
            first = false;
        }
    return high - low < hanging;
}

/// Terrain lies under everything: where none is found below the surface, it carries that.
bool hangs(const GroundProbe& probe, const Vector3d& p) {
    const auto below = probe.below(p - beside_step * Vector3d::UnitZ());
    return below && below->z < p.z() - hanging;
}

/// The side of a deck; not where the next lane of the same bridge hides it.
void add_side(const GroundProbe& probe,
              const Vector3d& from,
              const Vector3d& to,
              GroundBuilder& ground) {
    const Vector3d along = to - from;
    const double length = along.head<2>().norm();
    if (length < 1e-3)
        return;
    constexpr double probe_offset = 0.15;  // [m]
    const Vector3d outward = Vector3d(along.y(), -along.x(), 0) / length * probe_offset;
    const Vector3d middle = (from + to) / 2;
    const auto next = probe.below(middle + outward + probe_offset * Vector3d::UnitZ());
    if (!next || next->z < middle.z() - probe_offset)
        ground.add_wall(from, to, -deck_depth, 0, Surface::deck);
}

void add_deck(const world::LaneT& lane, const GroundProbe& probe, GroundBuilder& ground) {
    const std::vector<Vector3d> line = with_more_points(clean_line(lane.centre), probe_spacing);
    const Ribbon ribbon = make_ribbon(line, -lane.width / 2, lane.width / 2);
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        if (!hangs(probe, (line[i] + line[i + 1]) / 2))
            continue;
        ground.add_ceiling(
            {ribbon.right[i], ribbon.right[i + 1], ribbon.left[i + 1], ribbon.left[i]},
            deck_depth,
            Surface::deck);
        add_side(probe, ribbon.right[i], ribbon.right[i + 1], ground);
        add_side(probe, ribbon.left[i + 1], ribbon.left[i], ground);
    }
}

}  // namespace

void add_decks(const world::TownT& town, GroundBuilder& ground) {
    if (is_town_flat(town))
        return;
    const GroundMesh above = ground.mesh();
    const GroundProbe probe(above);
    for (const world::LaneT& lane : town.lanes)
        if (world::is_for_cars(lane) || lane.kind == world::LaneKind::sidewalk ||
            lane.kind == world::LaneKind::other)
            add_deck(lane, probe, ground);
}

}  // namespace reprise::ground
