#pragma once

#include <cstddef>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// Where a junction is joined of several, netconvert may begin a road before the corner at which
/// one turns into it, or end one behind it: the way goes beyond, and cars turn by more than 107
/// degrees on the spot. The road is cut to where the turn ends, at most 8 m, and the way is a
/// curve; other ways take the rest of the road over. Where that is not enough the way swings out
/// over the junction, on an arc of 4 to 6.5 m; so does one that goes out over the junction and
/// comes back by a corner in its own middle. What turns less keeps every byte. Returns how many
/// ways were mended.
std::size_t mend_sharp_corners(pugi::xml_node net);

}  // namespace reprise::towns
