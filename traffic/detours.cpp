#include "traffic/detours.h"

#include <algorithm>
#include <limits>

#include "traffic/cars/fleet.h"
#include "world/models/catalogue.h"
#include "world/random.h"

namespace reprise::traffic {

namespace {

constexpr double near_the_end = 30;        // [m] where drivers see whether they can go on
constexpr double slow = 2;                 // [m/s] below which a car counts as part of a queue
constexpr double gap = 3;                  // [m] behind a queue
constexpr double wrong_lane_patience = 5;  // [s] at the end of a lane that leads elsewhere
constexpr double longest_patience = 45;    // [s] longer than any light is red

double needed(const Car& car) {
    return world::vehicle_models()[car.model].length + gap;
}

}  // namespace

/// How much of the start of each lane is free of cars that stand or crawl. [m]
std::vector<double> Detours::room_at_starts(const Cars& cars) const {
    std::vector<double> room(town_->lanes.size(), std::numeric_limits<double>::max());
    for (const Car& car : cars.all()) {
        if (car.lane == world::none || car.speed > slow)
            continue;
        const double length = world::vehicle_models()[car.model].length;
        room[car.lane] = std::min(room[car.lane], car.lane_position - length);
        // Who stands in a junction for long will need the road behind it first.
        if (town_->lanes[car.lane].kind == world::LaneKind::internal &&
            car.standing_ticks * step_ > wrong_lane_patience)
            for (const world::Link& link : town_->lanes[car.lane].links)
                room[link.to()] = std::min(room[link.to()], 0.0);
    }
    return room;
}

/// Not in every tick: drivers need time to make up their minds, and we to ask them.
bool Detours::looks_around(const Car& car, std::uint64_t tick) const {
    constexpr std::uint64_t every = 20;  // [ticks]
    if (car.origin != Origin::demand || car.sumo.empty() || car.lane == world::none ||
        car.speed > slow || (tick + car.id) % every != 0 || car.route.size() < 2)
        return false;
    const world::LaneT& lane = town_->lanes[car.lane];
    return lane.kind == world::LaneKind::driving &&
           car.route.front() == graph_->edge_of(car.lane) &&
           lane.sumo_length - car.lane_position < near_the_end;
}

/// Has the next road of its route no room where the car would come onto it, or does its lane not
/// lead there, or has it waited for too long?
bool Detours::is_shut(const Car& car, const std::vector<double>& room) const {
    const double waited = car.standing_ticks * step_;
    if (!graph_->leads_to(car.lane, car.route[1]))
        return waited > wrong_lane_patience;
    if (waited > longest_patience)
        return true;
    const auto& links = town_->lanes[car.lane].links;
    return std::none_of(links.begin(), links.end(), [&](const world::Link& link) {
        return link.to() != world::none && graph_->edge_of(link.to()) == car.route[1] &&
               room[link.to()] >= needed(car);
    });
}

/// Onto one of the other roads that its lane leads to and that have room.
void Detours::turn_off(Car& car, const std::vector<double>& room) const {
    std::vector<std::uint32_t> ways = graph_->ways_on(car.lane,
                                                      model_class(car.model),
                                                      /*keeps_lane=*/true,
                                                      world::vehicle_models()[car.model].length);
    std::erase_if(ways, [&](std::uint32_t way) {
        return graph_->edge_of(way) == car.route[1] || room[way] < needed(car);
    });
    if (ways.empty())
        return;
    routes_->turn_off(ways, car);
    routes_->send(car);
}

void Detours::take(Cars& cars, std::uint64_t tick) const {
    std::vector<double> room;
    for (Car& car : cars.all()) {
        if (!looks_around(car, tick))
            continue;
        if (room.empty())
            room = room_at_starts(cars);
        if (is_shut(car, room))
            turn_off(car, room);
    }
}

}  // namespace reprise::traffic
