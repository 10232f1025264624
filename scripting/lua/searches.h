#pragma once

struct lua_State;

namespace reprise::scripting {

/// string.find, match, gmatch and gsub over Pattern: every step of a match is charged.
int find_text(lua_State* L);
int match_text(lua_State* L);
int match_all(lua_State* L);
int replace_text(lua_State* L);

}  // namespace reprise::scripting
