// Private to the room: points, beams and who is met, as nuScenes has them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "render/labels/boxes.h"
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

/// An actor by its id; from `first_thing` on a vehicle that stands in the town, by its number
/// there.
using Who = std::uint32_t;
constexpr Who first_thing = 1U << 31U;

/// Of a JSON object with "actor" or "thing". Throws nlohmann's exceptions.
Who who(const nlohmann::ordered_json& one);

/// How many beams of a semantic LiDAR met each actor, and each vehicle of the town, as JSON, and
/// back. `frame`: in the sensor's frame at the tick. `placed`: the LiDAR and who carries it.
std::string beam_text(const world::SensorFrame& frame,
                      const world::TickView& tick,
                      const world::SensorSpec& placed,
                      std::span<const render::ParkedVehicle> parked);
std::map<Who, std::size_t> read_beams(const std::filesystem::path& path);

}  // namespace reprise::cli
