#include "traffic/roads/lane_lines.h"

#include <algorithm>

#include "world/frames.h"
#include "world/geometry2d.h"

namespace reprise::traffic {

LaneLines::LaneLines(const world::TownT& town) : town_(&town) {
    begin_.reserve(town.lanes.size() + 1);
    begin_.push_back(0);
    for (const world::LaneT& lane : town.lanes) {
        double s = 0;
        for (std::size_t i = 0; i < lane.centre.size(); ++i) {
            const Eigen::Vector2d p = world::in_plan(lane.centre[i]);
            if (i > 0)
                s += (p - points_.back()).norm();
            points_.push_back(p);
            metres_.push_back(s);
            const bool is_last = i + 1 == lane.centre.size();
            pieces_.push_back(
                is_last ? 0
                        : (world::to_eigen(lane.centre[i + 1]) - world::to_eigen(lane.centre[i]))
                              .norm());
        }
        begin_.push_back(points_.size());
    }
}

Eigen::Vector2d LaneLines::position_at(std::uint32_t lane, double s) const {
    double rest = std::max(s, 0.0);
    std::size_t i = begin_[lane];
    for (; rest >= pieces_[i] && i + 2 < begin_[lane + 1]; ++i)
        rest -= pieces_[i];
    const double share = pieces_[i] > 0 ? std::min(rest / pieces_[i], 1.0) : 0.0;
    return points_[i] + share * (points_[i + 1] - points_[i]);
}

}  // namespace reprise::traffic
