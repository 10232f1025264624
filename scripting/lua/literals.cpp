#include "scripting/lua/literals.h"

#include <charconv>
#include <cmath>

#include <lua.hpp>

#include "scripting/lua/text.h"

namespace reprise::scripting {

namespace {

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) {
        if (c == '\\' || c == '\'')
            result += '\\';
        if (c == '\n')
            result += "\\n";
        else if (c == '\r')
            result += "\\r";
        else if (c == '\0')
            result += "\\0";
        else
            result += c;
    }
    return result + "'";
}

std::optional<std::string> unquoted(std::string_view text) {
    if (text.size() < 2 || text.front() != '\'' || text.back() != '\'')
        return std::nullopt;
    text = text.substr(1, text.size() - 2);
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\'')
            return std::nullopt;
        if (text[i] != '\\') {
            result += text[i];
            continue;
        }
        if (++i == text.size())
            return std::nullopt;
        const char c = text[i];
        result += c == 'n' ? '\n' : c == 'r' ? '\r' : c == '0' ? '\0' : c;
    }
    return result;
}

template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size())
        return std::nullopt;
    return number;
}

}  // namespace

std::string literal(const Value& value) {
    if (const bool* flag = std::get_if<bool>(&value))
        return *flag ? "true" : "false";
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        return std::to_string(*integer);
    if (const double* number = std::get_if<double>(&value))
        return number_text(*number);
    return quoted(std::get<std::string>(value));
}

std::optional<Value> parse_number(std::string_view text) {
    if (const auto integer = whole_number<std::int64_t>(text))
        return Value(*integer);
    const auto number = whole_number<double>(text);
    if (!number || !std::isfinite(*number))
        return std::nullopt;
    return Value(*number);
}

std::optional<Value> parse_literal(std::string_view text) {
    if (text == "true" || text == "false")
        return Value(text == "true");
    if (auto string = unquoted(text))
        return Value(std::move(*string));
    return parse_number(text);
}

const char* type_name(const Value& value) {
    constexpr const char* names[] = {"a boolean", "a number", "a number", "a string"};
    return names[value.index()];
}

void push(lua_State* L, const Value& value) {
    if (const bool* flag = std::get_if<bool>(&value))
        lua_pushboolean(L, *flag ? 1 : 0);
    else if (const auto* integer = std::get_if<std::int64_t>(&value))
        lua_pushinteger(L, *integer);
    else if (const double* number = std::get_if<double>(&value))
        lua_pushnumber(L, *number);
    else
        lua_pushlstring(
            L, std::get<std::string>(value).data(), std::get<std::string>(value).size());
}

std::optional<Value> to_value(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TBOOLEAN:
            return Value(lua_toboolean(L, index) != 0);
        case LUA_TNUMBER:
            if (lua_isinteger(L, index) != 0)
                return Value(std::int64_t{lua_tointeger(L, index)});
            return Value(lua_tonumber(L, index));
        case LUA_TSTRING:
            return Value(text_of(L, index));
        default:
            return std::nullopt;
    }
}

}  // namespace reprise::scripting
