#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scripting/run/run.h"

namespace reprise::scripting {

/// A point of a trajectory as it was said.
struct SaidPoint {
    double time = 0;                   ///< [s] as said
    Eigen::Vector3d p_world{0, 0, 0};  ///< on the road
    std::optional<double> heading;     ///< [rad]
    std::string where;                 ///< for messages: "point 3", "lead.csv:4"
};

/// From the list at `index`, or the file that it names. Times strictly rise; at least one point.
/// `near` [m] is the height to begin at. Refuses what is no trajectory.
std::vector<SaidPoint> read_points(Run& run, lua_State* L, int index, double near);

}  // namespace reprise::scripting
