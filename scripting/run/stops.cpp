#include "scripting/run/stops.h"

#include <algorithm>

#include "world/units.h"

namespace reprise::scripting {

namespace {

/// The cheapest way to a lane of one stop.
struct Reached {
    double cost = world::infinity;  ///< [m] by the planner's measure
    std::size_t before = 0;         ///< which lane of the stop before it comes from
};

/// From the start of a stop's lane, or from where one is, to the start of another one's.
double cost_of_leg(const world::TownT& town,
                   const world::Planner& planner,
                   world::LanePlace from,
                   std::uint32_t to) {
    // Changes of lanes may be made on it as well, so it counts whole, for a moment.
    const double length = town.lanes[to].length;
    const auto cost = planner.cost(from, {to, length});
    return cost ? *cost - length : world::infinity;
}

/// Without a place where one is, all lanes alike.
std::vector<Reached> first_reached(const world::TownT& town,
                                   const world::Planner& planner,
                                   std::optional<world::LanePlace> here,
                                   const StopLanes& lanes) {
    std::vector<Reached> reached(lanes.size());
    for (std::size_t i = 0; i < lanes.size(); ++i)
        reached[i].cost = here ? cost_of_leg(town, planner, *here, lanes[i]) : 0;
    return reached;
}

std::vector<Reached> next_reached(const world::TownT& town,
                                  const world::Planner& planner,
                                  const std::vector<Reached>& before,
                                  const StopLanes& from,
                                  const StopLanes& to) {
    std::vector<Reached> reached(to.size());
    for (std::size_t i = 0; i < to.size(); ++i)
        for (std::size_t j = 0; j < from.size(); ++j) {
            if (before[j].cost == world::infinity)
                continue;
            const double cost = before[j].cost + cost_of_leg(town, planner, {from[j], 0}, to[i]);
            if (cost < reached[i].cost)
                reached[i] = {cost, j};
        }
    return reached;
}

}  // namespace

std::size_t searches_for(std::span<const StopLanes> stops) {
    std::size_t searches = stops.empty() ? 0 : stops.front().size();
    bool any = searches > 1;
    for (std::size_t i = 1; i < stops.size(); ++i) {
        any = any || stops[i].size() > 1;
        searches += stops[i].size() * stops[i - 1].size();
    }
    return any ? searches : 0;
}

std::vector<std::uint32_t> choose_lanes(const world::TownT& town,
                                        const world::Planner& planner,
                                        std::optional<world::LanePlace> here,
                                        std::span<const StopLanes> stops) {
    std::vector<std::uint32_t> lanes;
    for (const StopLanes& stop : stops)
        lanes.push_back(stop.front());
    if (searches_for(stops) == 0)
        return lanes;
    std::vector<std::vector<Reached>> reached{first_reached(town, planner, here, stops.front())};
    for (std::size_t i = 1; i < stops.size(); ++i)
        reached.push_back(next_reached(town, planner, reached.back(), stops[i - 1], stops[i]));
    const auto cheaper = [](const Reached& one, const Reached& other) {
        return one.cost < other.cost;
    };
    const auto best = std::min_element(reached.back().begin(), reached.back().end(), cheaper);
    if (best->cost == world::infinity)
        return lanes;
    auto choice = static_cast<std::size_t>(best - reached.back().begin());
    for (std::size_t i = stops.size(); i-- > 0;) {
        lanes[i] = stops[i][choice];
        choice = reached[i][choice].before;
    }
    return lanes;
}

}  // namespace reprise::scripting
