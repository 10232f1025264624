#include "towns/bridges/responsible_span.h"

#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "world/town.h"

namespace reprise::towns {

namespace {

constexpr double around = 20;    ///< [m] of a place: its own roads and those that it conflicts with
constexpr double raised = 0.01;  ///< [m] of height
constexpr double farthest = 1000;  ///< [m] longer than all ramps

}  // namespace

ResponsibleSpan::ResponsibleSpan(const RoadChains& roads,
                                 const Levels& levels,
                                 const std::vector<double>& heights)
    : roads_(roads),
      levels_(levels),
      nearest_(roads.places.size(), world::none),
      distances_(roads.places.size(), farthest) {
    // One search from all spans at once; of two as near the first in order wins.
    std::set<std::tuple<double, std::uint32_t, std::uint32_t>> open;  // distance, span, point
    const auto reach = [&](std::uint32_t point, double distance, std::uint32_t span) {
        if (std::pair(distance, span) >= std::pair(distances_[point], nearest_[point]))
            return;
        distances_[point] = distance;
        nearest_[point] = span;
        open.emplace(distance, span, point);
    };
    for (std::uint32_t span = 0; span < levels.spans.size(); ++span)
        for (const std::uint32_t point : levels.spans[span])
            reach(point, 0, span);
    while (!open.empty()) {
        const auto [distance, span, point] = *open.begin();
        open.erase(open.begin());
        if (std::pair(distance, span) != std::pair(distances_[point], nearest_[point]))
            continue;
        for (const RoadChains::Step& step : roads.steps[point])
            if (distance + step.length < farthest)
                reach(step.to, distance + step.length, span);
    }
    std::vector<world::BoxGrid::Entry> entries;
    for (std::uint32_t i = 0; i < roads.places.size(); ++i)
        if (std::abs(heights[i]) > raised && nearest_[i] != world::none) {
            world::Box box;
            box.take(roads.places[i], 0);
            entries.push_back({box, i});
        }
    raised_by_place_ = world::BoxGrid(entries);
}

std::uint32_t ResponsibleSpan::at(const Eigen::Vector2d& place) const {
    std::uint32_t found = world::none;
    double least = std::numeric_limits<double>::infinity();
    world::Box box;
    box.take(place, around);
    for (const std::uint32_t i : raised_by_place_.near(box))
        if (distances_[i] < least && (roads_.places[i] - place).norm() < around) {
            least = distances_[i];
            found = nearest_[i];
        }
    if (found != world::none)
        return found;
    for (std::uint32_t span = 0; span < levels_.spans.size(); ++span)
        for (const std::uint32_t point : levels_.spans[span])
            if (const double distance = (roads_.places[point] - place).norm(); distance < least) {
                least = distance;
                found = span;
            }
    return found;
}

}  // namespace reprise::towns
