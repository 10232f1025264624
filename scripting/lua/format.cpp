#include "scripting/lua/format.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <lua.hpp>

#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"
#include "world/check.h"
#include "world/story/wording.h"

namespace reprise::scripting {

namespace {

constexpr std::uint64_t format_cost = 20;       // [instructions]
constexpr std::uint64_t conversion_cost = 100;  // [instructions] of "%.99f", which takes longest

/// Would C write "-0.0" for it? A standing car drives 0.0 km/h.
bool is_signed_zero(lua_State* L, int argument, char conversion, std::string_view spec) {
    if (argument > lua_gettop(L) || lua_type(L, argument) != LUA_TNUMBER ||
        lua_isinteger(L, argument) != 0)
        return false;
    const double value = lua_tonumber(L, argument);
    if (!std::signbit(value) || (conversion != 'f' && conversion != 'g' && conversion != 'e'))
        return false;
    if (value == 0)
        return true;
    if (conversion != 'f' || value < -0.5)
        return false;
    const std::size_t dot = spec.find('.');
    int decimals = 6;
    if (dot != std::string_view::npos) {
        decimals = 0;
        for (const char digit : spec.substr(dot + 1))
            decimals = std::min(10 * decimals + (digit - '0'), 100);
    }
    return world::with_decimals(value, decimals).find_first_not_of("0.") == std::string::npos;
}

}  // namespace

int format_text(lua_State* L) {
    std::size_t size = 0;
    const char* raw = lua_tolstring(L, 1, &size);
    if (raw == nullptr)
        throw world::Error("string.format: the format must be a string");
    const std::string_view format(raw, size);
    std::uint64_t cost = format_cost + size / 8;
    int argument = 1;
    for (std::size_t i = 0; i < format.size(); ++i) {
        if (format[i] != '%')
            continue;
        if (i + 1 < format.size() && format[i + 1] == '%') {
            ++i;
            continue;
        }
        ++argument;
        const std::size_t spec = i + 1;
        i = format.find_first_not_of("-+ #0123456789.", spec);
        if (i == std::string_view::npos)
            break;
        if (format[i] == 'p')
            throw world::Error(
                "string.format: %p would show an address, which differs in every run");
        cost += conversion_cost;
        if (is_signed_zero(L, argument, format[i], format.substr(spec, i - spec))) {
            lua_pushnumber(L, 0);
            lua_replace(L, argument);
        }
        // %q writes each byte by itself.
        if (lua_type(L, argument) == LUA_TSTRING)
            cost += lua_rawlen(L, argument) / (format[i] == 'q' ? 1 : 4);
        const bool is_text = format[i] == 's';
        if (is_text && argument <= lua_gettop(L) && lua_type(L, argument) != LUA_TSTRING) {
            const std::string text = text_of(L, argument);
            lua_pushlstring(L, text.data(), text.size());
            lua_replace(L, argument);
        }
    }
    Vm::of(L).charge(L, cost);
    return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

}  // namespace reprise::scripting
