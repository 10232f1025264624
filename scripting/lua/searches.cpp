#include "scripting/lua/searches.h"

#include <cstdint>
#include <cstring>
#include <string>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/lua/arguments.h"
#include "scripting/lua/binding.h"
#include "scripting/lua/patterns.h"
#include "scripting/lua/text.h"
#include "scripting/lua/vm.h"

namespace reprise::scripting {

namespace {

/// As Lua holds it: stays where it is while the stack does.
std::string_view view_at(lua_State* L, int index, const char* who, const char* what) {
    if (lua_type(L, index) != LUA_TSTRING)
        text_at(L, index, who, what);  // refuses
    std::size_t size = 0;
    const char* const text = lua_tolstring(L, index, &size);
    return {text, size};
}

Pattern pattern_on(lua_State* L, std::string_view text, std::string_view pattern) {
    return {text, pattern, [L](std::uint64_t steps) { Vm::of(L).charge(L, steps); }};
}

/// The optional start, from 1, negative from the end, as an offset. Beyond the end: size + 1.
std::size_t start_at(lua_State* L, int index, const char* who, std::size_t size) {
    const std::int64_t from =
        lua_isnoneornil(L, index) ? 1 : integer_at(L, index, who, "the start");
    const auto length = static_cast<std::int64_t>(size);
    if (from > length + 1)
        return size + 1;
    if (from > 0)
        return static_cast<std::size_t>(from - 1);
    return from < -length || from == 0 ? 0 : static_cast<std::size_t>(length + from);
}

void push_capture(lua_State* L,
                  const Pattern& pattern,
                  std::string_view text,
                  std::size_t index,
                  std::size_t start,
                  std::size_t end) {
    const Pattern::Capture capture = pattern.capture(index, start, end);
    if (capture.is_position)
        lua_pushinteger(L, static_cast<lua_Integer>(capture.start + 1));
    else
        lua_pushlstring(L, text.data() + capture.start, capture.size);
}

int push_captures(lua_State* L,
                  const Pattern& pattern,
                  std::string_view text,
                  std::size_t start,
                  std::size_t end,
                  bool whole_if_none) {
    const std::size_t count = pattern.captures(whole_if_none);
    luaL_checkstack(L, static_cast<int>(count), "too many captures");
    for (std::size_t index = 0; index < count; ++index)
        push_capture(L, pattern, text, index, start, end);
    return static_cast<int>(count);
}

/// Where a match begins and ends, from `start` on. None: false.
bool search(Pattern& pattern, std::size_t size, std::size_t& start, std::size_t& end) {
    for (; start <= size; ++start) {
        if (const auto found = pattern.match_at(start)) {
            end = *found;
            pattern.settle();
            return true;
        }
        if (pattern.is_anchored())
            break;
    }
    pattern.settle();
    return false;
}

int find_plain(lua_State* L, std::string_view text, std::string_view wanted, std::size_t start) {
    Vm::of(L).charge(L, (text.size() + wanted.size()) / 8);
    // Two-way search: the work grows with the lengths, not with their product.
    const void* const found =
        memmem(text.data() + start, text.size() - start, wanted.data(), wanted.size());
    if (found == nullptr) {
        lua_pushnil(L);
        return 1;
    }
    const lua_Integer at = static_cast<const char*>(found) - text.data();
    lua_pushinteger(L, at + 1);
    lua_pushinteger(L, at + static_cast<lua_Integer>(wanted.size()));
    return 2;
}

int find_or_match(lua_State* L, const char* who, bool find) {
    const std::string_view text = view_at(L, 1, who, "the text");
    const std::string_view wanted = view_at(L, 2, who, "the pattern");
    std::size_t start = start_at(L, 3, who, text.size());
    if (start > text.size()) {
        lua_pushnil(L);
        return 1;
    }
    Vm::of(L).charge(L, wanted.size() / 16);
    if (find && (lua_toboolean(L, 4) != 0 || is_plain(wanted)))
        return find_plain(L, text, wanted, start);
    Pattern pattern = pattern_on(L, text, wanted);
    std::size_t end = 0;
    if (!search(pattern, text.size(), start, end)) {
        lua_pushnil(L);
        return 1;
    }
    if (!find)
        return push_captures(L, pattern, text, start, end, true);
    lua_pushinteger(L, static_cast<lua_Integer>(start + 1));
    lua_pushinteger(L, static_cast<lua_Integer>(end));
    return 2 + push_captures(L, pattern, text, start, end, false);
}

/// Upvalues: text, pattern, where to go on, the end of the last match (-1: none).
int next_match(lua_State* L) {
    const std::string_view text = view_at(L, lua_upvalueindex(1), "", "");
    Pattern pattern = pattern_on(L, text, view_at(L, lua_upvalueindex(2), "", ""));
    const lua_Integer last = lua_tointeger(L, lua_upvalueindex(4));
    auto start = static_cast<std::size_t>(lua_tointeger(L, lua_upvalueindex(3)));
    for (; start <= text.size(); ++start) {
        const auto end = pattern.match_at(start);
        if (!end || static_cast<lua_Integer>(*end) == last)
            continue;
        pattern.settle();
        lua_pushinteger(L, static_cast<lua_Integer>(*end));
        lua_copy(L, -1, lua_upvalueindex(3));
        lua_replace(L, lua_upvalueindex(4));
        return push_captures(L, pattern, text, start, *end, true);
    }
    pattern.settle();
    lua_pushinteger(L, static_cast<lua_Integer>(text.size() + 1));
    lua_replace(L, lua_upvalueindex(3));
    return 0;
}

void want_room(const std::string& result) {
    if (result.size() > longest_text)
        refuse("string.gsub", "the result would be longer than 64 kB");
}

/// "%1" and its kin in the replacement at 3.
void add_replacement(lua_State* L,
                     const Pattern& pattern,
                     std::string_view text,
                     std::size_t start,
                     std::size_t end,
                     std::string& result) {
    const std::string_view replacement = view_at(L, 3, "", "");
    Vm::of(L).charge(L, replacement.size());
    for (std::size_t i = 0; i < replacement.size(); ++i) {
        want_room(result);
        if (replacement[i] != '%') {
            result += replacement[i];
            continue;
        }
        const char letter = ++i < replacement.size() ? replacement[i] : '\0';
        if (letter == '%') {
            result += '%';
        } else if (letter == '0') {
            result += text.substr(start, end - start);
        } else if (letter >= '1' && letter <= '9') {
            push_capture(L, pattern, text, static_cast<std::size_t>(letter - '1'), start, end);
            result += text_of(L, -1);
            lua_pop(L, 1);
        } else {
            refuse("string.gsub", "invalid use of '%' in the replacement");
        }
    }
}

/// What the table or function at 3 has for the match; the match itself for nil and false.
void add_answer(lua_State* L,
                const Pattern& pattern,
                std::string_view text,
                std::size_t start,
                std::size_t end,
                std::string& result) {
    if (lua_type(L, 3) == LUA_TTABLE) {
        push_capture(L, pattern, text, 0, start, end);
        lua_gettable(L, 3);
    } else {
        lua_pushvalue(L, 3);
        lua_call(L, push_captures(L, pattern, text, start, end, true), 1);
    }
    const int type = lua_type(L, -1);
    if (lua_toboolean(L, -1) == 0)
        result += text.substr(start, end - start);
    else if (type == LUA_TSTRING || type == LUA_TNUMBER)
        result += text_of(L, -1);
    else
        refuse("string.gsub",
               fmt::format("the replacement must be a string, got {}", lua_typename(L, type)));
    lua_pop(L, 1);
}

}  // namespace

int find_text(lua_State* L) {
    return find_or_match(L, "string.find", true);
}

int match_text(lua_State* L) {
    return find_or_match(L, "string.match", false);
}

int match_all(lua_State* L) {
    const char* const who = "string.gmatch";
    const std::string_view text = view_at(L, 1, who, "the text");
    const std::string_view pattern = view_at(L, 2, who, "the pattern");
    if (!pattern.empty() && pattern.front() == '^')
        refuse(who, "a pattern for all matches cannot start with '^'");
    const std::size_t start = start_at(L, 3, who, text.size());
    lua_settop(L, 2);
    lua_pushinteger(L, static_cast<lua_Integer>(start));
    lua_pushinteger(L, -1);
    lua_pushcclosure(L, guarded<next_match>, 4);
    return 1;
}

int replace_text(lua_State* L) {
    const char* const who = "string.gsub";
    const std::string_view text = view_at(L, 1, who, "the text");
    Pattern pattern = pattern_on(L, text, view_at(L, 2, who, "the pattern"));
    const int type = lua_type(L, 3);
    if (type == LUA_TNUMBER) {
        const std::string number = text_of(L, 3);
        lua_pushlstring(L, number.data(), number.size());
        lua_replace(L, 3);
    } else if (type != LUA_TSTRING && type != LUA_TTABLE && type != LUA_TFUNCTION) {
        refuse(who, "the replacement must be a string, a table or a function");
    }
    const std::int64_t most =
        lua_isnoneornil(L, 4) ? INT64_MAX : integer_at(L, 4, who, "the number of replacements");
    std::string result;
    std::size_t start = 0;
    std::optional<std::size_t> last;
    std::int64_t count = 0;
    while (count < most) {
        const auto end = pattern.match_at(start);
        if (end && end != last) {
            ++count;
            if (type == LUA_TTABLE || type == LUA_TFUNCTION)
                add_answer(L, pattern, text, start, *end, result);
            else
                add_replacement(L, pattern, text, start, *end, result);
            start = *end;
            last = end;
        } else if (start < text.size()) {
            result += text[start++];
        } else {
            break;
        }
        want_room(result);
        if (pattern.is_anchored())
            break;
    }
    pattern.settle();
    if (start < text.size())
        result += text.substr(start);
    lua_pushlstring(L, result.data(), result.size());
    lua_pushinteger(L, count);
    return 2;
}

}  // namespace reprise::scripting
