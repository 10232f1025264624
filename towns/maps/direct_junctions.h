#pragma once

#include <string>
#include <string_view>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Where roads part or join without connecting roads (<junction type="direct">, OpenDRIVE 1.7),
/// each connection gets one, 0.1 m long and drawn where the linked road begins: netconvert 1.15
/// knows no other junctions. In place; says how many it added. Throws world::Error "file:line:
/// what" for a connection of roads that are not there.
int add_connecting_roads(pugi::xml_node root, std::string_view xml, const std::string& file);

}  // namespace reprise::towns
