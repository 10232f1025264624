#pragma once

#include <string>
#include <string_view>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Refuses values for which netconvert would run for hours or overflow: roads of more than 200 km,
/// geometry 100,000 km from the origin or with radii below a millimetre, attributes that are not
/// numbers, elements nested more than 1,000 deep. `root` is the map's root element, parsed from
/// `xml`. Throws world::Error "FILE:LINE: <ELEMENT>: ...".
void check_opendrive(const pugi::xml_node& root, std::string_view xml, const std::string& file);

}  // namespace reprise::towns
