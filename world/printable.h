#pragma once

#include <string>
#include <string_view>

namespace reprise::world {

/// With what a terminal would obey or could not show written out, byte by byte ("\x1b"): control
/// characters other than the tabulator, what turns the direction of writing or breaks lines
/// (U+061C, U+200E, U+200F, U+2028..202E, U+2066..2069), and broken UTF-8. For every text that
/// comes from a file or a scenario and that people will read.
std::string printable(std::string_view text);

/// The same for a text of several lines: line feeds stay.
std::string printable_lines(std::string_view text);

}  // namespace reprise::world
