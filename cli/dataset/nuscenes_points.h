#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::cli {

/// nuScenes' LiDARs have x to the right and y ahead: takes their frame to ours.
Eigen::Isometry3d pose_sensor_nuscenes_lidar();

/// A .pcd.bin: x, y, z in that frame, intensity from 0 to 255, and the ring from the lowest, all of
/// them float32.
std::string nuscenes_sweep(const world::SensorFrame& frame, const world::SensorSpec& lidar);

/// A .pcd of the eighteen fields that nuScenes' radars have; x ahead, y left. `placed`: the radar
/// and who carries it.
std::string nuscenes_detections(const world::SensorFrame& frame,
                                const world::TickView& tick,
                                const world::SensorSpec& placed);

/// Places of such a file's points, in its own frame. Throws world::Error.
std::vector<Eigen::Vector3f> read_nuscenes_places(const std::filesystem::path& path);

/// How many beams of a semantic LiDAR met each actor, as JSON, and back.
std::string beam_text(const world::SensorFrame& semantic);
std::map<std::uint32_t, std::size_t> read_beams(const std::filesystem::path& path);

}  // namespace reprise::cli
