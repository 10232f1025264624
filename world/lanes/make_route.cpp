#include "world/lanes/make_route.h"

#include "world/check.h"
#include "world/lanes/route_steps.h"

namespace reprise::world {

Route make_route(const TownT& town,
                 const std::vector<std::uint32_t>& lanes,
                 double from_s,
                 double to_s) {
    REPRISE_CHECK(!lanes.empty(), "a route of no lanes");
    Route route;
    double begin = from_s;  // on the first lane of the edge
    for (std::size_t first = 0; first < lanes.size();) {
        // Lanes that are changed on one edge share its length.
        std::size_t last = first;
        while (last + 1 < lanes.size() &&
               link_between(town, lanes[last], lanes[last + 1]) == nullptr)
            ++last;
        const LaneT& goal = town.lanes[lanes[last]];
        const double goal_s = last + 1 == lanes.size() ? to_s : goal.length;
        const double end = beside(goal, goal_s, town.lanes[lanes[first]]);
        const double share = (end - begin) / static_cast<double>(last - first + 1);
        for (std::size_t i = first; i <= last; ++i) {
            const LaneT& lane = town.lanes[lanes[i]];
            const double scale = lane.length / town.lanes[lanes[first]].length;
            const double from = begin + share * static_cast<double>(i - first);
            route.pieces.push_back({lanes[i],
                                    from * scale,
                                    i == last ? goal_s : (from + share) * scale,
                                    route.length});
            route.length += route.pieces.back().to - route.pieces.back().from;
        }
        begin = 0;
        first = last + 1;
    }
    route.steps = find_steps(town, route);
    return route;
}

}  // namespace reprise::world
