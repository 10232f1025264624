// Private to the room: what nuScenes' tables are made of, and their tokens.
#pragma once

#include <cstdint>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "cli/dataset/dataset_layout.h"
#include "cli/dataset/dataset_source.h"
#include "cli/dataset/nuscenes_frames.h"
#include "cli/dataset/nuscenes_map.h"
#include "world/digest.h"

namespace reprise::cli {

/// A sensor of the rig as nuScenes has it.
struct NuscenesChannel {
    std::string name;
    std::string modality;
    bool camera = false;
    std::size_t number = 0;  ///< among cameras, or among rays
    Eigen::Isometry3d pose_ego;
    Eigen::Matrix3d intrinsic = Eigen::Matrix3d::Zero();  ///< of a camera
};

/// One of each for a trace.
struct NuscenesLog {
    std::string chain;
    std::string scenario;
    std::string town;
    std::uint64_t seed = 0;
    std::uint64_t step_ns = 0;
    std::string weather;  ///< as it was recorded
    Eigen::Vector3d origin;
};

/// Everything that tables are made of but points, which differ from weather to weather.
struct NuscenesContent {
    NuscenesContent(const DatasetLayout& dataset,
                    const std::list<DatasetSource>& sources,
                    const std::vector<DatasetFrame>& dataset_frames);

    const DatasetLayout& layout;
    std::vector<NuscenesChannel> channels;
    std::vector<NuscenesMap> maps;
    std::vector<NuscenesLog> logs;
    std::vector<NuscenesFrame> frames;

    /// Of each frame: a scene for each run of frames of one trace and one part.
    std::vector<std::size_t> scene_of;
    std::vector<std::size_t> scenes;  ///< the first frame of each

    /// Of all frames: the sweeps since the last one, then itself. By time in each scene.
    std::vector<Moment> moments;

    /// [us] Logs have days of their own, so that what is sorted by time stays in its log.
    std::uint64_t time(const Moment& moment) const;

    /// Of who carries the sensors.
    const Eigen::Isometry3d& pose_world_ego(const Moment& moment) const;

    // Tokens.
    std::string sample(std::size_t id) const;
    std::string scene(std::size_t number) const;
    std::string data(const Moment& moment, const NuscenesChannel& channel) const;
    std::string annotation(std::size_t id, std::uint32_t actor) const;
    std::string instance(std::size_t scene, std::uint32_t actor) const;
    std::string log(std::size_t trace) const;
    std::string calibration(std::size_t trace, const NuscenesChannel& channel) const;

    /// In the frame of the map.
    Eigen::Vector3d place(std::size_t id, const Eigen::Isometry3d& pose_world) const;

    /// The frame beside one in its scene.
    std::optional<std::size_t> beside(std::size_t id, bool next) const;

    /// The moment beside the one with that number in its scene.
    std::optional<Moment> beside_moment(std::size_t number, bool next) const;
};

/// 32 hexadecimal digits that these words say.
template <typename... Words>
std::string nuscenes_token(const Words&... words) {
    std::string text;
    ((text += fmt::format("{}/", words)), ...);
    return world::to_hex(world::digest128(text));
}

}  // namespace reprise::cli
