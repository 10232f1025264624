// Must: find everything that hangs in the air or is sunk into the ground.
// Assumes: nothing of how heights were found.
// Goes: plumb lines at the foot of each thing, on the level nearest to it: what stands under a
//   bridge is measured there. Beyond the terrain there is no ground at all.
// Keeps: for each criterion the worst things, by name.
#include "towns/check/standing_check.h"

#include <algorithm>
#include <cmath>

#include "ground/mesh/ground_probe.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/building_models.h"

namespace reprise::towns {

namespace {

using Eigen::Vector2d;

constexpr double things_limit = 0.25;  ///< [m]
constexpr double doors_limit = 0.30;   ///< [m]
constexpr double no_ground = 10;       ///< [m] said of what stands beyond the terrain
constexpr double before_door = 0.3;    ///< [m]
constexpr double at_edge = 0.05;       ///< [m] from a wall to the ground that it stands on

/// How far a thing is above the ground. [m]
double gap(const ground::GroundProbe& probe, const Vector2d& p, double z) {
    const auto ground = probe.nearest({p.x(), p.y(), z});
    return ground ? z - ground->z : no_ground;
}

/// Those that are as long as they look: the foot of all others is their middle.
bool has_ends(world::PropKind kind) {
    return kind == world::PropKind::fence || kind == world::PropKind::wall ||
           kind == world::PropKind::hedge || kind == world::PropKind::bench ||
           kind == world::PropKind::bus_stop;
}

/// Of its middle and, where it has them, its ends. A wall may stand at the edge of a bridge: the
/// ground beside it counts as well.
double gap_of(const ground::GroundProbe& probe, const world::Prop& prop) {
    const Vector2d x = world::ahead_of(prop.yaw());
    const Vector2d aside = world::turned_left(x) * (prop.width() / 2 + at_edge);
    double worst = 0;
    for (const double share : {0.0, -0.5, 0.5}) {
        if (share != 0 && !has_ends(prop.kind()))
            continue;
        const Vector2d p = world::in_plan(prop.position()) + x * (share * prop.length());
        double least = std::abs(gap(probe, p, prop.position().z()));
        if (prop.kind() == world::PropKind::wall)
            for (const double side : {-1.0, 1.0})
                least =
                    std::min(least, std::abs(gap(probe, p + side * aside, prop.position().z())));
        worst = std::max(worst, least);
    }
    return worst;
}

Criterion check_things(const world::TownT& town, const ground::GroundProbe& probe) {
    Measured off("things on the ground", things_limit, "m");
    const auto take = [&](const std::string& name, const world::Vec3& foot) {
        off.take(name, world::in_plan(foot), std::abs(gap(probe, world::in_plan(foot), foot.z())));
    };
    for (std::size_t i = 0; i < town.trees.size(); ++i)
        take(numbered("plant", i), town.trees[i].position());
    for (std::size_t i = 0; i < town.heads.size(); ++i)
        take(numbered("signal head", i), town.heads[i].foot);
    for (std::size_t i = 0; i < town.props.size(); ++i) {
        const world::Prop& prop = town.props[i];
        off.take(numbered(EnumNamePropKind(prop.kind()), i),
                 world::in_plan(prop.position()),
                 gap_of(probe, prop));
    }
    const std::string looked_at = std::to_string(off.count()) + " things";
    return std::move(off).verdict(looked_at);
}

/// What grows or stands in the road, wherever in its width: the ground itself says what is road.
/// Parapets of bridges do, at its edge, and parked cars where the lane has room for them.
Criterion check_off_road(const world::TownT& town, const ground::GroundProbe& probe) {
    std::vector<Criterion::Place> faults;
    std::size_t count = 0;
    const auto take = [&](const std::string& name, const world::Vec3& foot) {
        ++count;
        const auto hit = probe.nearest(world::to_eigen(foot));
        if (hit &&
            (hit->surface == ground::Surface::road || hit->surface == ground::Surface::crossing))
            faults.push_back({name, world::in_plan(foot), 1});
    };
    for (std::size_t i = 0; i < town.trees.size(); ++i)
        take(numbered("plant", i), town.trees[i].position());
    for (std::size_t i = 0; i < town.heads.size(); ++i)
        take(numbered("signal head", i), town.heads[i].foot);
    for (std::size_t i = 0; i < town.props.size(); ++i)
        if (town.props[i].kind() != world::PropKind::wall &&
            town.props[i].kind() != world::PropKind::parked_vehicle)
            take(numbered(EnumNamePropKind(town.props[i].kind()), i), town.props[i].position());
    return none_of("things on roads", std::move(faults), std::to_string(count) + " things");
}

/// How far the door on one of its sides is off the ground, at best; more where a wall's foundation
/// does not reach down.
double door_gap(const ground::GroundProbe& probe,
                const world::Loop& outline,
                double floor,
                std::size_t first_side,
                std::size_t sides) {
    double door = no_ground;
    for (std::size_t i = first_side; i < first_side + sides; ++i) {
        const Vector2d side = outline[(i + 1) % outline.size()] - outline[i];
        const Vector2d out = -world::turned_left(side.normalized());
        const Vector2d place = outline[i] + side / 2 + out * before_door;
        door = std::min(door, std::abs(gap(probe, place, floor)));
    }
    for (const Vector2d& corner : outline)
        door = std::max(door, gap(probe, corner, floor) - world::foundation_depth);
    return door;
}

Criterion check_doors(const world::TownT& town, const ground::GroundProbe& probe) {
    Measured off("doors on the ground", doors_limit, "m");
    for (std::size_t i = 0; i < town.buildings.size(); ++i) {
        const world::Building& b = town.buildings[i];
        const Vector2d x = world::ahead_of(b.yaw()) * b.length() / 2;
        const Vector2d y = world::left_of(b.yaw()) * b.width() / 2;
        const Vector2d c = world::in_plan(b.centre());
        const world::Loop outline{c - x - y, c + x - y, c + x + y, c - x + y};
        off.take(numbered("building", i), c, door_gap(probe, outline, b.centre().z(), 0, 1));
    }
    for (std::size_t i = 0; i < town.drawn_buildings.size(); ++i) {
        const world::DrawnBuildingT& b = town.drawn_buildings[i];
        if (b.outline.size() < 3)
            continue;
        const world::Loop outline = world::in_plan(b.outline);
        off.take(numbered("drawn building", i),
                 outline[0],
                 door_gap(probe, outline, b.outline[0].z(), 0, outline.size()));
    }
    const std::string looked_at = std::to_string(off.count()) + " buildings";
    return std::move(off).verdict(looked_at);
}

}  // namespace

std::vector<Criterion> check_standing(const world::TownT& town, const ground::GroundMesh& ground) {
    const ground::GroundProbe probe(ground);
    return {check_things(town, probe), check_doors(town, probe), check_off_road(town, probe)};
}

}  // namespace reprise::towns
