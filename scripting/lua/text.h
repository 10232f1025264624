#pragma once

#include <string>
#include <string_view>

#include "world/printable.h"

struct lua_State;

namespace reprise::scripting {

/// A number as its shortest text that reads back as the same number: 12, 2.5, 45.0, 1e+300, nan.
/// Lua's own "%.14g" loses bits.
std::string number_text(double number);

/// Lua's tostring without addresses: a table is "table", a function "function". Uses __tostring.
std::string text_of(lua_State* L, int index);

/// For texts of scenarios that people will read: printed lines, names, messages.
using world::printable;

}  // namespace reprise::scripting
