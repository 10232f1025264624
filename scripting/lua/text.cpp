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

}  // namespace reprise::scripting
