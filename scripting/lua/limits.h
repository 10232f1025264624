#pragma once

struct lua_State;

namespace reprise::scripting {

/// Stock functions whose work the instruction count does not see. Upvalue 1 is the stock one.

/// Charges the bytes of all texts among the arguments from number `first` on, and the results; then
/// calls the stock function. Functions that it returns become closures, as `add_closure` says.
template <int first>
int metered(lua_State* L);

int repeat_text(lua_State* L);  ///< string.rep

/// Sets a function as a field of the table at the top of the stack. A closure, never Lua's light
/// function: as a key of a table that would hash by its address, which differs in every process.
void add_closure(lua_State* L, const char* name, int (*function)(lua_State*));

}  // namespace reprise::scripting
