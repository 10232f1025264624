#pragma once

#include "scripting/run/run.h"

struct lua_State;

namespace reprise::scripting {

/// The actor whose handle is the first argument, or refuses where nobody is there to obey.
Actor& driven(Run& run, lua_State* L, const char* who);

/// Likewise, and no walker.
Actor& driver_of_car(Run& run, lua_State* L, const char* who);

/// Refuses for whom `may_overtake` would do nothing.
void want_overtaker(const char* who, const Actor& actor);

}  // namespace reprise::scripting
