#pragma once

#include <string>

#include "remote/wire_generated.h"
#include "scripting/scenario.h"
#include "world/town_generated.h"

namespace reprise::cli {

/// A scenario made of what a client asked for.
struct TaskScenario {
    std::string source;  ///< Lua
    scripting::Overrides overrides;
};

/// A goal-directed task as in Dosovitskiy et al., "CARLA: An Open Urban Driving Simulator", CoRL
/// 2017: from a place to a goal, in the time that the way takes at 10 km/h. Without a goal the
/// episode goes on until its limit. Throws world::Error for what is not in the town.
TaskScenario scenario_of(const remote::Task& task, const world::TownT& town);

}  // namespace reprise::cli
