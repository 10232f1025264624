#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "exchange/carla/carla_log.h"

namespace reprise::exchange {

/// A vehicle or walker of a log, all that does not change.
struct CarlaRole {
    CarlaActor actor;
    std::uint16_t model = 0;  ///< of ours
    std::string guessed_by;   ///< as of a CarlaModel
    double ahead = 0;         ///< [m] from CARLA's origin of it to ours: below a car's rear axle
    double above = 0;         ///< [m] of its origin over the ground
};

/// What is in a log: found by reading it once, before its ticks are made.
struct CarlaSurvey {
    std::uint64_t frames = 0;
    double first = 0;  ///< [s] elapsed at the first frame
    double last = 0;   ///< likewise, at the last whole one
    std::map<std::uint32_t, CarlaRole> roles;
    std::map<std::uint32_t, Eigen::Vector3d> lights;  ///< [m], our axes: where one waits for it
    bool lights_have_triggers = false;                ///< else these are the places of the poles
    std::optional<std::uint32_t> hero;                ///< role_name hero, or the first vehicle
    Eigen::Vector3d low;  ///< [m], our axes; bounding box of the ground under all actors
    Eigen::Vector3d high;
    double height = 0;  ///< [m] of that ground: the median over frames and vehicles
};

/// CARLA's left-handed centimetres to our metres: x stays, y is turned round.
Eigen::Vector3d from_carla(const Eigen::Vector3d& location_cm);

/// Reads all frames; `progress` hears of bytes. Throws world::Error when there is nothing in them
/// to import. Afterwards `log` is where it ends or is damaged.
CarlaSurvey survey(CarlaLog& log, const std::function<void(std::uint64_t)>& progress);

}  // namespace reprise::exchange
