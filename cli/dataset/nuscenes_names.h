#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "world/external/sensor.h"
#include "world/models/catalogue.h"
#include "world/tick.h"

namespace reprise::cli {

/// What nuScenes calls things. A name and what it means, in a row of its table.
struct NuscenesName {
    const char* name;
    const char* description;
};

std::span<const NuscenesName> nuscenes_categories();
std::span<const NuscenesName> nuscenes_attributes();

/// By their tokens "1" to "4".
std::span<const NuscenesName> nuscenes_visibilities();

/// "CAM_FRONT" of a camera 'front', "RADAR_NOSE"; `first_lidar`: LIDAR_TOP, which the devkit looks
/// for, unless it has such a name already.
std::string nuscenes_channel(const world::SensorSpec& sensor, bool first_lidar);

/// Index in nuscenes_categories(); nothing for what nuScenes has no category for.
std::optional<std::size_t> nuscenes_category(const world::TickView& tick, std::uint32_t actor);

/// Of a vehicle that stands in the town.
std::size_t nuscenes_category(const world::VehicleModel& parked);
std::optional<std::size_t> nuscenes_attribute(const world::VehicleModel& parked);

/// Index in nuscenes_attributes(); nothing for things. `parked`: nobody ever moves it.
std::optional<std::size_t> nuscenes_attribute(const world::TickView& tick,
                                              std::uint32_t actor,
                                              bool parked);

/// Of the share of an actor that cameras see, in [0, 1]: "1" to "4".
std::string nuscenes_visibility(double share);

}  // namespace reprise::cli
