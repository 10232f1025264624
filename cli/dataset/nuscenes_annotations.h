// Private to the room: nuScenes' annotations.
#pragma once

#include <map>
#include <string>

#include <nlohmann/json.hpp>

#include "cli/dataset/nuscenes_content.h"

namespace reprise::cli {

/// By their names, rows of JSON.
using NuscenesTables = std::map<std::string, nlohmann::ordered_json>;

/// As nuScenes says them: w, x, y, z of a rotation.
nlohmann::ordered_json json_of(const Eigen::Vector3d& v);
nlohmann::ordered_json json_of(const Eigen::Matrix3d& rotation);

/// Adds sample_annotation and instance; `tables` has categories and attributes. Points are counted
/// as they were measured under that weather.
void add_annotations(const NuscenesContent& content,
                     const std::string& weather,
                     NuscenesTables& tables);

}  // namespace reprise::cli
