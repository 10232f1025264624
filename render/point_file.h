#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "world/external/point_fields.h"

namespace reprise::render {

/// How points are written.
enum class PointFormat : std::uint8_t {
    ply,  ///< binary, little endian; a property for each column
    pcd,  ///< version 0.7, binary
    bin,  ///< KITTI's: x, y, z and intensity as float32, nothing else
    npy   ///< NumPy's: a row for each point, columns of point_fields; float32, with ids float64
};

/// Writes a frame of a ranging sensor. In ply, pcd and bin a radar's detections have x, y and z [m]
/// before their columns; bin's fourth number is a lidar's intensity, a semantic_lidar's cosine, a
/// radar's rcs. Throws world::Error when it cannot be written.
void write_points(const world::SensorFrame& frame,
                  const std::filesystem::path& path,
                  PointFormat format);

/// The bytes of such a file.
std::string point_file(const world::SensorFrame& frame, PointFormat format);

/// The bytes of a .npy file: rows of `columns` numbers each, one behind the other.
std::string npy_file(std::span<const float> values, std::size_t columns);
std::string npy_file(std::span<const double> values, std::size_t columns);

}  // namespace reprise::render
