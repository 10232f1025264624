#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "world/external/sensor.h"

namespace reprise::world {

/// A column of what a sensor measures that is no camera.
struct PointField {
    std::string_view name;
    bool whole = false;        ///< a whole number without sign, else a real one
    std::string_view meaning;  ///< with its unit
};

/// Frames of ranging sensors are of PixelType::f32, one row for each point: their width is 1 and
/// their height the number of points; whole numbers lie in the 32 bits as they are. Readings are
/// rows of double.
///   lidar, semantic_lidar   in the order of time, then of channels from the top; coordinates in
///   the
///                           sensor's frame at the instant of the shot
///   radar                   detections, the strongest first
///   obstacle                one row, or none
std::span<const PointField> point_fields(SensorKind kind);

/// What a reading says, at a tick: columns as point_fields tells.
using Reading = std::vector<double>;

/// [bytes] of one row, of a sensor that is no camera.
std::size_t row_bytes(SensorKind kind);

/// How many rows a frame of a ranging sensor has at most.
std::size_t most_rows(const SensorSpec& sensor);

}  // namespace reprise::world
