#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

namespace reprise::walkers {

/// Where people are, to be asked whether anybody is near. [m]
class Places {
  public:
    void clear() { by_x_.clear(); }

    void add(const Eigen::Vector2d& place) { by_x_.push_back(place); }

    /// Behind it nobody is added.
    void sort() {
        std::sort(by_x_.begin(), by_x_.end(), [](const auto& one, const auto& other) {
            return one.x() < other.x();
        });
    }

    bool any_within(const Eigen::Vector2d& p, double reach) const {
        auto at = std::lower_bound(
            by_x_.begin(), by_x_.end(), p.x() - reach, [](const Eigen::Vector2d& one, double x) {
                return one.x() < x;
            });
        for (; at != by_x_.end() && at->x() <= p.x() + reach; ++at)
            if ((*at - p).squaredNorm() < reach * reach)
                return true;
        return false;
    }

  private:
    std::vector<Eigen::Vector2d> by_x_;
};

}  // namespace reprise::walkers
