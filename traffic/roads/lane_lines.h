#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "world/town.h"

namespace reprise::traffic {

/// The centre lines of a town's lanes in plan, with the metres to each of their points: what is
/// asked for many times a tick, side by side in memory.
class LaneLines {
  public:
    /// Must outlive this.
    explicit LaneLines(const world::TownT& town);

    const world::TownT& town() const { return *town_; }

    std::span<const Eigen::Vector2d> points(std::uint32_t lane) const {
        return {points_.data() + begin_[lane], points_.data() + begin_[lane + 1]};
    }

    /// [i] metres from the lane's start to its points()[i], in plan.
    std::span<const double> metres(std::uint32_t lane) const {
        return {metres_.data() + begin_[lane], metres_.data() + begin_[lane + 1]};
    }

    /// To the last bit as world::point_at has it, of which this is the part in plan.
    Eigen::Vector2d position_at(std::uint32_t lane, double s) const;

  private:
    const world::TownT* town_;
    std::vector<std::size_t> begin_;  ///< [lane] into the others; one more than there are lanes
    std::vector<Eigen::Vector2d> points_;
    std::vector<double> metres_;
    std::vector<double> pieces_;  ///< [m] from each point to the next one, uphill; 0 of the last
};

}  // namespace reprise::traffic
