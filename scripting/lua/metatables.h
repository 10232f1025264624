#pragma once

struct lua_State;

namespace reprise::scripting {

/// A metatable is read when it is set: what the script changes in it later has no effect, so that
/// '__mode' cannot slip in. No finalizers and no weak references, which act when memory is
/// collected; chains of __index and __newindex are short, because one instruction walks all of it.
int set_metatable(lua_State* L);

/// The table that was given to setmetatable; for texts and actors nothing.
int get_metatable(lua_State* L);

}  // namespace reprise::scripting
