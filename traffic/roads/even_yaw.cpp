#include "traffic/roads/even_yaw.h"

#include <algorithm>
#include <cmath>

namespace reprise::traffic {

double even_yaw_at(const world::LaneT& lane, double s) {
    constexpr double farthest = 3;  // [m] to both sides; up to the lane's ends
    const double reach = std::clamp(std::min(s, lane.length - s), 0.0, farthest);
    const world::LanePoint behind = world::point_at(lane, s - reach);
    const world::LanePoint ahead = world::point_at(lane, s + reach);
    if (behind.yaw == ahead.yaw)
        return behind.yaw;
    const Eigen::Vector3d chord = ahead.position - behind.position;
    return std::atan2(chord.y(), chord.x());
}

}  // namespace reprise::traffic
