#pragma once

struct lua_State;

namespace reprise::scripting {

/// The functions of `table` that walk a list, without asking its metatable: a stock one calls
/// whatever `__len` and `__index` say, as often as they say, in one instruction. Charged by
/// element; numbers become text as `tostring` has it.

int insert_element(lua_State* L);
int remove_element(lua_State* L);
int join_elements(lua_State* L);  ///< table.concat
int unpack_elements(lua_State* L);
int move_elements(lua_State* L);

}  // namespace reprise::scripting
