#include "traffic/orders.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "world/check.h"
#include "world/lanes/planner.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::CommandKind;
using world::none;

// Bits of SUMO's speed mode: 1 keeps a safe gap, 8 gives way, 16 stops at red. Left out are 2 and
// 4, the limits of acceleration: the ramp below keeps its own, so that a duration is kept exactly.
constexpr int obeys_but_hits_nobody = 1 + 8 + 16;
constexpr int sumo_default_speed_mode = 31;
constexpr int gives_way = 8;
constexpr int stops_at_red = 16;
constexpr int limits_braking = 4;
constexpr int keeps_safe_gap = 1;
// No bit but 32: inside junctions, too, nobody goes first.
constexpr int reacts_to_nothing = 32;

constexpr double hardest_braking = 9;     // [m/s^2] a dry road's limit
constexpr double hardest_starting = 4.5;  // [m/s^2] a quick car
constexpr double comfort_aside = 1.5;     // [m/s^2] of one who is told an offset and no time
constexpr double quick_aside = 4;         // [m/s^2]

/// Is the next light one that says: stop?
bool comes_to_a_red_light(const Car& car) {
    const auto lights = Vehicle::getNextTLS(car.sumo);
    return !lights.empty() &&
           std::string_view("rRuyYs").find(lights.front().state) != std::string_view::npos;
}

int speed_mode(const Car& car) {
    if (car.speed_order && !car.speed_order->reacts)
        return reacts_to_nothing;
    int mode = car.speed_order ? obeys_but_hits_nobody : sumo_default_speed_mode;
    if (car.goes_first || (car.ignores_lights && comes_to_a_red_light(car)))
        mode &= ~(stops_at_red + gives_way);
    return mode;
}

}  // namespace

Orders::Orders(const world::EpisodeT& episode,
               const world::TownT& town,
               const RoadGraph& graph,
               const RoutePlanner& routes)
    : episode_(&episode),
      town_(&town),
      graph_(&graph),
      routes_(&routes),
      step_(world::seconds(1, episode.step_ns)) {}

void Orders::give(const world::CommandT& command, Car& car, std::uint64_t tick) const {
    switch (command.kind) {
        case CommandKind::set_speed:
            take_speed(command, car, tick);
            break;
        case CommandKind::free_speed:
            free_speed(car);
            break;
        case CommandKind::hold_speed:
            if (command.on)
                take_speed(command, car, tick);
            else if (car.speed_order && !car.speed_order->reacts && !car.speed_order->brakes)
                free_speed(car);
            break;
        case CommandKind::brake:
            if (command.on)
                take_braking(command, car, tick);
            else if (car.speed_order && car.speed_order->brakes)
                free_speed(car);
            break;
        case CommandKind::set_offset:
            take_offset(command, car, tick);
            break;
        case CommandKind::ignore_lights:
            car.ignores_lights = command.on;
            Vehicle::setSpeedMode(car.sumo, speed_mode(car));
            break;
        case CommandKind::change_lane:
            take_lane(command, car, tick);
            break;
        case CommandKind::set_route:
            take_route(command, car);
            break;
        default:
            break;
    }
}

void Orders::release(Car& car, std::uint64_t tick) const {
    if (car.speed_order) {
        const bool brakes = car.speed_order->brakes;
        world::CommandT command;
        command.kind = car.speed_order->reacts ? CommandKind::set_speed : CommandKind::hold_speed;
        command.speed = std::max(car.speed_order->to, 0.0);
        take_speed(command, car, tick);
        car.speed_order->brakes = brakes;
        return;
    }
    Vehicle::setSpeed(car.sumo, -1);
    Vehicle::setSpeedMode(car.sumo, speed_mode(car));
}

/// Changed evenly over the duration, and never faster than a car can.
void Orders::take_speed(const world::CommandT& command, Car& car, std::uint64_t tick) const {
    const double change = command.speed - car.speed;
    const double limit = change < 0 ? hardest_braking : hardest_starting;
    const double seconds = std::max(command.duration, std::abs(change) / limit);
    const auto ticks = static_cast<std::uint64_t>(std::ceil(seconds / step_ - 1e-9));
    const bool reacts = command.kind != CommandKind::hold_speed;
    const world::Shape shape = command.duration > 0 ? command.shape : world::Shape::linear;
    car.speed_order = SpeedOrder{car.speed, command.speed, tick - 1, ticks, shape, reacts};
    Vehicle::setSpeedMode(car.sumo, speed_mode(car));
}

