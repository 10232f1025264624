#include "scripting/limits.h"

#include <cstdint>
#include <fmt/format.h>
#include <string>

#include <lua.hpp>

#include "scripting/arguments.h"
#include "scripting/vm.h"

namespace reprise::scripting {

namespace {

constexpr std::size_t longest_string = std::size_t{1} << 20U;  // [bytes] made in one call
constexpr lua_Integer most_moved = 1'000'000;                  // elements in one call
constexpr double most_pattern_steps = 1e8;

/// Upvalue 1: the stock function. Called in this very frame, so that its messages know its name.
int call_stock(lua_State* L) {
    return lua_tocfunction(L, lua_upvalueindex(1))(L);
}

/// Matching backtracks: with k repetitions a text of n characters can take n^(k+1) steps.
double pattern_steps(const std::string& pattern, std::size_t text_size) {
    double steps = static_cast<double>(text_size) + 1;
    for (const char c : pattern) {
        if (c == '*' || c == '+' || c == '-')
            steps *= static_cast<double>(text_size) + 1;
        if (c == '?')
            steps *= 2;
    }
    return steps;
}

}  // namespace

int repeat_text(lua_State* L) {
    const std::string text = text_at(L, 1, "string.rep", "the text");
    const std::int64_t count = integer_at(L, 2, "string.rep", "the count");
    const std::string separator =
        lua_isnoneornil(L, 3) ? "" : text_at(L, 3, "string.rep", "the separator");
    const auto longest = static_cast<double>(longest_string);
    if (static_cast<double>(count) * static_cast<double>(text.size() + separator.size()) > longest)
        refuse("string.rep", "the result would be longer than 1 MB");
    return call_stock(L);
}

int search_text(lua_State* L) {
    const std::string text = text_at(L, 1, "string", "the text");
    const std::string pattern = text_at(L, 2, "string", "the pattern");
    const double steps = pattern_steps(pattern, text.size());
    if (steps > most_pattern_steps)
        refuse("string",
               fmt::format("the pattern '{}' may take too long on {} characters: use fewer "
                           "repetitions, or shorter texts",
                           pattern,
                           text.size()));
    Vm::of(L).charge(L, static_cast<std::uint64_t>(steps / 1e4));
    return call_stock(L);
}

int move_elements(lua_State* L) {
    const std::int64_t first = integer_at(L, 2, "table.move", "the first position");
    const std::int64_t last = integer_at(L, 3, "table.move", "the last position");
    if (static_cast<double>(last) - static_cast<double>(first) > static_cast<double>(most_moved))
        refuse("table.move", "more than 1,000,000 elements in one call");
    if (last > first)
        Vm::of(L).charge(L, static_cast<std::uint64_t>(last - first));
    return call_stock(L);
}

}  // namespace reprise::scripting
