#include "towns/bridges/responsible_span.h"

#include <cmath>
#include <limits>

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
      heights_(heights),
      nearest_(roads.places.size(), world::none),
      distances_(roads.places.size(), farthest) {
    for (std::uint32_t span = 0; span < levels.spans.size(); ++span) {
        std::vector<Source> sources;
        for (const std::uint32_t point : levels.spans[span])
            sources.push_back({point, 0});
        const std::vector<double> reached = distances(roads, sources, farthest);
        for (std::size_t i = 0; i < reached.size(); ++i)
            if (reached[i] < distances_[i]) {
                distances_[i] = reached[i];
                nearest_[i] = span;
            }
    }
}

std::uint32_t ResponsibleSpan::at(const Eigen::Vector2d& place) const {
    std::uint32_t found = world::none;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < roads_.places.size(); ++i)
        if (std::abs(heights_[i]) > raised && nearest_[i] != world::none && distances_[i] < least &&
            (roads_.places[i] - place).norm() < around) {
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
