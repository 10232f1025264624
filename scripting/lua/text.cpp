#include "scripting/lua/text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include <lua.hpp>

#include "world/check.h"

namespace reprise::scripting {

std::string number_text(double number) {
    if (std::isnan(number))
        return "nan";
    if (std::isinf(number))
        return number > 0 ? "inf" : "-inf";
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
    std::string text(buffer.data(), end);
    if (text.find_first_of(".e") == std::string::npos)
        text += ".0";  // as Lua writes floats that are whole
    return text;
}

std::string text_of(lua_State* L, int index) {
    switch (lua_type(L, index)) {
        case LUA_TNIL:
            return "nil";
        case LUA_TBOOLEAN:
            return lua_toboolean(L, index) != 0 ? "true" : "false";
        case LUA_TNUMBER:
            return lua_isinteger(L, index) != 0 ? std::to_string(lua_tointeger(L, index))
                                                : number_text(lua_tonumber(L, index));
        case LUA_TSTRING: {
            std::size_t size = 0;
            const char* text = lua_tolstring(L, index, &size);
            return {text, size};
        }
        default:
            break;
    }
    if (luaL_callmeta(L, index, "__tostring") == 0)
        return luaL_typename(L, index);
    if (lua_type(L, -1) != LUA_TSTRING)
        throw world::Error("'__tostring' must return a string");
    std::size_t size = 0;
    const char* text = lua_tolstring(L, -1, &size);
    std::string copy(text, size);
    lua_pop(L, 1);
    return copy;
}

namespace {

/// The bytes of a well-formed UTF-8 character at the start; 0 when it is none, or a control
/// character.
std::size_t shown_bytes(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto follows = [&](std::size_t i) { return (byte(i) & 0xc0U) == 0x80U; };
    const unsigned first = byte(0);
    if (first < 0x80)
        return (first >= 0x20 && first != 0x7f) || first == '\t' ? 1 : 0;
    if (first >= 0xc2 && first < 0xe0)
        return follows(1) && !(first == 0xc2 && byte(1) < 0xa0) ? 2 : 0;
    if ((first & 0xf0U) == 0xe0) {
        const bool overlong = first == 0xe0 && byte(1) < 0xa0;
        const bool surrogate = first == 0xed && byte(1) >= 0xa0;
        return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (first >= 0xf0 && first < 0xf5) {
        const bool overlong = first == 0xf0 && byte(1) < 0x90;
        const bool beyond = first == 0xf4 && byte(1) >= 0x90;
        return follows(1) && follows(2) && follows(3) && !overlong && !beyond ? 4 : 0;
    }
    return 0;
}

}  // namespace

std::string printable(std::string_view text) {
    constexpr const char* digits = "0123456789abcdef";
    std::string shown;
    while (!text.empty()) {
        const std::size_t size = shown_bytes(text);
        if (size != 0) {
            shown += text.substr(0, size);
        } else {
            const auto byte = static_cast<unsigned char>(text.front());
            shown += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
        }
        text.remove_prefix(size == 0 ? 1 : size);
    }
    return shown;
}

}  // namespace reprise::scripting
