#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "world/external/sensor.h"

namespace reprise::exchange {

/// What one sensor left in a folder of `reprise render`, by tick.
struct RenderedSensor {
    std::string topic;
    std::map<std::uint64_t, std::filesystem::path> files;

    /// Of points: where they were measured, as the folder's manifest says, and who carried the
    /// sensor: "world", an actor's name or id, or "the first vehicle".
    world::SensorSpec place;
    std::string mounted_on;
};

struct RenderedFolder {
    std::vector<RenderedSensor> cameras;  ///< .png, by topic
    std::vector<RenderedSensor> points;   ///< .ply, .pcd and .bin, by topic
};

/// Of the folder itself and its sub-folders: rgb, depth, roof. Throws world::Error when there is
/// nothing in it, or points without a manifest.
RenderedFolder rendered_folder(const std::filesystem::path& folder);

}  // namespace reprise::exchange
