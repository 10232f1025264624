#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "world/tick.h"

namespace reprise::replay {

/// What a drive can do wrong: docs/scoring.md says when.
enum class InfractionKind : std::uint8_t {
    collision_vehicle,
    collision_pedestrian,
    collision_static,
    opposite_lane,
    sidewalk,
    red_light,
    stop_sign,
    speeding,
    wrong_way,
    off_road,
    blocked
};

inline constexpr std::size_t infraction_kinds = 11;

/// All of them, in the order in which they are told.
std::array<InfractionKind, infraction_kinds> all_infractions();

/// "collision_vehicle"
const char* name_of(InfractionKind kind);

/// "collisions: vehicle"
const char* title_of(InfractionKind kind);

/// Once, from its first tick to its last.
struct Infraction {
    InfractionKind kind = InfractionKind::collision_vehicle;
    std::uint32_t actor = 0;
    std::uint64_t first = 0;  ///< tick
    std::uint64_t last = 0;   ///< tick

    /// Collision: impulse [N s]; opposite lane, sidewalk: share of the footprint; red light, stop
    /// sign: speed at the line [m/s]; speeding: above the limit [m/s]; wrong way, off road: driven
    /// [m]; blocked: stood [s].
    double worst = 0;

    std::uint32_t lane = world::none;   ///< in Town.lanes, at its first tick
    Eigen::Vector3d position{0, 0, 0};  ///< world, of the vehicle, at its first tick
    std::uint32_t other = 0;            ///< of a collision; 0: none, or something fixed

    bool operator==(const Infraction&) const = default;
};

/// A violation lasts at most 2 s: ten seconds on the sidewalk count five (Dosovitskiy et al.,
/// "CARLA: An Open Urban Driving Simulator", CoRL 2017). What happens in one instant counts once:
/// a red light, a stop sign, and being blocked.
std::uint64_t count_of(const Infraction& infraction, std::uint64_t step_ns);

}  // namespace reprise::replay
