// What it must do: SUMO's cars and signals, one step a tick, as CarState and SignalColor; see
//   background.h.
// What it assumes: ticks come in order; the network's bytes are those that the town was read from.
// How it goes: commands, mirrors, number of cars, routes; one SUMO step; getters in the order of
//   ids (in one process they are the cheapest way to read: 30 ns each).
// What it keeps: a Car for every car that traffic owns, with its route; the physics vehicles'
//   copies in SUMO.
#include "traffic/background.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include <libsumo/libsumo.h>

#include "traffic/blue_lamps.h"
#include "traffic/car_reader.h"
#include "traffic/cars/bends.h"
#include "traffic/cars/cars.h"
#include "traffic/cars/decisions.h"
#include "traffic/demand.h"
#include "traffic/detours.h"
#include "traffic/insertion.h"
#include "traffic/insertion_points.h"
#include "traffic/lookout.h"
#include "traffic/mirrors.h"
#include "traffic/orders.h"
#include "traffic/placements.h"
#include "traffic/rescue_lane.h"
#include "traffic/roads/car_network.h"
#include "traffic/roads/right_of_way.h"
#include "traffic/roads/road_graph.h"
#include "traffic/route_planner.h"
#include "traffic/scripted_spawns.h"
#include "traffic/sight/lane_change_pace.h"
#include "traffic/signal_orders.h"
#include "traffic/signal_programs.h"
#include "traffic/standoffs.h"
#include "traffic/sumo.h"
#include "world/digest.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

namespace {

/// Of SUMO, which runs by now: who may use each of the town's lanes.
std::vector<world::ClassSet> lane_classes(const world::TownT& town) {
    std::vector<world::ClassSet> classes(town.lanes.size(), 0);
    const std::vector<bool> is_known = lanes_in_sumo(town);
    for (std::size_t i = 0; i < town.lanes.size(); ++i) {
        if (!world::is_for_cars(town.lanes[i]) || !is_known[i])
            continue;
        const std::vector<std::string> allowed = libsumo::Lane::getAllowed(town.lanes[i].name);
        for (const std::string& name : allowed)
            classes[i] |= world::class_bit(name);
        if (allowed.empty())  // SUMO's way to say: all
            classes[i] = world::permitted("", "");
    }
    return classes;
}

}  // namespace

/// All that is kept from tick to tick, each by its owner, in the order of construction.
struct Background::Parts {
    Parts(const world::EpisodeT& episode,
          const world::TownT& town,
          const world::LaneMap& lanes,
          std::string_view network)
        : process(episode, network_for_cars(network, town)),
          graph(town, lane_classes(town)),
          right_of_way(right_of_way_in_sumo(town)),
          points(town, graph),
          routes(graph, episode.seed),
          detours(town, graph, routes, world::seconds(1, episode.step_ns)),
          insertion(town, graph, routes),
          demand(episode, town, graph, right_of_way, points, insertion),
          placements(episode, town, lanes, graph, routes, insertion),
          spawns(episode, town, graph, points, insertion, placements),
          orders(episode, town, graph, routes),
          lookout(episode, town, lanes, graph, right_of_way, orders),
          decisions(town, world::seconds(1, episode.step_ns)),
          standoffs(town, graph, right_of_way, world::seconds(1, episode.step_ns)),
          bends(town),
          lane_change_pace(town),
          mirrors(town, lanes, graph, world::seconds(1, episode.step_ns)),
          rescue_lane(town, lanes, graph, world::seconds(1, episode.step_ns)),
          blue_lamps(town, lanes, graph, orders, world::seconds(1, episode.step_ns)),
          reader(town, graph, world::seconds(1, episode.step_ns), episode.seed),
          signal_orders(town),
          signals(town),
          step_ns(episode.step_ns) {}

