#pragma once

#include <string>
#include <string_view>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Does traffic drive on the left in this map? Throws world::Error that names a road of the other
/// rule, where not all have the same.
bool drives_on_the_left(const pugi::xml_node& root, std::string_view xml, const std::string& file);

/// The same map in a mirror that stands on the x axis, in place: y, headings, curvatures, t and the
/// numbers of lanes change their sign, and who drove on the left drives on the right. netconvert
/// 1.15 knows no rule="LHT": it takes the lanes to the right of the reference line for those along
/// it.
void mirror_opendrive(pugi::xml_node root);

}  // namespace reprise::towns
