#include "world/lane_starts.h"

#include <algorithm>
#include <cmath>

namespace reprise::world {

LaneStarts::LaneStarts(const LaneT& lane) {
    constexpr std::size_t long_line = 512;
    if (lane.centre.size() <= long_line)
        return;
    double start = 0;
    for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i) {
        starts_.push_back(start);
        const Vec3& p = lane.centre[i];
        const Vec3& q = lane.centre[i + 1];
        start += std::hypot(q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
    }
}

LanePoint LaneStarts::at(const LaneT& lane, double s) const {
    if (starts_.empty())
        return point_at(lane, s);
    const double from_start = std::max(s, 0.0);
    const auto next = std::upper_bound(starts_.begin(), starts_.end(), from_start);
    const auto segment = static_cast<std::size_t>(next - starts_.begin()) - 1;
    LaneT piece;
    piece.centre = {lane.centre[segment], lane.centre[segment + 1]};
    return point_at(piece, from_start - starts_[segment]);
}

}  // namespace reprise::world
