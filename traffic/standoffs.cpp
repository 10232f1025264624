#include "traffic/standoffs.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/sight/braking.h"
#include "traffic/sight/way_ahead.h"
#include "traffic/sumo.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

constexpr double patience = 12;    // [s] for the first of several; as much again for each other
constexpr double place = 35;       // [m] a junction with the ends of its roads
constexpr double at_the_line = 3;  // [m] before the end of its lane
constexpr double has_stopped = 2;  // [s]
constexpr double halt = 0.3;       // [m/s]
constexpr double starved = 30;     // [s] without a gap, until who comes lets him in,
constexpr double asks_again = 60;  // [s] and from there on anew,
constexpr double has_come = 15;    // [s] of this, if some wait for him already,
constexpr double sight = 120;      // [m] from wherever he comes, or as he needs to stop
constexpr double easily = 2;       // [m/s^2] and brakes no harder,
constexpr double reaction = 1;     // [s]
constexpr std::uint64_t lets_in_for = 60;  // [ticks]
constexpr const char* ignored = "junctionModel.ignoreIDs";

/// [m] that one needs to stop easily at his line.
double way_to_stop(const Car& car) {
    return car.speed * (reaction + car.speed / (2 * easily)) + at_the_line;
}

}  // namespace

/// At the front of its lane, or in a junction; not at a light.
bool Standoffs::waits(const Car& car) const {
    if (car.origin != Origin::demand || car.sumo.empty() || car.lane == world::none ||
        car.stuck_ticks * step_ < patience)
        return false;
    const world::LaneT& lane = town_->lanes[car.lane];
    if (lane.kind == world::LaneKind::internal)
        return true;
    const auto& links = lane.links;
    return lane.sumo_length - car.lane_position < at_the_line &&
           std::all_of(links.begin(), links.end(), [](const world::Link& link) {
               return link.signal() == world::none;
           });
}

bool Standoffs::is_through(const Car& car) const {
    return car.lane == world::none ||
           (town_->lanes[car.lane].kind != world::LaneKind::internal &&
            (car.lane_position > world::vehicle_models()[car.model].length ||
             car.standing_ticks == 0) &&
            car.speed > 2);
}

/// On its way through this place: nobody drives into who stands before him. Routes are long and
/// come by again: who comes from a road that is one for later stands beside.
bool Standoffs::is_ahead(const Car& other, const Car& car) const {
    if (other.lane == world::none)
        return false;
    const std::uint32_t edge = graph_->edge_of(other.lane);
    double driven = 0;  // [m] behind the current edge
    for (std::size_t i = 0; i < car.route.size() && driven < place; ++i) {
        if (car.route[i] == edge)
            return true;
        driven += i > 0 ? graph_->edge(car.route[i]).length : 0;
    }
    return false;
}

std::string Standoffs::standing_near(const Car& car,
                                     const world::TickView& last,
                                     const Cars& cars) const {
    std::string names;
    for (const Car& other : cars.all())
        if (other.id != car.id && !other.sumo.empty() && !is_ahead(other, car) &&
            other.stuck_ticks * step_ > has_stopped &&
            (other.rear - car.rear).head<2>().norm() < place)
            names += other.sumo + ' ';
    for (const world::VehicleState& vehicle : last.vehicles())
        if (std::hypot(vehicle.velocity().x(), vehicle.velocity().y()) < halt &&
            std::hypot(vehicle.position().x() - car.rear.x(),
                       vehicle.position().y() - car.rear.y()) < place)
            for (const char* suffix : {"", "f", "w"})  // see Mirrors::advance
                names += sumo_id(vehicle.id()) + suffix + ' ';
    return names;
}

/// [m] until one is on a way through a junction that goes before `way`; infinity: never, or not
/// soon.
double Standoffs::way_to_meeting(const Car& other, std::uint32_t way) const {
    if (other.lane == world::none || other.sumo.empty())
        return world::infinity;
    constexpr double spare = 30;  // [m] he is asked once a second
    const double reach = std::max(sight, way_to_stop(other) + spare);
    double left = -other.lane_position;
    std::uint32_t lane = other.lane;
    while (lane != world::none && left < reach) {
        const world::LaneT& on = town_->lanes[lane];
        if (on.kind == world::LaneKind::internal && right_of_way_->lets_go(way, lane))
            return left;
        left += on.sumo_length;
        lane = lane_after(lane, other, *town_, *graph_);
    }
    return world::infinity;
}

/// Else it would stand in the junction, and those who let it in behind it. Where the next junction
/// is near, those who come out of this one change lanes already and stop, if there are several; and
/// a queue of a few cars reaches back into this one.
bool Standoffs::has_room_behind(const Car& car, std::uint32_t way, const Cars& cars) const {
    constexpr double longest_weave = 40;   // [m]
    constexpr double shortest_queue = 25;  // [m]
    constexpr double slow = 2;             // [m/s]
    constexpr double spare = 3;            // [m]
    std::uint32_t lane = way;
    while (lane != world::none && town_->lanes[lane].kind == world::LaneKind::internal)
        lane = lane_after(lane, car, *town_, *graph_);
    const double needed = world::vehicle_models()[car.model].length + spare;
    if (lane == world::none)
        return false;
    const bool weaves = graph_->edge(graph_->edge_of(lane)).lanes.size() > 1;
    return town_->lanes[lane].length > (weaves ? longest_weave : shortest_queue) &&
           std::none_of(cars.all().begin(), cars.all().end(), [&](const Car& other) {
               return other.lane == lane && other.speed < slow &&
                      other.lane_position - world::vehicle_models()[other.model].length < needed;
           });
}

