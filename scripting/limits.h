#pragma once

struct lua_State;

namespace reprise::scripting {

/// Stock functions whose work the instruction count does not see: one call could take seconds.
/// These refuse what is too much, charge the budget, and call the stock function, which is
/// upvalue 1.

int repeat_text(lua_State* L);    ///< string.rep
int search_text(lua_State* L);    ///< string.find, match, gmatch, gsub
int move_elements(lua_State* L);  ///< table.move

}  // namespace reprise::scripting
