#pragma once

#include <Eigen/Geometry>

#include "world/models/catalogue.h"
#include "world/town.h"

namespace reprise::kernel {

/// Shares of a vehicle's footprint, in [0, 1].
struct FootprintShares {
    double opposite_lane = 0;  ///< over lanes for cars that run against it, and none that runs with
    double sidewalk = 0;  ///< over sidewalks, crossings and walking areas, and no lane for cars
};

/// What of the rectangle that a vehicle covers lies over what: lanes' surfaces are clipped with it,
/// on whole millimetres (ground::Area). Inside junctions lanes overlap: where any of them runs with
/// the vehicle, it is no opposite lane. A vehicle whose four corners and middle are where they
/// belong is not clipped: nearly all, nearly always. Else about 50 us.
FootprintShares footprint_shares(const world::TownT& town,
                                 const world::LaneMap& lanes,
                                 const world::VehicleModel& model,
                                 const Eigen::Isometry3d& pose_world_vehicle);

}  // namespace reprise::kernel