/// Who drives by himself, and comes: he is not asked.
bool Standoffs::somebody_comes(const Car& car, const world::TickView& last) {
    const auto vehicles = last.vehicles();
    return std::any_of(vehicles.begin(), vehicles.end(), [&](const world::VehicleState& vehicle) {
        const Eigen::Vector2d offset = world::in_plan(vehicle.position()) - car.rear.head<2>();
        return offset.norm() < sight / 2 && offset.dot(car.ahead) > 0 &&
               std::hypot(vehicle.velocity().x(), vehicle.velocity().y()) > halt;
    });
}

/// Who was asked once stays asked: he has slowed down. Who lets another one in holds for that one,
/// and would come to this meeting without.
bool Standoffs::ask(Car& other, double left, std::uint32_t way, std::uint64_t tick) {
    const bool is_asked = other.lets_in_until > tick;
    if (is_asked ? other.lets_in_way != way : way_to_stop(other) > left)
        return false;
    other.lets_in_until = tick + lets_in_for;
    other.lets_in_way = way;
    return true;
}

/// Those who come to the junction, go before it there and can stop easily do so at their line; the
/// others it lets go still.
void Standoffs::ask_to_let_in(Car& car,
                              const world::TickView& last,
                              Cars& cars,
                              std::uint64_t tick) const {
    const bool is_inside = town_->lanes[car.lane].kind == world::LaneKind::internal;
    const double stood = car.stuck_ticks * step_;  // [s]
    const double since = std::fmod(stood, asks_again);
    const bool goes_on = car.pushes_until > tick && stood > starved && since < has_come;
    if (!is_inside && since < starved && !goes_on)
        return;
    const std::uint32_t way = is_inside ? car.lane : lane_after(car.lane, car, *town_, *graph_);
    if (way == world::none ||
        (!is_inside && (!has_room_behind(car, way, cars) || somebody_comes(car, last))))
        return;
    std::vector<std::uint32_t> asked;
    for (Car& other : cars.all()) {
        const double left = other.id == car.id ? world::infinity : way_to_meeting(other, way);
        if (left <= 0 || left == world::infinity || other.on_call || other.origin != Origin::demand)
            continue;
        if (ask(other, left, way, tick))
            asked.push_back(other.id);
    }
    push_past(car, asked, way, cars, tick);
}

void Standoffs::push_past(Car& car,
                          const std::vector<std::uint32_t>& asked,
                          std::uint32_t way,
                          const Cars& cars,
                          std::uint64_t tick) {
    if (car.pushes_until <= tick)
        car.pushes_past.clear();
    std::erase_if(car.pushes_past, [&](std::uint32_t id) {
        const Car* other = cars.find(id);
        return other == nullptr || other->lets_in_way == way;
    });
    car.pushes_past.insert(car.pushes_past.end(), asked.begin(), asked.end());
    if (!asked.empty())
        car.pushes_until = std::max(car.pushes_until, tick + lets_in_for);
}

/// Past one who came into the junction all the same nobody pushes.
void Standoffs::stop_pushing_past(const Car& inside, Cars& cars) {
    for (Car& car : cars.all()) {
        if (std::erase(car.pushes_past, inside.id) > 0 && car.ignores_standing)
            libsumo::Vehicle::setParameter(car.sumo, ignored, "");
    }
}

void Standoffs::hold(Cars& cars, std::uint64_t tick) const {
    constexpr double gap = 1;  // [m] before its line
    for (Car& car : cars.all()) {
        if (car.lets_in_until <= tick || car.lane == world::none || car.sumo.empty())
            continue;
        const double left = way_to_meeting(car, car.lets_in_way);
        if (left <= 0 || left == world::infinity) {
            car.lets_in_until = 0;
            car.lets_in_way = world::none;
            stop_pushing_past(car, cars);
            continue;
        }
        const Braking braking{
            car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
        car.way_speed = std::min(car.way_speed, braking.speed_before(left, gap, 0));
    }
}

void Standoffs::advance(const world::TickView& last, Cars& cars, std::uint64_t tick) const {
    constexpr std::uint64_t every = 20;  // [ticks]
    if (tick % every != 0)
        return;
    std::vector<Car*> waiting;
    for (Car& car : cars.all()) {
        if (car.ignores_standing && is_through(car)) {
            libsumo::Vehicle::setParameter(car.sumo, ignored, "");
            car.ignores_standing = false;
        }
        if (waits(car))
            waiting.push_back(&car);
        else if (car.ignores_standing && car.pushes_until > tick && car.lane != world::none &&
                 town_->lanes[car.lane].kind == world::LaneKind::internal)
            ask_to_let_in(car, last, cars, tick);
    }
    std::stable_sort(waiting.begin(), waiting.end(), [](const Car* one, const Car* other) {
        return one->stuck_ticks > other->stuck_ticks;
    });
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        const auto before = std::count_if(
            waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(i), [&](const Car* one) {
                return (one->rear - waiting[i]->rear).head<2>().norm() < place;
            });
        if (waiting[i]->stuck_ticks * step_ < patience * static_cast<double>(before + 1))
            continue;
        std::string names = standing_near(*waiting[i], last, cars);
        if (town_->lanes[waiting[i]->lane].kind != world::LaneKind::internal)
            ask_to_let_in(*waiting[i], last, cars, tick);
        if (waiting[i]->pushes_until > tick)
            for (const std::uint32_t id : waiting[i]->pushes_past)
                if (const Car* other = cars.find(id))
                    names += other->sumo + ' ';
        libsumo::Vehicle::setParameter(waiting[i]->sumo, ignored, names);
        waiting[i]->ignores_standing = true;
    }
}

}  // namespace reprise::traffic
