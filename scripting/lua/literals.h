#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

struct lua_State;

namespace reprise::scripting {

/// What a parameter can be.
using Value = std::variant<bool, std::int64_t, double, std::string>;

/// As Lua literal: true, 12, 2.5, 'clear_noon'. Equal values give equal text.
std::string literal(const Value& value);

/// Reads a literal back. None when it is not one.
std::optional<Value> parse_literal(std::string_view text);

/// A number in decimal: 12, -2.5, 1e3. None when the text is not one, or not finite.
std::optional<Value> parse_number(std::string_view text);

/// "a number", "a string", "a boolean".
const char* type_name(const Value& value);

void push(lua_State* L, const Value& value);

/// None for nil, tables and functions.
std::optional<Value> to_value(lua_State* L, int index);

}  // namespace reprise::scripting
