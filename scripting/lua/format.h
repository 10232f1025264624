#pragma once

struct lua_State;

namespace reprise::scripting {

/// string.format without %p; %s goes through text_of. Upvalue 1: Lua's own string.format.
int format_text(lua_State* L);

}  // namespace reprise::scripting
