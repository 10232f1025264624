#pragma once

#include <optional>
#include <vector>

#include "world/external/point_fields.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::render {

/// A place on the globe, WGS 84.
struct GlobePlace {
    double latitude_deg = 0;
    double longitude_deg = 0;
};

/// Where x, y [m] east and north of an origin lie on the globe, for towns that lie nowhere: along
/// the ellipsoid's radii of curvature there. Within a centimetre over 10 km of a plane that
/// touches it.
GlobePlace place_on_globe(const GlobePlace& origin, double east, double north);

// Each throws world::Error when the sensor's actor is not there. All are functions of what they
// are given: noise comes from the sensor's seed, name and the tick.

/// Where the sensor is, in the world's frame: what a GNSS is asked about. [m]
Eigen::Vector3d antenna_place(const world::TickView& tick, const world::SensorSpec& spec);

/// `place`: of the antenna without error; `height` [m] of it in the world.
world::Reading gnss_reading(std::uint64_t tick,
                            const world::SensorSpec& spec,
                            const GlobePlace& place,
                            double height);

/// What accelerometers and gyroscopes feel in the sensor's own frame, and its compass. Mean
/// acceleration over the tick, as it is recorded, and where the sensor is not in the vehicle's
/// origin what turning adds there; `last`: the tick before, for how turning changes and for cars
/// without mass; none: as if that did not change.
world::Reading imu_reading(const world::TickView* last,
                           const world::TickView& tick,
                           const world::SensorSpec& spec);

/// Collisions of the carrier that began or ended in this tick, in the order of its events.
std::vector<world::Reading> collision_readings(const world::TickView& tick,
                                               const world::SensorSpec& spec);

/// Borders of lanes that a corner of the carrier's footprint crossed from the last tick to this
/// one, each once, sorted. Where there is a border there is paint, or a kerb at edges; on junctions
/// there is none.
std::vector<world::Reading> lane_invasion_readings(const world::TickView& last,
                                                   const world::TickView& tick,
                                                   const world::SensorSpec& spec,
                                                   const world::TownT& town,
                                                   const world::LaneMap& lanes);

}  // namespace reprise::render
