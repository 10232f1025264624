#pragma once

#include <cstdint>
#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "cli/dataset/dataset_layout.h"
#include "cli/dataset/dataset_source.h"
#include "cli/dataset/frame_list.h"

namespace reprise::cli {

/// An actor that cameras or the first LiDAR see, or a vehicle that stands in the town.
struct NuscenesObject {
    std::uint32_t actor = 0;               ///< from 2^31 on: things of the town, by their number
    std::size_t category = 0;              ///< in nuscenes_categories()
    std::optional<std::size_t> attribute;  ///< in nuscenes_attributes()
    double share = 0;                      ///< of it that cameras see
    Eigen::Isometry3d pose_world;          ///< of the middle of its box
    Eigen::Vector3d size;                  ///< [m] along it, across, upwards
};

/// What they see between two samples.
struct NuscenesSweep {
    std::uint64_t before = 0;  ///< [ticks] the later sample
    Eigen::Isometry3d pose_world_ego;
};

/// A sample: what the sensors see at a tick.
struct NuscenesFrame {
    std::size_t trace = 0;  ///< by its index
    std::uint64_t tick = 0;
    std::string split;
    Eigen::Isometry3d pose_world_ego;
    std::vector<NuscenesObject> objects;  ///< by actor
    std::vector<NuscenesSweep> sweeps;    ///< since the last sample, by time
};

/// Of all frames, from the traces and from what labels/ holds: the same under every weather.
std::vector<NuscenesFrame> nuscenes_frames(const DatasetLayout& layout,
                                           const std::list<DatasetSource>& sources,
                                           const std::vector<DatasetFrame>& frames);

}  // namespace reprise::cli
