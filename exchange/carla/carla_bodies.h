#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "exchange/carla/carla_survey.h"

namespace reprise::exchange {

/// [m/s] Nothing drives faster; who does was moved by hand.
inline constexpr double fastest = 120;

/// An actor at a moment, in the town's frame: its origin is where a CarState or WalkerState has it.
struct Body {
    std::uint32_t id = 0;
    Eigen::Vector3d position;                 ///< [m]
    double yaw = 0;                           ///< [rad] counter-clockwise from east
    double pitch = 0;                         ///< [rad] nose up
    std::uint16_t lamps = 0;                  ///< world::Lamp bits
    std::optional<Eigen::Vector3d> velocity;  ///< [m/s] world
};

/// Everybody at one frame.
struct Instant {
    double elapsed = 0;        ///< [s]
    std::vector<Body> bodies;  ///< sorted by id; their velocities are those recorded, if any
};

/// The way that x points in.
Eigen::Vector3d ahead_of(double yaw, double pitch);

/// One pose. `offset` [m] takes CARLA's origin to the town's; the actor must have a role.
Body body_of(const CarlaPose& pose, const CarlaSurvey& survey, const Eigen::Vector3d& offset);

/// All poses of a frame whose actors have a role.
Instant instant_of(const CarlaFrame& frame,
                   const CarlaSurvey& survey,
                   const Eigen::Vector3d& offset);

/// Is one of the two not where the other could have gone in this time [s]?
bool jumps_between(const Body& from, const Body& to, double duration);

/// At `share` of the way: the place on the straight line, angles the short way round. Who jumps
/// stays. `duration` [s] is the time between the two.
Body between(const Body& from, const Body& to, double share, double duration);

}  // namespace reprise::exchange
