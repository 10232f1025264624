#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::world {

// What a rig may be. Scenarios are told so at their line; traces are held to it before anything is
// rendered.
inline constexpr std::size_t most_sensors = 16;                         ///< on a vehicle
inline constexpr int largest_picture_side = 4096;                       ///< [px]
inline constexpr std::size_t longest_sensor_name = 40;                  ///< [bytes]
inline constexpr double narrowest_view_deg = 1, widest_view_deg = 170;  ///< horizontal
inline constexpr double widest_fisheye_deg = 200;
inline constexpr double farthest_mount = 50;  ///< [m] from the vehicle's origin, along each axis
inline constexpr std::uint32_t longest_sensor_period = 100'000;  ///< [ticks]

/// The sensors that a vehicle carries, and when each of them looks.
struct Rig {
    SensorRig sensors;                 ///< in the scenario's order; `actor` is who carries them
    std::vector<std::uint32_t> every;  ///< [ticks] of each
    std::uint64_t since = 0;           ///< the tick in which the vehicle appeared

    /// Whether a sensor makes a frame of this tick. What happens does not wait for its period.
    bool is_due(std::size_t sensor, std::uint64_t tick) const {
        return tick >= since &&
               ((tick - since) % every[sensor] == 0 || tells_what_happens(sensors[sensor].kind));
    }

    /// How many frames a camera or a ranging sensor has made before this tick.
    std::uint64_t frames_before(std::size_t sensor, std::uint64_t tick) const {
        return (tick - since + every[sensor] - 1) / every[sensor];
    }

    /// The sensors that look in this tick, by their index.
    std::vector<std::size_t> due(std::uint64_t tick) const;
};

/// Of a spawn command in the tick with this index. Empty where nothing is carried. Throws Error for
/// a rig that no scenario could have said. `step`: [s] of a tick, for what sweeps.
Rig rig_of(const CommandT& spawn, std::uint64_t tick, double step = SensorSpec().step);
Rig rig_of(const Command& spawn, std::uint64_t tick, double step = SensorSpec().step);

/// Why what a sensor is told does not go together, in a line; empty where it does.
std::string contradiction(const SensorSpec& sensor);

/// Whether a camera's picture is of a while, and not of an instant.
bool takes_time(const SensorSpec& sensor);

/// Whether one of them says how things move, and so needs the ticks beside its own.
bool see_motion(const SensorRig& sensors);

/// Whether one of them looks at the tick before its own as well.
bool need_last(const SensorRig& sensors);

/// Fit to name a folder: letters, digits, '_' and '-'.
bool is_sensor_name(std::string_view name);

/// [bytes] of the pixels of one frame.
std::size_t picture_bytes(const SensorSpec& sensor);

/// The same of any sensor that sees, of one that is no camera at most. Readings, which are a few
/// numbers, have none.
std::size_t frame_bytes(const SensorSpec& sensor);

}  // namespace reprise::world
