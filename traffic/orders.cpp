#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "traffic/background_state.h"
#include "traffic/fleet.h"
#include "traffic/walk.h"
#include "world/check.h"
#include "world/models/catalogue.h"
#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::CommandKind;
using world::none;

// Bits of SUMO's speed mode: 1 keeps a safe gap, 8 gives way, 16 stops at red. Left out are 2 and
// 4, the limits of acceleration: the ramp below keeps its own, so that a duration is kept exactly.
constexpr int obeys_but_hits_nobody = 1 + 8 + 16;
constexpr int sumo_default_speed_mode = 31;

// SUMO's lane change mode of scripted cars: 1 changes lanes where the route asks for it and no
// order speaks against it; 256 carries an order out as soon as nobody is hit by it. No changes for
// speed, courtesy or the keep-right rule: a scenario's car stays where it was put.
constexpr int changes_as_told = 1 + 256;

constexpr double hardest_braking = 9;     // [m/s^2] a dry road's limit
constexpr double hardest_starting = 4.5;  // [m/s^2] a quick car

[[noreturn]] void fail(const world::EpisodeT& episode,
                       const world::CommandT& command,
                       const std::string& what) {
    throw world::Error(fmt::format("{}:{}: {}", episode.scenario_path, command.line, what));
}

/// Does a parked car stand in the way of a car that drives in the middle of the lane?
bool stands_in_the_way(const world::LaneT& lane, const world::VehicleModel& model, double offset) {
    constexpr double half_car = 1.0;
    return world::is_for_cars(lane) && std::abs(offset) - model.width / 2 < half_car;
}

}  // namespace

void Background::Sumo::carry_out(const world::TickView& last, world::TickDraft& next) {
    for (const world::CommandT& command : next.tick.commands) {
        if (command.kind == CommandKind::spawn) {
            if (command.driver == world::Driver::traffic || command.driver == world::Driver::parked)
                spawn(command, last, next);
            continue;
        }
        Car* car = find(command.actor);
        if (car == nullptr || command.actor >= world::first_background_id)
            continue;  // somebody else's actor
        if (command.kind == CommandKind::despawn) {
            if (!car->sumo.empty())
                Vehicle::remove(car->sumo);
            remove(static_cast<std::size_t>(car - cars.data()), next);
        } else if (car->origin == Origin::scripted) {
            order(command, *car);
        }
    }
}

void Background::Sumo::spawn(const world::CommandT& command,
                             const world::TickView& last,
                             world::TickDraft& next) {
    const auto models = world::vehicle_models();
    REPRISE_CHECK(command.model < models.size() && find(command.actor) == nullptr,
                  fmt::format("actor {} model {} tick {}", command.actor, command.model, tick));
    const world::VehicleModel& model = models[command.model];
    const bool parked = command.driver == world::Driver::parked;

    Car car;
    car.id = command.actor;
    car.model = command.model;
    car.origin = parked ? Origin::parked : Origin::scripted;
    car.speed = parked ? 0 : command.speed;

    // Where: the command's s is the origin's, as for every vehicle; SUMO wants the front bumper.
    Place place{command.lane, command.s + origin_to_front(command.model)};
    if (command.lane == none) {
        PlaceSearch search{episode.seed,
                           tick,
                           world::Purpose::place,
                           std::uint64_t{command.actor} << 16U,
                           400,
                           20,
                           40};
        const auto found = find_place(
            places, model.length, world::class_bit("passenger"), taken_ground(last, next), search);
        if (!found)
            fail(episode, command, fmt::format("spawn: no free place for a {}", model.name));
        place = *found;
    } else if (place.lane >= town.lanes.size()) {
        fail(episode, command, fmt::format("spawn: no lane of index {}", place.lane));
    }
    const world::LaneT& lane = town.lanes[place.lane];
    const bool on_road = world::is_for_cars(lane) && graph.edge_of(place.lane) != none;
    if (!parked && !on_road)
        fail(episode, command, fmt::format("spawn: lane '{}' is not for cars", lane.name));

    // Background cars that are in the way give up their places.
    const Place ground{place.lane, std::min(place.s, lane.length)};
    for (std::size_t i = cars.size(); i-- > 0;) {
        const Taken other{(cars[i].rear + cars[i].trail.front()).head<2>() / 2,
                          cars[i].yaw,
                          models[cars[i].model].length,
                          false};
        if (cars[i].origin == Origin::demand &&
            !places.is_free(ground, model.length, std::vector{other}, 2, 0)) {
            Vehicle::remove(cars[i].sumo);
            remove(i, next);
        }
    }

    if (!parked || (on_road && stands_in_the_way(lane, model, command.offset))) {
        walk_from(
            place.lane, car, graph, world::class_bit("passenger"), episode.seed, planned_route);
        insert_into_sumo(car, ground, scripted_type(car.model));
        Vehicle::setLaneChangeMode(car.sumo, parked ? 0 : changes_as_told);
        if (parked) {
            Vehicle::setSpeedMode(car.sumo, 0);
            Vehicle::setSpeed(car.sumo, 0);
        }
    }
    if (parked) {
        const world::LanePoint at = world::point_at(lane, place.s - origin_to_front(car.model));
        const Eigen::Vector3d left(-std::sin(at.yaw), std::cos(at.yaw), 0);
        car.lane = place.lane;
        car.lane_position = std::min(place.s / lane.length, 1.0) * lane.sumo_length;
        car.rear = at.position + left * command.offset;
        car.yaw = at.yaw;
        car.pitch = at.pitch;
        const double length = origin_to_front(car.model);
        const Eigen::Vector3d behind(-std::cos(at.yaw), -std::sin(at.yaw), -std::tan(at.pitch));
        car.trail.start(car.rear - behind * length, behind, length);
    }
    world::EventT event;
    event.kind = world::EventKind::spawned;
    event.actor = car.id;
    event.position = world::Vec3(car.rear.x(), car.rear.y(), car.rear.z());
    event.text = command.text;
    event.line = command.line;
    next.tick.events.push_back(std::move(event));
    add(std::move(car));
}