/// Evenly, and to the end of a tick.
void Orders::take_braking(const world::CommandT& command, Car& car, std::uint64_t tick) const {
    const double seconds = car.speed / command.deceleration;
    const auto ticks = static_cast<std::uint64_t>(std::ceil(seconds / step_ - 1e-9));
    // Beyond standing, so that the last tick's share is no weaker than the others.
    const double to = car.speed - command.deceleration * static_cast<double>(ticks) * step_;
    car.speed_order = SpeedOrder{car.speed, to, tick - 1, ticks, world::Shape::linear, false, true};
    Vehicle::setSpeedMode(car.sumo, speed_mode(car));
}

void Orders::take_offset(const world::CommandT& command, Car& car, std::uint64_t tick) const {
    const double far = std::abs(command.offset - car.offset);
    const bool quick = command.shape == world::Shape::step;
    double seconds = command.duration;
    if (seconds <= 0)
        seconds = std::numbers::pi * std::sqrt(far / (2 * (quick ? quick_aside : comfort_aside)));
    car.offset_order = OffsetOrder{{car.offset, command.offset, seconds, command.shape}, tick - 1};
}

void Orders::free_speed(Car& car) const {
    car.speed_order.reset();
    Vehicle::setSpeed(car.sumo, -1);
    Vehicle::setSpeedMode(car.sumo, speed_mode(car));
}

double Orders::ordered_speed(const Car& car, std::uint64_t tick) const {
    const SpeedOrder& order = *car.speed_order;
    const std::uint64_t done = std::min(tick - order.start, order.ticks);
    if (order.shape == world::Shape::linear) {
        const double share =
            order.ticks == 0 ? 1 : static_cast<double>(done) / static_cast<double>(order.ticks);
        return std::max(order.from + (order.to - order.from) * share, 0.0);
    }
    const world::Transition change{
        order.from, order.to, static_cast<double>(order.ticks) * step_, order.shape};
    return std::max(change.value(static_cast<double>(done) * step_), 0.0);
}

int Orders::braking_mode(const Car& car) const {
    // Who passes something through the oncoming lane drives, to SUMO, through it.
    const bool drives_through = car.pass && !car.pass->joins;
    return speed_mode(car) & ~(limits_braking + (drives_through ? keeps_safe_gap : 0));
}

void Orders::let_go(const Car& car, std::uint64_t tick) const {
    Vehicle::setSpeed(car.sumo, car.speed_order ? ordered_speed(car, tick) : -1);
    Vehicle::setSpeedMode(car.sumo, speed_mode(car));
}

void Orders::take_lane(const world::CommandT& command, Car& car, std::uint64_t tick) const {
    constexpr double patience = 15;  // [s] to find a gap
    if (!world::names_lane(command)) {
        keep_lane(car, !command.lanes.empty());
        return;
    }
    const auto wait = static_cast<std::uint64_t>((patience + command.duration) / step_);
    car.lane_order = LaneOrder{command.lanes.front(), command.duration, tick + wait};
}

/// Its route may need another lane: then it goes another way.
void Orders::keep_lane(Car& car, bool keep) const {
    car.keeps_lane = keep;
    Vehicle::setLaneChangeMode(car.sumo, keep ? carries_orders_out : changes_as_told);
    if (car.lane == none || graph_->edge_of(car.lane) == none)
        return;
    routes_->start(car.lane, car);
    routes_->send(car);
}

/// Edges from here through all of the lanes. The last of them becomes last_lane.
std::vector<std::uint32_t> Orders::way_to(const world::CommandT& command, Car& car) const {
    std::vector<std::uint32_t> route{car.route.front()};
    // Inside a junction it is decided where it comes out: SUMO refuses a way that leads elsewhere.
    if (car.lane != none && graph_->edge_after(car.lane) != graph_->edge_of(car.lane))
        route.push_back(graph_->edge_after(car.lane));
    for (const std::uint32_t lane : command.lanes) {
        const std::uint32_t edge = graph_->edge_of(lane);
        if (edge == none)
            continue;
        const std::vector<std::uint32_t> way = graph_->shortest(route.back(), edge);
        if (way.empty())
            throw world::Error(fmt::format("{}:{}: set_route: no way to lane '{}'",
                                           episode_->scenario_path,
                                           command.line,
                                           town_->lanes[lane].name));
        route.insert(route.end(), way.begin() + 1, way.end());
        car.last_lane = lane;
    }
    return route;
}

