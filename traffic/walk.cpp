#include "traffic/walk.h"

#include "world/models/vehicle_classes.h"
#include "world/random.h"

namespace reprise::traffic {

void walk_on(Car& car,
             const RoadGraph& graph,
             world::ClassSet classes,
             std::uint64_t seed,
             double distance) {
    double planned = 0;
    while (planned < distance) {
        const std::vector<std::uint32_t> ways = graph.ways_on(car.last_lane, classes);
        car.dead_end = ways.empty();
        if (car.dead_end)
            return;
        const std::uint64_t item = (std::uint64_t{car.id} << 24U) + car.draws++;
        car.last_lane =
            ways[world::draw_index(ways.size(), seed, 0, world::Purpose::demand_route, item)];
        car.route.push_back(graph.edge_of(car.last_lane));
        planned += graph.edge(car.route.back()).length;
    }
}

void walk_from(std::uint32_t lane,
               Car& car,
               const RoadGraph& graph,
               world::ClassSet classes,
               std::uint64_t seed,
               double distance) {
    // From inside a junction the plan starts with the edge that the car came from.
    car.route = {graph.edge_of(lane)};
    car.last_lane = lane;
    if (graph.edge_after(lane) != graph.edge_of(lane)) {
        car.route.push_back(graph.edge_after(lane));
        car.last_lane = graph.edge(car.route.back()).lanes.front();
    }
    walk_on(car, graph, classes, seed, distance);
}

}  // namespace reprise::traffic
