#include "walkers/walking_ground.h"

#include <algorithm>

#include "ground/mesh/build_ground.h"
#include "ground/obstacles.h"
#include "world/geometry2d.h"

namespace reprise::walkers {

namespace {

/// [m] A crossing's ends reach over the kerb, so that no gap between it and the sidewalk is left,
/// and who waits before it stands this far from the road.
constexpr double over_the_kerb = 0.5;

/// A crossing between two points of its centre line.
world::Loop strip(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double half_width) {
    const Eigen::Vector2d ahead = (to - from).normalized();
    const Eigen::Vector2d left = half_width * world::turned_left(ahead);
    // Narrower over the kerb: beside its ends the kerb is round, and cars come near.
    const Eigen::Vector2d inner = std::max(0.4, half_width - 0.6) * world::turned_left(ahead);
    const Eigen::Vector2d start = from - over_the_kerb * ahead;
    const Eigen::Vector2d end = to + over_the_kerb * ahead;
    return {start - inner,
            from - left,
            to - left,
            end - inner,
            end + inner,
            to + left,
            from + left,
            start + inner};
}

std::vector<world::Loop> crossings_in(const world::TownT& town) {
    std::vector<world::Loop> loops;
    for (const world::LaneT& lane : town.lanes) {
        if (lane.kind != world::LaneKind::crossing)
            continue;
        for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i)
            loops.push_back(strip(world::in_plan(lane.centre[i]),
                                  world::in_plan(lane.centre[i + 1]),
                                  lane.width / 2));
    }
    return loops;
}

}  // namespace

WalkingGround::WalkingGround(const world::TownT& town, const ground::GroundMesh* mesh)
    : town_(&town),
      mesh_(mesh != nullptr ? mesh : &own_mesh_.emplace(ground::build_ground(town))),
      probe_(*mesh_),
      obstacles_(ground::obstacles_of(town)) {}

WalkMap WalkingGround::make(bool roads) const {
    TileRules rules;
    rules.cell = 0.2F;
    rules.radius = 2;
    // A straight kerb that runs askew to the cells is off by up to one cell: with less each of its
    // steps stays a corner, and Recast takes the third power of their number (measured: 15 times as
    // long for a town of 61 lane-km).
    rules.simplification = 1.1F;
    rules.roads = roads;
    rules.heights = false;
    return WalkMap(*mesh_, rules, obstacles_, crossings_in(*town_));
}

const WalkMap& WalkingGround::pavement() {
    if (!pavement_)
        pavement_.emplace(make(false));
    return *pavement_;
}

const WalkMap& WalkingGround::streets() {
    if (!streets_)
        streets_.emplace(make(true));
    return *streets_;
}

double WalkingGround::height(const Eigen::Vector3d& p_world,
                             ground::GroundProbe::Around& around) const {
    constexpr double step_up = 0.6;  // [m] more than a kerb, less than a bridge
    const auto hit = probe_.below(p_world + step_up * Eigen::Vector3d::UnitZ(), around);
    return hit ? hit->z : p_world.z();
}

}  // namespace reprise::walkers
