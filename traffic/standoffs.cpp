#include "traffic/standoffs.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/sumo.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

constexpr double patience = 12;    // [s] for the first of several; as much again for each other
constexpr double place = 35;       // [m] a junction with the ends of its roads
constexpr double at_the_line = 3;  // [m] before the end of its lane
constexpr double has_stopped = 2;  // [s]
constexpr double halt = 0.3;       // [m/s]
constexpr const char* ignored = "junctionModel.ignoreIDs";

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
        libsumo::Vehicle::setParameter(
            waiting[i]->sumo, ignored, standing_near(*waiting[i], last, cars));
        waiting[i]->ignores_standing = true;
    }
}

}  // namespace reprise::traffic
