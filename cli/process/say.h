#pragma once

#include <cstdio>
#include <string_view>
#include <type_traits>

#include <fmt/format.h>

#include "world/printable.h"

namespace reprise::cli {

/// What is printed of an argument: of a text, nothing that a terminal would obey.
template <typename Argument>
decltype(auto) shown(const Argument& argument) {
    if constexpr (std::is_convertible_v<const Argument&, std::string_view>)
        return world::printable(argument);
    else
        return (argument);
}

/// Prints what holds nothing but our own control characters. Throws world::Error when nobody takes
/// it.
void say_formatted(std::FILE* file, std::string_view text);

/// Prints as fmt::print does. The only way to the terminal for what is not all our own: names,
/// paths and texts come from files that others wrote.
template <typename... Arguments>
void say(std::FILE* file, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    say_formatted(file, fmt::vformat(format, fmt::make_format_args(shown(arguments)...)));
}

template <typename... Arguments>
void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    say_formatted(stdout, fmt::vformat(format, fmt::make_format_args(shown(arguments)...)));
}

/// Prints a text of several lines.
inline void say_lines(std::string_view text, std::FILE* file = stdout) {
    say_formatted(file, world::printable_lines(text));
}

}  // namespace reprise::cli
