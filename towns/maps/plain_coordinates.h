#pragma once

#include <filesystem>
#include <string>

namespace reprise::towns {

/// Every coordinate of an OpenStreetMap file must be digits with a sign and a point, as editors and
/// servers write it. Behind an exponent two readers need not see one place: netconvert takes 1e30
/// as it stands, libosmium's 64 bits overflow and may come out on the globe. Throws world::Error
/// "MAP:LINE: node 7: ..."; `called` is how the user calls the map. Reads the file once, in blocks,
/// up to where it stops to be XML.
void check_coordinates(const std::filesystem::path& map, const std::string& called);

}  // namespace reprise::towns
