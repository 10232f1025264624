#pragma once

#include <cstddef>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Where a junction reaches over the next one, programs such as netconvert end a road behind the
/// place where the road behind that one begins: the way between them runs against its traffic, and
/// who drives there turns round on the spot, twice. The longer of both roads is cut off there;
/// where both are shorter than what is too much, the first is moved back, with the ends of the ways
/// that lead onto it. What is sound keeps every byte. Returns how many ways were mended.
std::size_t mend_backward_ways(pugi::xml_node net);

}  // namespace reprise::towns