    void carry_out(const world::TickView& last, world::TickDraft& next);
    void give(const world::CommandT& command, Car& car, std::uint64_t tick);
    std::vector<world::VehicleState> place(std::uint64_t tick);
    std::vector<std::uint32_t> hand_over(const world::TickView& last);
    void drop_arrived(world::TickDraft& next);
    std::uint64_t digest_of_kept() const;

    SumoProcess process;
    RoadGraph graph;
    RightOfWay right_of_way;
    InsertionPoints points;
    RoutePlanner routes;
    Detours detours;
    Insertion insertion;
    Demand demand;
    Placements placements;
    ScriptedSpawns spawns;
    Orders orders;
    Lookout lookout;
    Decisions decisions;
    Standoffs standoffs;
    Bends bends;
    LaneChangePace lane_change_pace;
    Mirrors mirrors;
    RescueLane rescue_lane;
    BlueLamps blue_lamps;
    CarReader reader;
    SignalOrders signal_orders;
    SignalPrograms signals;
    Cars cars;
    std::uint64_t step_ns;
    std::uint64_t kept = 0;  ///< the digest of all that is kept, before SUMO's last step
};

/// The scenario's commands for cars that traffic owns.
void Background::Parts::carry_out(const world::TickView& last, world::TickDraft& next) {
    using world::CommandKind;
    for (const world::CommandT& command : next.tick.commands) {
        if (command.kind == CommandKind::spawn) {
            if (command.driver == world::Driver::traffic || command.driver == world::Driver::parked)
                spawns.spawn(command, cars, last, next);
            else if (command.driver != world::Driver::walker)
                spawns.make_room_for(command, cars, next);
            continue;
        }
        if (command.kind == CommandKind::set_signal) {
            signal_orders.give(command, step_ns, next.tick.index);
            continue;
        }
        if (command.kind == CommandKind::teleport && command.driver != world::Driver::walker)
            spawns.make_room_for(command, cars, next);
        Car* car = cars.find(command.actor);
        if (car == nullptr || command.actor >= world::first_background_id)
            continue;  // somebody else's actor
        if (command.kind == CommandKind::despawn)
            cars.remove_from_sumo(static_cast<std::size_t>(car - cars.all().data()), next);
        else if (car->origin == Origin::scripted)
            give(command, *car, next.tick.index);
    }
}

void Background::Parts::give(const world::CommandT& command, Car& car, std::uint64_t tick) {
    using world::CommandKind;
    if (command.kind == CommandKind::follow || command.kind == CommandKind::teleport ||
        command.kind == CommandKind::set_velocity)
        placements.give(command, car, tick);
    else if (car.sumo.empty())
        car.waiting.push_back(command);
    else
        orders.give(command, car, tick);
}

/// Cars that are where the scenario says, and those that SUMO drives again, with the orders that
/// waited for it.
std::vector<world::VehicleState> Background::Parts::place(std::uint64_t tick) {
    std::vector<std::uint32_t> freed;
    auto beside_sumo = placements.advance(cars, tick, freed);
    for (const std::uint32_t id : freed)
        orders.release(*cars.find(id), tick);
    for (Car& car : cars.all()) {
        if (car.sumo.empty() || car.waiting.empty())
            continue;
        for (const world::CommandT& command : std::exchange(car.waiting, {}))
            orders.give(command, car, tick);
    }
    return beside_sumo;
}

/// Cars that something has hit are vehicles with mass by now. Returns their ids, sorted.
std::vector<std::uint32_t> Background::Parts::hand_over(const world::TickView& last) {
    std::vector<std::uint32_t> wrecks;
    for (const world::VehicleState& vehicle : last.vehicles())
        if (const Car* car = cars.find(vehicle.id())) {
            wrecks.push_back(vehicle.id());
            cars.hand_over(static_cast<std::size_t>(car - cars.all().data()));
        }
    return wrecks;
}

