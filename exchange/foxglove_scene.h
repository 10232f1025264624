// Private to the room: the world as Foxglove's scene entities.
#pragma once

#include <map>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include "exchange/point_cloud.h"
#include "world/tick.h"
#include "world/town_generated.h"

namespace reprise::exchange {

using Names = std::map<std::uint32_t, std::string>;  ///< of actors

/// {"sec":..., "nsec":...}
nlohmann::json timestamp(std::uint64_t tick, std::uint64_t step_ns);

/// All that does not move, as a SceneUpdate.
nlohmann::json town_scene(const world::TownT& town, const nlohmann::json& time);

/// All that does. The message says all there is to say: a viewer that jumps shows the right thing.
nlohmann::json actors_scene(const world::TickView& tick,
                            const world::TownT& town,
                            const Names& names,
                            const nlohmann::json& time);

/// FrameTransforms from "world" to a frame for each vehicle with mass.
nlohmann::json transforms(const world::TickView& tick,
                          const Names& names,
                          const nlohmann::json& time);

/// Points in the frame of a sensor, as a PointCloud in the world's.
nlohmann::json point_cloud(const PointCloud& cloud,
                           const Eigen::Isometry3d& pose_world_sensor,
                           const nlohmann::json& time);

/// "ego", or "vehicle 7".
std::string frame_name(std::uint32_t id, const Names& names);

}  // namespace reprise::exchange
