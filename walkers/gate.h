#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "walkers/map/walk_map.h"
#include "walkers/road_traffic.h"
#include "walkers/walker_lights.h"

namespace reprise::walkers {

/// A part of somebody's way that lies on the road: where he looks before he goes.
struct Gate {
    std::size_t first = 0;  ///< corner of the way where the road begins
    std::size_t last = 0;   ///< and where it ends
    Eigen::Vector3d from{0, 0, 0};
    Eigen::Vector3d to{0, 0, 0};
    bool marked = false;                 ///< a crossing all the way
    std::vector<std::uint32_t> signals;  ///< of it
    std::vector<Conflict> conflicts;

    double length() const { return (to - from).head<2>().norm(); }

    Eigen::Vector2d direction() const;

    /// [m] along it.
    double progress(const Eigen::Vector3d& p_world) const;
};

/// The roads on a way.
std::vector<Gate> gates_of(const std::vector<WalkMap::Step>& way,
                           const world::TownT& town,
                           const world::LaneMap& lanes,
                           const WalkerLights& lights,
                           const RoadTraffic& traffic);

/// How somebody crosses.
struct Pace {
    double progress = 0;  ///< [m] along the gate; negative before it
    double speed = 0;     ///< [m/s]
    Trust trust = Trust::none;
    bool on_road = false;  ///< already: whatever stands in his way he goes around
};

/// May somebody step onto the road? Only at green, and where no car is in the way all the way over.
bool may_enter(const Gate& gate,
               const Pace& pace,
               const WalkerLights& lights,
               const RoadTraffic& traffic);

/// Somebody on the road is about to walk into a lane where a car comes.
bool must_hold(const Gate& gate, const Pace& pace, const RoadTraffic& traffic);

}  // namespace reprise::walkers
