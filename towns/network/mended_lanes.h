#pragma once

#include <cstddef>

namespace pugi {
class xml_node;
}

namespace reprise::towns {

/// What was changed in the lanes of a network.
struct MendedLanes {
    std::size_t folds = 0;    ///< lanes whose line ran back over itself
    std::size_t lengths = 0;  ///< roads that are as long now as they are drawn
    std::size_t closed = 0;   ///< lanes of no width, which nobody may use now
};

/// Mends what other programs write into lanes and no car can follow: points at which the line
/// turns back onto itself (by more than sharpest_turn of lane_check.h, within a few metres) are
/// left out; roads whose lanes are all drawn longer or shorter than SUMO counts them get the length
/// of the drawing, or cars would pass there at another speed than the one they have; a lane of no
/// width is closed, and as narrow as can be drawn. What is sound keeps every byte.
MendedLanes mend_lanes(pugi::xml_node net);

}  // namespace reprise::towns
