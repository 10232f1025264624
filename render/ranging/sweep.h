#pragma once

#include <cstdint>
#include <vector>

#include "world/external/sensor.h"

namespace reprise::render {

/// Where a spinning LiDAR looks in the time that a frame covers: columns of one instant and one
/// azimuth each, in the order of time, and the elevation of each channel, the uppermost first.
/// Columns are numbered from the start of the run, so that frames follow on each other without a
/// gap and one can be made alone.
struct Sweep {
    struct Column {
        std::uint64_t number = 0;
        double azimuth = 0;  ///< [rad] left positive; LiDARs turn clockwise: it falls
        double ago = 0;      ///< [s] before the tick
    };

    std::vector<Column> columns;
    std::vector<double> elevations;  ///< [rad] up positive
};

/// Of a lidar or semantic_lidar. A frame covers the ticks since the last one, one turn at most.
Sweep sweep_of(const world::SensorSpec& spec, std::uint64_t tick);

}  // namespace reprise::render
