#include "traffic/sight/met_driver.h"

#include <algorithm>
#include <cmath>

#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

constexpr double least_sweep = 6;        // [m] and its length: of way that also slow ones want
constexpr double beside_its_lane = 0.6;  // [m] from its lane: seen as an obstruction

}  // namespace

bool MetDriver::Manner::is_of(const Car& car) const {
    return standing_ticks == car.standing_ticks && stuck_ticks == car.stuck_ticks &&
           pushes_until == car.pushes_until && pushes_past == car.pushes_past &&
           waits_for == car.waits_for;
}

void MetDriver::Manner::take(const Car& car) {
    standing_ticks = car.standing_ticks;
    stuck_ticks = car.stuck_ticks;
    pushes_until = car.pushes_until;
    pushes_past = car.pushes_past;
    waits_for = car.waits_for;
}

bool MetDriver::takes_part(const Car& car) {
    return !car.sumo.empty() && car.origin != Origin::parked && car.lane != world::none &&
           !car.pass && std::abs(car.offset) <= beside_its_lane;
}

void MetDriver::take(const Car& of) {
    car = nullptr;
    waits_for.clear();
    blocked_by.clear();
    if (!takes_part(of))
        return;
    manner.take(of);
    pushes_until = of.pushes_until;
    pushes_past = of.pushes_past;
    leans = 0;
    const world::VehicleModel& model = world::vehicle_models()[of.model];
    car = &of;
    seen = nullptr;
    half_length = model.length / 2;
    middle = of.rear.head<2>() + (half_length - model.rear_overhang) * of.ahead;
    reach = std::max(Foresight::look_ahead * (of.speed + Foresight::speeding_up),
                     least_sweep + model.length);
}

}  // namespace reprise::traffic
