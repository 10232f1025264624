#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "traffic/background_state.h"
#include "traffic/fleet.h"
#include "traffic/walk.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::none;

constexpr double short_plan = 500;   // [m] left: time to plan on
constexpr double too_long = 240;     // [s] of standing, after which a car gives up its place
constexpr double out_of_sight = 80;  // [m] from every physics vehicle

bool is_seen(const Eigen::Vector3d& p, const world::TickView& last, double sight) {
    const auto vehicles = last.vehicles();
    return std::any_of(vehicles.begin(), vehicles.end(), [&](const world::VehicleState& vehicle) {
        return std::hypot(vehicle.position().x() - p.x(), vehicle.position().y() - p.y()) < sight;
    });
}

}  // namespace

std::optional<Place> find_place(const Places& places,
                                double car_length,
                                world::ClassSet car,
                                std::span<const Taken> taken,
                                PlaceSearch& search) {
    for (int i = 0; i < search.tries; ++i) {
        const double drawn = world::draw(search.seed, search.tick, search.purpose, search.item++);
        const auto place = places.at(drawn, car_length, car);
        // The first half of the tries asks for all the room that was wished, the rest for less.
        const double ease = std::min(1.0, 2.0 - 2.0 * i / search.tries);
        constexpr double least = 3;  // [m]
        const double margin = std::max(least, search.margin * ease);
        if (place && places.is_free(*place, car_length, taken, margin, search.sight * ease))
            return place;
    }
    return std::nullopt;
}

double entry_speed(const world::LaneT& lane, const Place& place, double room) {
    constexpr double gentle = 2.5;  // [m/s^2]
    const double free_road = std::min(room, lane.length - place.s);
    return std::min(0.8 * lane.speed_limit, std::sqrt(2 * gentle * std::max(0.0, free_road)));
}

std::vector<Taken> Background::Sumo::taken_ground(const world::TickView& last,
                                                  const world::TickDraft& next) const {
    const auto models = world::vehicle_models();
    std::vector<Taken> taken;
    for (const Car& car : cars)
        taken.push_back({(car.rear + car.trail.front()).head<2>() / 2,
                         car.yaw,
                         models[car.model].length,
                         false});
    for (const world::VehicleState& vehicle : last.vehicles())
        taken.push_back({{vehicle.position().x(), vehicle.position().y()},
                         2 * std::atan2(vehicle.orientation().z(), vehicle.orientation().w()),
                         models[vehicle.model()].length,
                         true});
    // Those that come in this very tick.
    for (const world::CommandT& command : next.tick.commands) {
        const bool comes = command.kind == world::CommandKind::spawn &&
                           command.driver != world::Driver::walker &&
                           command.lane < town.lanes.size();
        if (!comes || command.model >= models.size())
            continue;
        const double length = models[command.model].length;
        Taken ground =
            places.ground({command.lane, command.s + origin_to_front(command.model)}, length);
        ground.length += 20;  // it needs time to look around
        taken.push_back(ground);
    }
    return taken;
}

bool Background::Sumo::add_demand_car(const std::vector<Taken>& taken,
                                      bool first,
                                      world::TickDraft& next) {
    Car car;
    car.id = next_id;
    const double drawn = world::draw(episode.seed, tick, world::Purpose::demand_model, place_draws);
    car.model = demand_model(drawn, at_home);
    const double length = world::vehicle_models()[car.model].length;
    const world::ClassSet classes = model_class(car.model);
    PlaceSearch search{episode.seed,
                       tick,
                       world::Purpose::demand_place,
                       place_draws,
                       first ? 200 : 12,
                       first ? 12.0 : 25.0,
                       first ? 0.0 : 60.0};
    const auto place = find_place(places, length, classes, taken, search);
    place_draws = search.item;
    if (!place)
        return false;
    ++next_id;
    car.speed = entry_speed(town.lanes[place->lane], *place, search.margin / 2);
    walk_from(place->lane, car, graph, classes, episode.seed, planned_route);
    insert_into_sumo(car, *place, demand_type(car.model));

    world::EventT event;
    event.kind = world::EventKind::spawned;
    event.actor = car.id;
    event.position = world::Vec3(car.rear.x(), car.rear.y(), car.rear.z());
    event.text = world::vehicle_models()[car.model].name;
    next.tick.events.push_back(std::move(event));
    cars.push_back(std::move(car));  // ids only grow, and lie above the scenario's
    return true;
}

void Background::Sumo::keep_number(const world::TickView& last, world::TickDraft& next) {
    const auto count = static_cast<std::size_t>(std::count_if(
        cars.begin(), cars.end(), [](const Car& car) { return car.origin == Origin::demand; }));
    if (count >= episode.cars)
        return;
    const bool first = tick == 1;
    std::vector<Taken> taken = taken_ground(last, next);
    std::size_t now = count;
    while (now < episode.cars && add_demand_car(taken, first, next)) {
        ++now;
        const Car& car = cars.back();
        taken.push_back({(car.rear + car.trail.front()).head<2>() / 2,
                         car.yaw,
                         world::vehicle_models()[car.model].length,
                         false});
    }
    if (first && now < episode.cars) {
        world::EventT event;
        event.kind = world::EventKind::printed;
        event.text = fmt::format(
            "traffic: {} cars were asked for, {} has room for {}", episode.cars, town.name, now);
        next.tick.events.push_back(std::move(event));
    }
}

void Background::Sumo::remove_leaving(const world::TickView& last, world::TickDraft& next) {
    const auto patience = static_cast<std::uint32_t>(too_long / step);
    for (std::size_t i = cars.size(); i-- > 0;) {
        Car& car = cars[i];
        if (car.origin != Origin::demand || car.lane == none)
            continue;
        // Where the plan ends, SUMO would take it out in the middle of the next step.
        const double left = town.lanes[car.lane].sumo_length - car.lane_position;
        const bool arrives = car.dead_end && car.route.size() == 1 &&
                             car.route.front() == graph.edge_of(car.lane) &&
                             left < 2 * step * (car.speed + 1) + 1;
        const bool stuck = car.standing_ticks > patience && !is_seen(car.rear, last, out_of_sight);
        if (!arrives && !stuck)
            continue;
        Vehicle::remove(car.sumo);
        remove(i, next);
    }
}

void Background::Sumo::keep_routes() {
    for (Car& car : cars) {
        if (car.origin == Origin::parked || car.dead_end || car.route.size() > 8)
            continue;
        double left = 0;
        for (const std::uint32_t edge : car.route)
            left += graph.edge(edge).length;
        if (left >= short_plan && car.route.size() > 2)
            continue;
        walk_on(car, graph, classes_of(car), episode.seed, planned_route);
        Vehicle::setRoute(car.sumo, graph.names(car.route));
    }
}

}  // namespace reprise::traffic
