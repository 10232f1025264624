#pragma once

#include <filesystem>
#include <string_view>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Whether a network holds together: every name that an element uses is there, lanes are numbered,
/// junctions know each of their links, traffic lights have a state for each of theirs. SUMO takes
/// all of this for granted, and is stopped by its own assertions, or crashes, where it is not so.
/// `xml` is the text that `net` was parsed from. Throws world::Error "file:line: <element>: what".
void check_network(const std::filesystem::path& path, std::string_view xml, pugi::xml_node net);

}  // namespace reprise::towns
