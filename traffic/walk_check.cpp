#include "traffic/walk_check.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "world/town.h"

namespace reprise::traffic {

namespace {

constexpr int pairs = 400;
constexpr double connected_limit = 95;  ///< [%]

/// Places on the sidewalks, every metre as likely as the next.
class Sidewalks {
  public:
    explicit Sidewalks(const world::TownT& town) : town_(&town) {
        for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
            if (town.lanes[i].kind == world::LaneKind::sidewalk) {
                lanes_.push_back(i);
                ends_.push_back(length() + town.lanes[i].length);
            }
    }

    double length() const { return ends_.empty() ? 0 : ends_.back(); }

    std::size_t count() const { return lanes_.size(); }

    struct Place {
        const world::LaneT* lane;
        Eigen::Vector3d position;
    };

    /// `share` in [0, 1) of all metres.
    Place at(double share) const {
        const double metre = share * length();
        const auto found = std::upper_bound(ends_.begin(), ends_.end(), metre);
        const auto index = std::min<std::size_t>(static_cast<std::size_t>(found - ends_.begin()),
                                                 lanes_.size() - 1);
        const world::LaneT& lane = town_->lanes[lanes_[index]];
        return {&lane, world::point_at(lane, metre - (ends_[index] - lane.length)).position};
    }

  private:
    const world::TownT* town_;
    std::vector<std::uint32_t> lanes_;
    std::vector<double> ends_;  ///< [m] running sum of lengths
};

/// The k-th number of a sequence that fills [0, 1) evenly: multiples of an irrational number.
double spread(int k, double irrational) {
    const double multiple = (k + 1) * irrational;
    return multiple - std::floor(multiple);
}

struct Walked {
    double metres = 0;
    double on_road = 0;
};

void add_way(const std::vector<WalkMap::Step>& steps, Walked& walked) {
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
        const double metres = (steps[i + 1].position - steps[i].position).norm();
        walked.metres += metres;
        if (steps[i].surface == world::Surface::road)
            walked.on_road += metres;
    }
}

}  // namespace

world::Criterion check_walking(const world::TownT& town, const WalkMap& map) {
    world::Criterion connected{"sidewalks connected", 100, connected_limit, "%", true, "", {}};
    const Sidewalks sidewalks(town);
    if (sidewalks.count() == 0) {
        connected.looked_at = "no sidewalks";
        return connected;
    }
    // Irrational and independent of each other: the golden ratio, and the root of two.
    const double golden = (std::sqrt(5.0) - 1) / 2;
    const double root = std::sqrt(2.0);
    int reached = 0;
    Walked walked;
    for (int k = 0; k < pairs; ++k) {
        const Sidewalks::Place from = sidewalks.at(spread(k, golden));
        const Sidewalks::Place to = sidewalks.at(spread(k, root));
        if (const auto way = map.path(from.position, to.position)) {
            ++reached;
            add_way(*way, walked);
        } else if (connected.worst.size() < 5) {
            connected.worst.push_back(
                {from.lane->name + " to " + to.lane->name, from.position.head<2>(), 0});
        }
    }
    connected.figure = 100.0 * reached / pairs;
    if (connected.passed())
        connected.worst.clear();
    connected.looked_at = fmt::format("{} pairs, {:.1f} km; {:.1f} % of it on roads",
                                      pairs,
                                      walked.metres / 1000,
                                      100 * walked.on_road / std::max(walked.metres, 1.0));
    return connected;
}

}  // namespace reprise::traffic