void Background::Sumo::order(const world::CommandT& command, Car& car) {
    switch (command.kind) {
        case CommandKind::set_speed: {
            // Changed evenly over the duration, and never faster than a car can.
            const double change = command.speed - car.speed;
            const double limit = change < 0 ? hardest_braking : hardest_starting;
            const double seconds = std::max(command.duration, std::abs(change) / limit);
            const auto ticks = static_cast<std::uint64_t>(std::ceil(seconds / step - 1e-9));
            car.speed_order = SpeedOrder{car.speed, command.speed, tick - 1, ticks};
            Vehicle::setSpeedMode(car.sumo, obeys_but_hits_nobody);
            break;
        }
        case CommandKind::free_speed:
            car.speed_order.reset();
            Vehicle::setSpeed(car.sumo, -1);
            Vehicle::setSpeedMode(car.sumo, sumo_default_speed_mode);
            break;
        case CommandKind::change_lane: {
            constexpr double patience = 15;  // [s] to find a gap
            if (command.lanes.empty())
                break;
            const auto wait = static_cast<std::uint64_t>((patience + command.duration) / step);
            car.lane_order = LaneOrder{command.lanes.front(), command.duration, tick + wait};
            break;
        }
        case CommandKind::set_route: {
            // From here through all of them; what cannot be reached ends the route there.
            std::vector<std::uint32_t> route{car.route.front()};
            for (const std::uint32_t lane : command.lanes) {
                const std::uint32_t edge = graph.edge_of(lane);
                if (edge == none)
                    continue;
                const std::vector<std::uint32_t> way = graph.shortest(route.back(), edge);
                if (way.empty())
                    fail(episode,
                         command,
                         fmt::format("set_route: no way to lane '{}'", town.lanes[lane].name));
                route.insert(route.end(), way.begin() + 1, way.end());
                car.last_lane = lane;
            }
            if (route.size() < 2)
                break;
            car.route = route;
            walk_on(car, graph, world::class_bit("passenger"), episode.seed, planned_route);
            Vehicle::setRoute(car.sumo, graph.names(car.route));
            break;
        }
        default:
            break;
    }
}

void Background::Sumo::follow_orders() {
    for (Car& car : cars) {
        if (car.speed_order) {
            const SpeedOrder& order = *car.speed_order;
            const std::uint64_t done = std::min(tick - order.start, order.ticks);
            const double share =
                order.ticks == 0 ? 1 : static_cast<double>(done) / static_cast<double>(order.ticks);
            Vehicle::setSpeed(car.sumo, order.from + (order.to - order.from) * share);
        }
        if (!car.lane_order || car.lane == none)
            continue;
        const world::LaneT& target = town.lanes[car.lane_order->lane];
        const world::LaneT& here = town.lanes[car.lane];
        if (car.lane == car.lane_order->lane || tick > car.lane_order->until) {
            // From its new lane it may need another way.
            if (car.lane == car.lane_order->lane) {
                walk_from(car.lane,
                          car,
                          graph,
                          world::class_bit("passenger"),
                          episode.seed,
                          planned_route);
                Vehicle::setRoute(car.sumo, graph.names(car.route));
            }
            car.lane_order.reset();
        } else if (target.edge == here.edge) {
            const double width = (target.width + here.width) / 2;
            Vehicle::setMaxSpeedLat(car.sumo, width / std::max(car.lane_order->duration, 1.0));
            Vehicle::changeLane(car.sumo, target.index, 1.0);
        }
    }
}

}  // namespace reprise::traffic