/// SUMO takes vehicles out at the end of their routes.
void Background::Parts::drop_arrived(world::TickDraft& next) {
    std::vector<std::string> arrived = libsumo::Simulation::getArrivedIDList();
    std::sort(arrived.begin(), arrived.end());
    for (const std::string& name : arrived) {
        std::uint32_t id = 0;  // our own, written as a number
        std::from_chars(name.data(), name.data() + name.size(), id);
        const Car* car = cars.find(id);
        if (car != nullptr && car->sumo == name)
            cars.remove(static_cast<std::size_t>(car - cars.all().data()), next);
        else
            mirrors.forget(name);
    }
}

Background::Background(const world::EpisodeT& episode,
                       const world::TownT& town,
                       const world::LaneMap& lanes,
                       std::string_view network)
    : parts_(std::make_unique<Parts>(episode, town, lanes, network)) {}

Background::~Background() = default;

void Background::advance(const world::TickView& last, world::TickDraft& next, const Both& both) {
    Parts& parts = *parts_;

    const std::vector<std::uint32_t> wrecks = parts.hand_over(last);

    // What the scenario says, then who leaves, then who comes.
    parts.carry_out(last, next);
    parts.demand.remove_leaving(parts.cars, last, next);
    parts.demand.fill_up(parts.cars, last, next);

    // Everybody's route and speed, and the physics vehicles where they will be.
    const auto beside_sumo = parts.place(next.tick.index);
    parts.detours.take(parts.cars, next.tick.index);
    parts.routes.keep_ahead(parts.cars);
    parts.lookout.look(last, parts.cars);
    const auto may_change = [&](const Car& car) {
        return parts.lane_change_pace.is_clear(car, parts.lookout.obstructions());
    };
    parts.orders.follow(parts.cars, may_change, next.tick.index);
    parts.bends.follow(parts.cars);
    parts.lane_change_pace.follow(parts.cars, parts.lookout.obstructions(), next.tick.index);
    parts.rescue_lane.advance(last, parts.cars, parts.mirrors, next.tick.index);
    parts.blue_lamps.advance(last, parts.cars, next.tick.index);
    parts.standoffs.hold(parts.cars, next.tick.index);
    parts.lookout.advance(last, parts.cars, next.tick.index);
    parts.standoffs.advance(last, parts.cars, next.tick.index);
    parts.decisions.follow(parts.cars);
    parts.signal_orders.follow(next.tick.index);
    parts.mirrors.advance(last, parts.cars.all(), beside_sumo, wrecks);

    both([] { libsumo::Simulation::step(); },
         [&] {
             parts.kept = parts.digest_of_kept();
             parts.lookout.meet(parts.cars, next.tick.index);
         });

    // What came of it.
    parts.drop_arrived(next);
    const std::span<Car> cars = parts.cars.all();
    both([&] { parts.reader.read(cars.first(cars.size() / 2), next.tick.index); },
         [&] { parts.reader.read(cars.subspan(cars.size() / 2), next.tick.index); });
    parts.signals.read(next);
    parts.reader.write(parts.cars, last, next);
}

void Background::look_ahead(std::uint64_t tick) {
    parts_->lookout.look_ahead(parts_->cars, tick);
}

bool Background::are_many() const {
    constexpr std::size_t many = 30;
    return parts_->cars.size() >= many;
}

/// 10 us with 100 cars, while SUMO makes its step.
std::uint64_t Background::Parts::digest_of_kept() const {
    world::Hasher hasher;
    cars.add_to(hasher);
    demand.add_to(hasher);
    signals.add_to(hasher);
    signal_orders.add_to(hasher);
    mirrors.add_to(hasher);
    lookout.add_to(hasher);
    rescue_lane.add_to(hasher);
    return hasher.digest64();
}

std::uint64_t Background::digest() const {
    world::Hasher hasher;
    hasher.add(parts_->kept);
    parts_->cars.add_motions_to(hasher);
    return hasher.digest64();
}

}  // namespace reprise::traffic
