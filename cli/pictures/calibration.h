#pragma once

#include <filesystem>
#include <string>

#include "world/external/sensor.h"

namespace reprise::cli {

/// Writes what a camera is and how it is mounted beside its pictures: camera.json, and calib.txt as
/// KITTI's devkit reads it (P2 and Tr_velo_to_cam, from the carrier's frame). `carrier`: whose
/// frame the place is in, "world" for the world's.
void write_calibration(const std::filesystem::path& folder,
                       const world::SensorSpec& sensor,
                       const std::string& carrier);

/// calib.txt alone. `velodyne`: the LiDAR whose points go with it, on the same carrier; without one
/// its frame is the carrier's, which is the IMU's as well.
std::string kitti_calibration(const world::SensorSpec& sensor,
                              const world::SensorSpec* velodyne = nullptr);

}  // namespace reprise::cli
