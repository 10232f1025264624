#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

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
/// turns back onto itself (by more than sharpest_turn, within a few metres) are left out; roads
/// whose lanes are all drawn longer or shorter than SUMO counts them get the length of the drawing,
/// or cars would pass there at another speed than the one they have; a lane of no width is closed,
/// and as narrow as can be drawn. What is sound keeps every byte.
MendedLanes mend_lanes(pugi::xml_node net);

/// [rad] A line may turn by so much at one point: a V. Beyond it, it folds back.
inline constexpr double sharpest_turn = 150.0 / 180.0 * 3.14159265358979323846;

/// [rad] by which a line turns at its point `i`, not the first nor last: 0 to pi.
double turn_at(const std::vector<Eigen::Vector2d>& line, std::size_t i);

}  // namespace reprise::towns
