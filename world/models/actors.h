#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Geometry>

#include "world/models/catalogue.h"
#include "world/models/prop_models.h"
#include "world/tick.h"

namespace reprise::world {

/// The box around an actor, upright in its own frame: x from `rear` to `front`, y to both sides by
/// `half_width`, z from the ground up to `height`. [m]
struct Extent {
    double rear = 0;  ///< negative: behind the origin
    double front = 0;
    double half_width = 0;
    double height = 0;

    double middle() const { return (rear + front) / 2; }
};

Extent extent_of(const VehicleModel& model);
Extent extent_of(const WalkerModel& model);
Extent extent_of(const PropModel& model);

/// Of an actor, whatever it is; nothing when it is not in the tick.
std::optional<Extent> find_extent(const TickView& tick, std::uint32_t actor);

/// Where it is: takes its own frame to the world's.
std::optional<Eigen::Isometry3d> find_pose(const TickView& tick, std::uint32_t actor);

}  // namespace reprise::world
