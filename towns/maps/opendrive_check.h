#pragma once

#include <string>
#include <string_view>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Refuses what netconvert would chew on for ever: roads of more than 200 km, pieces of them that
/// lie 100,000 km away or turn within a millimetre, numbers that are none, elements nested 1,000
/// deep. Throws world::Error "FILE:LINE: <ELEMENT>: ...". `root` is a map's, read out of `xml`.
void check_opendrive(const pugi::xml_node& root, std::string_view xml, const std::string& file);

}  // namespace reprise::towns
