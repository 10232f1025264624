// What it must do: SUMO's cars and signals, one step a tick, as CarState and SignalColor; see
//   background.h.
// What it assumes: ticks come in order; the network's bytes are those that the town was read from.
// How it goes: commands, mirrors, number of cars, routes; one SUMO step; getters in the order of
//   ids (in one process they are the cheapest way to read: 30 ns each).
// What it keeps: a Car for every car that traffic owns, with the plan of its way; the physics
//   vehicles' copies in SUMO.
#include "traffic/background.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <libsumo/libsumo.h>

#include "traffic/background_state.h"
#include "traffic/fleet.h"
#include "world/check.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::none;
using world::SignalColor;

std::vector<world::ClassSet> lane_classes(const world::TownT& town) {
    std::vector<world::ClassSet> classes(town.lanes.size(), 0);
    for (std::size_t i = 0; i < town.lanes.size(); ++i) {
        if (!world::is_for_cars(town.lanes[i]))
            continue;
        const std::vector<std::string> allowed = libsumo::Lane::getAllowed(town.lanes[i].name);
        for (const std::string& name : allowed)
            classes[i] |= world::class_bit(name);
        if (allowed.empty())  // SUMO's way to say: all
            classes[i] = world::permitted("", "");
    }
    return classes;
}

std::vector<bool> lanes_without_neighbours(const world::TownT& town) {
    std::map<std::string_view, int> lanes_of_edge;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind != world::LaneKind::sidewalk)
            ++lanes_of_edge[lane.edge];
    std::vector<bool> alone;
    alone.reserve(town.lanes.size());
    for (const world::LaneT& lane : town.lanes)
        alone.push_back(lanes_of_edge[lane.edge] == 1);
    return alone;
}

/// The way that a front bumper has come to this place: along the lane, straight on before it.
std::vector<Eigen::Vector3d> way_to(const world::LaneT& lane, double s, double length) {
    std::vector<Eigen::Vector3d> way;
    const double start = s - length;
    const world::LanePoint first = world::point_at(lane, std::max(0.0, start));
    if (start < 0)
        way.push_back(first.position + start * Eigen::Vector3d(std::cos(first.yaw),
                                                               std::sin(first.yaw),
                                                               std::tan(first.pitch)));
    constexpr double spacing = 1;
    for (double at = std::max(0.0, start); at < s; at += spacing)
        way.push_back(world::point_at(lane, at).position);
    way.push_back(world::point_at(lane, s).position);
    return way;
}

}  // namespace

Background::Sumo::Sumo(const world::EpisodeT& episode_in,
                       const world::TownT& town_in,
                       const world::LaneMap& lanes,
                       std::string_view network)
    : episode(episode_in),
      town(town_in),
      step(world::seconds(1, episode_in.step_ns)),
      process(episode_in, network),
      graph(town_in, lane_classes(town_in)),
      places(town_in, graph),
      at_home(places.common_classes()),
      mirrors(town_in, lanes, graph, step),
      signals(town_in.signals.size(), SignalColor::off) {
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i)
        lanes_by_name.emplace(town.lanes[i].name, i);
    alone_on_edge = lanes_without_neighbours(town);
    const std::vector<std::string> known = libsumo::TrafficLight::getIDList();
    for (std::size_t i = 0; i < town.signals.size(); ++i) {
        const std::string& name = town.signals[i].program;
        if (std::find(known.begin(), known.end(), name) == known.end())
            continue;
        if (programs.empty() || programs.back().name != name)
            programs.push_back({name, i, 0, ""});
        ++programs.back().count;
    }
}

Car* Background::Sumo::find(std::uint32_t id) {
    const auto at =
        std::lower_bound(cars.begin(), cars.end(), id, [](const Car& car, std::uint32_t key) {
            return car.id < key;
        });
    return at != cars.end() && at->id == id ? &*at : nullptr;
}

Car& Background::Sumo::add(Car car) {
    const auto at =
        std::lower_bound(cars.begin(), cars.end(), car.id, [](const Car& c, std::uint32_t key) {
            return c.id < key;
        });
    return *cars.insert(at, std::move(car));
}

std::uint32_t Background::Sumo::lane_index(std::string_view name) const {
    const auto found = lanes_by_name.find(name);
    return found == lanes_by_name.end() ? none : found->second;
}

world::ClassSet Background::Sumo::classes_of(const Car& car) const {
    return car.origin == Origin::demand ? model_class(car.model) : world::class_bit("passenger");
}

void Background::Sumo::remove(std::size_t index, world::TickDraft& next) {
    world::EventT event;
    event.kind = world::EventKind::despawned;
    event.actor = cars[index].id;
    event.position = world::Vec3(cars[index].rear.x(), cars[index].rear.y(), cars[index].rear.z());
    next.tick.events.push_back(std::move(event));
    cars.erase(cars.begin() + static_cast<std::ptrdiff_t>(index));
}

void Background::Sumo::insert_into_sumo(Car& car, const Place& place, const std::string& type) {
    const world::LaneT& lane = town.lanes[place.lane];
    car.sumo = sumo_id(car.id);
    libsumo::Route::add(car.sumo, graph.names(car.route));
    Vehicle::add(car.sumo, car.sumo, type, "now");
    // Put there by force: SUMO's own insertion waits in a queue for as long as it likes.
    car.lane = place.lane;
    car.lane_position = std::clamp(place.s / lane.length, 0.0, 1.0) * lane.sumo_length;
    Vehicle::moveTo(car.sumo, lane.name, car.lane_position);
    Vehicle::setPreviousSpeed(car.sumo, car.speed);
    car.trail.start(way_to(lane, place.s, origin_to_front(car.model)), origin_to_front(car.model));
    car.rear = car.trail.rear();
    car.sumo_front = car.trail.front();
    car.yaw = world::point_at(lane, place.s).yaw;
}

void Background::Sumo::drop_arrived(world::TickDraft& next) {
    std::vector<std::string> arrived = libsumo::Simulation::getArrivedIDList();
    std::sort(arrived.begin(), arrived.end());
    for (const std::string& name : arrived) {
        std::uint32_t id = 0;  // our own, written as a number
        std::from_chars(name.data(), name.data() + name.size(), id);
        if (const Car* car = find(id))
            remove(static_cast<std::size_t>(car - cars.data()), next);
        else
            mirrors.forget(id);
    }
}

Background::Background(const world::EpisodeT& episode,
                       const world::TownT& town,
                       const world::LaneMap& lanes,
                       std::string_view network)
    : sumo_(std::make_unique<Sumo>(episode, town, lanes, network)) {}

Background::~Background() = default;

void Background::advance(const world::TickView& last, world::TickDraft& next) {
    sumo_->tick = last.index() + 1;

    // What the scenario says, then who leaves, then who comes.
    sumo_->carry_out(last, next);
    sumo_->remove_leaving(last, next);
    sumo_->keep_number(last, next);

    // Everybody's way and speed, and the physics vehicles where they will be.
    sumo_->keep_routes();
    sumo_->follow_orders();
    sumo_->mirrors.advance(last, sumo_->cars);

    libsumo::Simulation::step();

    // What came of it.
    sumo_->drop_arrived(next);
    sumo_->read_cars();
    sumo_->read_signals(next);
    sumo_->write_cars(next);
}

std::uint64_t Background::digest() const {
    return sumo_->digest();
}

}  // namespace reprise::traffic
