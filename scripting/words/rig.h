#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scripting/lua/arguments.h"
#include "scripting/run/actors.h"

namespace reprise::scripting {

/// What `rig = { ... }` of spawn{} says; nothing without one. `latency` [ticks] of its driver,
/// `step` [s] of a tick. Refuses what no vehicle can carry.
std::vector<std::unique_ptr<world::SensorT>> read_rig(
    lua_State* L, const Fields& spawn, const Actor& actor, std::uint8_t latency, double step);

/// Whether `sees = 'sensors'` of spawn{} is there.
bool read_sees_sensors(const Fields& spawn, const Actor& actor);

}  // namespace reprise::scripting
