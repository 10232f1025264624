#include "towns/check/walk_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "world/town.h"

namespace reprise::towns {

namespace {

using world::LaneKind;

constexpr int pairs = 400;
constexpr double connected_limit = 95;  ///< [%]

/// For each lane the first one of those that the network joins for walkers; cars' lanes are alone.
std::vector<std::uint32_t> components(const world::TownT& town) {
    std::vector<std::uint32_t> joined(town.lanes.size());
    std::iota(joined.begin(), joined.end(), 0U);
    const auto first_of = [&](std::uint32_t lane) {
        while (joined[lane] != lane)
            lane = joined[lane] = joined[joined[lane]];
        return lane;
    };
    const auto for_walkers = [&](std::uint32_t lane) {
        const LaneKind kind = town.lanes[lane].kind;
        return kind == LaneKind::sidewalk || kind == LaneKind::crossing ||
               kind == LaneKind::walking_area;
    };
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        for (const world::Link& link : town.lanes[i].links)
            if (link.to() != world::none && for_walkers(i) && for_walkers(link.to())) {
                const auto [low, high] = std::minmax({first_of(i), first_of(link.to())});
                joined[high] = low;
            }
    for (std::uint32_t i = 0; i < joined.size(); ++i)
        joined[i] = first_of(i);
    return joined;
}

/// The sidewalks of the component with most of them by length; all of them where the network joins
/// none.
std::vector<std::uint32_t> largest_component(const world::TownT& town) {
    const std::vector<std::uint32_t> joined = components(town);
    std::vector<double> lengths(joined.size());  // [m] by component
    std::vector<std::uint32_t> all;
    bool any_joined = false;
    for (std::uint32_t i = 0; i < joined.size(); ++i) {
        any_joined = any_joined || joined[i] != i;
        if (town.lanes[i].kind != LaneKind::sidewalk)
            continue;
        all.push_back(i);
        lengths[joined[i]] += town.lanes[i].length;
    }
    if (!any_joined)
        return all;
    const auto largest = static_cast<std::uint32_t>(
        std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    std::erase_if(all, [&](std::uint32_t lane) { return joined[lane] != largest; });
    return all;
}

/// Places on some sidewalks, every metre as likely as the next.
class Sidewalks {
  public:
    Sidewalks(const world::TownT& town, std::vector<std::uint32_t> lanes)
        : town_(&town),
          lanes_(std::move(lanes)) {
        for (const std::uint32_t lane : lanes_)
            ends_.push_back(length() + town.lanes[lane].length);
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

void add_way(const std::vector<walkers::WalkMap::Step>& steps, Walked& walked) {
    for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
        const double metres = (steps[i + 1].position - steps[i].position).norm();
        walked.metres += metres;
        if (steps[i].surface == ground::Surface::road)
            walked.on_road += metres;
    }
}

double length_of_sidewalks(const world::TownT& town) {
    double length = 0;
    for (const world::LaneT& lane : town.lanes)
        length += lane.kind == LaneKind::sidewalk ? lane.length : 0;
    return length;
}

/// Which sidewalks were looked at, unless all were.
std::string among(double looked_at, double all) {
    constexpr double nearly = 0.999;
    return looked_at > nearly * all
               ? ""
               : fmt::format("; among the {:.0f} % of sidewalks that the network joins",
                             100 * looked_at / all);
}

}  // namespace

towns::Criterion check_walking(const world::TownT& town, const walkers::WalkMap& map) {
    towns::Criterion connected{"sidewalks connected", 100, connected_limit, "%", true, "", {}};
    const Sidewalks sidewalks(town, largest_component(town));
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
        } else if (connected.worst.size() < shown_places) {
            connected.worst.push_back(
                {from.lane->name + " to " + to.lane->name, from.position.head<2>(), 0});
        }
    }
    connected.figure = 100.0 * reached / pairs;
    if (connected.passed())
        connected.worst.clear();
    connected.looked_at = fmt::format("{} pairs, {:.1f} km; {:.1f} % of it on roads{}",
                                      pairs,
                                      walked.metres / 1000,
                                      100 * walked.on_road / std::max(walked.metres, 1.0),
                                      among(sidewalks.length(), length_of_sidewalks(town)));
    return connected;
}

}  // namespace reprise::towns
