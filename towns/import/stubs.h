#pragma once

#include <string>
#include <vector>

namespace reprise::towns {

/// Ids of the roads for cars that are shorter than 8 m and lead nowhere, both directions: where a
/// map was cut off behind a junction, or a drive begins there. Whoever goes there turns round in
/// the junction. Not those of a map that is nothing else.
std::vector<std::string> stubs(const std::string& network);

}  // namespace reprise::towns
