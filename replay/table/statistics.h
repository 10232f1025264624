#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "replay/trace_reader.h"

namespace reprise::replay {

/// Standing is slower than this. [m/s]
inline constexpr double standing_speed = 0.1;

/// A hard brake begins with this deceleration and ends below half of it. [m/s^2] About what makes
/// passengers complain; an emergency stop has 8.
inline constexpr double hard_brake = 4;

/// What a vehicle with mass did. Times are numbers of ticks.
struct VehicleStatistics {
    std::uint32_t id = 0;
    std::string name;  ///< as the scenario spawned it; "" when that is not in the trace
    std::string model;
    std::uint64_t ticks = 0;
    double distance = 0;    ///< [m] by the odometer
    double mean_speed = 0;  ///< [m/s]
    double max_speed = 0;
    std::uint64_t standing = 0;
    std::uint64_t hard_brakes = 0;
    double max_deceleration = 0;  ///< [m/s^2]
    std::uint64_t collisions = 0;
    double impulse = 0;  ///< [N s] of all contacts
    std::uint64_t on_opposite_lane = 0;
    std::uint64_t on_sidewalk = 0;
    double least_gap = std::numeric_limits<double>::infinity();  ///< [m] ahead, while driving
};

struct CountRange {
    std::size_t least = 0;
    std::size_t most = 0;
    double mean = 0;
};

struct TraceStatistics {
    std::uint64_t ticks = 0;
    std::vector<VehicleStatistics> vehicles;  ///< by id
    std::uint64_t traffic_ticks = 0;  ///< those in which the trace has it: the next two are of them
    CountRange cars;
    CountRange walkers;
    std::uint64_t events = 0;
    std::uint64_t commands = 0;
    std::uint64_t collisions = 0;
    std::uint64_t tick_bytes = 0;  ///< of the channels, before compression
    std::uint64_t traffic_bytes = 0;
};

/// Reads the ticks from first to last (default: all) once, and names from those before. Throws
/// world::Error for a trace of level inputs, which has no states.
TraceStatistics statistics(TraceReader& trace,
                           std::optional<std::uint64_t> first = {},
                           std::optional<std::uint64_t> last = {});

}  // namespace reprise::replay
