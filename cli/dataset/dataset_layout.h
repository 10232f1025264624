#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "world/external/sensor.h"

namespace reprise::cli {

/// Where the files of a data set lie: see docs/datasets.md. Under each weather pictures of rgb
/// alone; all else is the same under all weathers and lies in labels/, once.
class DatasetLayout {
  public:
    /// `cameras`: by their order; of those of kind rgb KITTI has numbers, from 2.
    DatasetLayout(std::filesystem::path root, bool coco, world::SensorRig cameras);

    std::filesystem::path picture(std::size_t camera,
                                  const std::string& weather,
                                  std::size_t id) const;
    std::filesystem::path boxes(std::size_t camera, std::size_t id) const;

    /// A label of KITTI's, or what COCO says of one picture.
    std::filesystem::path label(std::size_t camera, std::size_t id) const;
    std::filesystem::path calibration(std::size_t camera, std::size_t id) const;

    bool is_rgb(std::size_t camera) const;

    /// As COCO's "file_name": below images/WEATHER.
    std::string file_name(std::size_t camera, std::size_t id) const;

    /// Folders of all that, and what makes each weather's folder a KITTI of its own: links.
    std::vector<std::filesystem::path> folders(const std::vector<std::string>& weathers) const;
    void link(const std::vector<std::string>& weathers) const;

    /// A weather as a folder's name.
    static std::string folder_of(const std::string& weather);

  private:
    std::string numbered(const char* name, std::size_t camera) const;

    std::filesystem::path root_;
    bool coco_;
    world::SensorRig cameras_;
};

}  // namespace reprise::cli