/// Likewise for one who keeps its lane.
std::vector<std::uint32_t> Orders::way_on_lane(const world::CommandT& command, Car& car) const {
    const world::Planner planner(*town_, world::LaneChanges::forbidden);
    std::vector<std::uint32_t> route{car.route.front()};
    world::LanePlace from{car.lane, 0};
    for (const std::uint32_t lane : command.lanes) {
        const auto way = planner.plan(from, {lane, town_->lanes[lane].length});
        if (!way)
            throw world::Error(
                fmt::format("{}:{}: set_route: no way leads from lane '{}' to lane '{}' without a "
                            "change of lanes",
                            episode_->scenario_path,
                            command.line,
                            town_->lanes[from.lane].name,
                            town_->lanes[lane].name));
        for (const std::uint32_t next : world::driving_lanes(*town_, *way))
            if (graph_->edge_of(next) != route.back())
                route.push_back(graph_->edge_of(next));
        from = {lane, 0};
        car.last_lane = lane;
    }
    return route;
}

/// From here through all of the lanes, and on from the last one.
void Orders::take_route(const world::CommandT& command, Car& car) const {
    const std::vector<std::uint32_t> route =
        car.keeps_lane && car.lane != none ? way_on_lane(command, car) : way_to(command, car);
    if (route.size() < 2)
        return;
    car.route = route;
    car.stops.clear();
    for (const std::uint32_t lane : command.lanes)
        car.stops.push_back(graph_->edge_of(lane));
    routes_->extend(car);
    routes_->send(car);
}

void Orders::follow_lane_order(Car& car,
                               const std::function<bool(const Car&)>& may_change,
                               std::uint64_t tick) const {
    const LaneOrder& order = *car.lane_order;
    const bool is_there = car.lane == order.lane;
    if (is_there || tick > order.until) {
        if (is_there) {  // from its new lane it may need another way
            routes_->start(car.lane, car);
            routes_->send(car);
        }
        car.lane_order.reset();
        return;
    }
    const world::LaneT& target = town_->lanes[order.lane];
    const world::LaneT& here = town_->lanes[car.lane];
    // Within a time it is changed at once, else when there is room.
    if (target.edge != here.edge || (order.duration == 0 && !may_change(car)))
        return;
    Vehicle::changeLane(car.sumo, static_cast<int>(graph_->index_of(order.lane)), 1.0);
}

/// On a lane that does not lead to the next edge?
bool Orders::is_off_its_route(const Car& car) const {
    return car.lane != none && car.route.size() > 1 &&
           town_->lanes[car.lane].kind == world::LaneKind::driving &&
           graph_->edge_of(car.lane) == car.route.front() &&
           !graph_->leads_to(car.lane, car.route[1]);
}

/// It stands at the end of its lane, where nothing but a jump to the next one would help: then it
/// goes where its lane leads.
bool Orders::waits_in_the_wrong_lane(const Car& car) const {
    constexpr std::uint32_t patience = 40;  // ticks
    constexpr double end = 15;              // [m]
    return car.standing_ticks > patience && car.lane != none &&
           car.lane_position > town_->lanes[car.lane].sumo_length - end;
}

void Orders::follow(Cars& cars,
                    const std::function<bool(const Car&)>& may_change,
                    std::uint64_t tick) const {
    for (Car& car : cars.all()) {
        if (car.sumo.empty())
            continue;
        if (car.ignores_lights)
            Vehicle::setSpeedMode(car.sumo, speed_mode(car));
        if (car.speed_order && car.held_in != tick)
            Vehicle::setSpeed(car.sumo, ordered_speed(car, tick));
        if (car.lane_order && car.lane != none)
            follow_lane_order(car, may_change, tick);
        else if ((car.keeps_lane || waits_in_the_wrong_lane(car)) && is_off_its_route(car)) {
            routes_->start(car.lane, car);
            routes_->send(car);
        }
    }
}

}  // namespace reprise::traffic
