#include "traffic/route_planner.h"

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"
#include "world/random.h"

namespace reprise::traffic {

namespace {

constexpr double short_plan = 500;     // [m] left: time to plan on
constexpr std::size_t many_edges = 8;  // more than these are never a short plan

/// A scripted car may go wherever a passenger car may, whatever its model.
world::ClassSet classes_of(const Car& car) {
    return car.origin == Origin::demand ? model_class(car.model) : world::class_bit("passenger");
}

/// [m] of who plans by it: a scripted car turns around wherever there is no other way.
double length_of(const Car& car) {
    return car.origin == Origin::demand ? world::vehicle_models()[car.model].length : 0;
}

}  // namespace

void RoutePlanner::start(std::uint32_t lane, Car& car) const {
    // From inside a junction the route starts with the edge that the car came from.
    car.route = {graph_->edge_of(lane)};
    car.last_lane = lane;
    if (graph_->edge_after(lane) != graph_->edge_of(lane)) {
        car.route.push_back(graph_->edge_after(lane));
        car.last_lane = graph_->edge(car.route.back()).lanes.front();
    }
    extend(car);
}

std::uint32_t RoutePlanner::draw(const std::vector<std::uint32_t>& ways, Car& car) const {
    const std::uint64_t item = (std::uint64_t{car.id} << 24U) + car.draws++;
    return ways[world::draw_index(ways.size(), seed_, 0, world::Purpose::demand_route, item)];
}

void RoutePlanner::turn_off(const std::vector<std::uint32_t>& ways, Car& car) const {
    car.last_lane = draw(ways, car);
    car.route = {car.route.front(), graph_->edge_of(car.last_lane)};
    extend(car);
}

void RoutePlanner::extend(Car& car) const {
    const world::ClassSet classes = classes_of(car);
    double planned = 0;
    while (planned < length) {
        const std::vector<std::uint32_t> ways =
            graph_->ways_on(car.last_lane, classes, car.keeps_lane, length_of(car));
        car.dead_end = ways.empty();
        if (car.dead_end)
            return;
        car.last_lane = draw(ways, car);
        car.route.push_back(graph_->edge_of(car.last_lane));
        planned += graph_->edge(car.route.back()).length;
    }
}

void RoutePlanner::send(const Car& car) const {
    libsumo::Vehicle::setRoute(car.sumo, graph_->names(car.route));
}

void RoutePlanner::keep_ahead(Cars& cars) const {
    for (Car& car : cars.all()) {
        if (car.sumo.empty() || car.origin == Origin::parked || car.dead_end ||
            car.route.size() > many_edges)
            continue;
        double left = 0;
        for (const std::uint32_t edge : car.route)
            left += graph_->edge(edge).length;
        if (left >= short_plan && car.route.size() > 2)
            continue;
        extend(car);
        send(car);
    }
}

}  // namespace reprise::traffic
