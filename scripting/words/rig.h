#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scripting/lua/arguments.h"
#include "scripting/run/actors.h"

namespace reprise::scripting {

/// When an external driver is asked, and when it is heard.
struct Rhythm {
    std::uint8_t latency = 0;  ///< [ticks] later than at once
    std::uint8_t every = 1;    ///< [ticks] from one that it is shown to the next
};

/// What `rig = { ... }` of spawn{} says; nothing without one. `rhythm` of its driver, `step` [s]
/// of a tick. Refuses what no vehicle can carry, and frames that nobody would be shown.
std::vector<std::unique_ptr<world::SensorT>> read_rig(
    lua_State* L, const Fields& spawn, const Actor& actor, const Rhythm& rhythm, double step);

/// Whether `sees = 'sensors'` of spawn{} is there.
bool read_sees_sensors(const Fields& spawn, const Actor& actor);

}  // namespace reprise::scripting
