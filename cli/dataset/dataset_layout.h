#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/dataset/frame_list.h"
#include "cli/pictures/written_files.h"
#include "world/external/sensor.h"

namespace reprise::cli {

enum class DatasetFormat : std::uint8_t { kitti, coco, nuscenes };

/// Where the files of a data set lie: see docs/datasets.md. Under each weather there is what the
/// weather changes, pictures of rgb and points of LiDARs and radars; all else is the same under all
/// weathers and lies in labels/, once.
class DatasetLayout {
  public:
    /// `cameras`: by their order; of those of kind rgb KITTI has numbers, from 2. `rays`: what
    /// measures by rays. `sweeps`: there are some, which only nuScenes has room for.
    DatasetLayout(std::filesystem::path root,
                  DatasetFormat format,
                  world::SensorRig cameras,
                  world::SensorRig rays,
                  bool sweeps = false);

    DatasetFormat format() const { return format_; }

    const std::filesystem::path& root() const { return root_; }

    const world::SensorRig& cameras() const { return cameras_; }

    const world::SensorRig& rays() const { return rays_; }

    std::filesystem::path picture(std::size_t camera,
                                  const std::string& weather,
                                  const Moment& moment) const;
    std::filesystem::path boxes(std::size_t camera, std::size_t id) const;

    /// A label of KITTI's, or what COCO says of one picture; nuScenes' tables are made of boxes.
    std::filesystem::path label(std::size_t camera, std::size_t id) const;
    std::filesystem::path calibration(std::size_t camera, std::size_t id) const;

    /// Of rays.
    std::filesystem::path points(std::size_t sensor,
                                 const std::string& weather,
                                 const Moment& moment) const;

    /// How many beams of the first LiDAR meet each actor.
    std::filesystem::path beams(std::size_t id) const;

    /// nuScenes' tables of a weather, masks of its maps, and its names of sensors.
    std::filesystem::path tables(const std::string& weather) const;
    std::filesystem::path maps() const;
    std::string camera_channel(std::size_t camera) const;
    std::string ray_channel(std::size_t sensor) const;

    bool is_rgb(std::size_t camera) const;

    /// Whether a weather changes what it measures.
    bool is_weathered(std::size_t sensor) const;

    /// The LiDAR whose points are KITTI's velodyne and nuScenes' LIDAR_TOP: the first.
    std::optional<std::size_t> velodyne() const;

    /// As COCO's "file_name": below images/WEATHER.
    std::string file_name(std::size_t camera, std::size_t id) const;

    /// Of all that.
    std::vector<std::filesystem::path> folders(const std::vector<std::string>& weathers) const;

    /// All that lies in those folders.
    std::vector<WrittenFile> files(const std::vector<std::string>& weathers) const;

    /// Makes each weather's folder a KITTI, or a nuScenes, of its own.
    void link(const std::vector<std::string>& weathers) const;

    /// A weather as a folder's name.
    static std::string folder_of(const std::string& weather);

  private:
    std::string numbered(const char* name, std::size_t camera) const;
    std::filesystem::path of_channel(const std::string& weather,
                                     const std::string& channel,
                                     const Moment& moment,
                                     const char* ending) const;

    std::filesystem::path root_;
    DatasetFormat format_;
    world::SensorRig cameras_;
    world::SensorRig rays_;
    bool sweeps_;
};

}  // namespace reprise::cli
