#include "drivers/lane_change.h"

#include <algorithm>
#include <cmath>

#include "world/models/catalogue.h"

namespace reprise::drivers {

namespace {

constexpr double standing_room = 2.5;    // [m] to both sides when all drive alike
constexpr double change_reaction = 0.4;  // [s] of our own speed
constexpr double closing_time = 2.5;     // [s] that somebody faster needs to adapt
constexpr double sight = 100;            // [m]

/// Somebody on the other lane: where its ends are along it.
bool leaves_room(
    double rear, double front, double speed, double our_rear, double our_front, double our_speed) {
    if ((rear + front) / 2 > (our_rear + our_front) / 2)
        return rear - our_front > standing_room + change_reaction * our_speed +
                                      closing_time * std::max(our_speed - speed, 0.0);
    return our_rear - front > standing_room + change_reaction * speed +
                                  closing_time * std::max(speed - our_speed, 0.0);
}

}  // namespace

bool is_clear(const world::TickView& last,
              const Ego& ego,
              const world::TownT& town,
              std::uint32_t lane) {
    const world::LaneT& there = town.lanes[lane];
    const double axle = world::project(there, ego.position).s;
    const double our_rear = axle - ego.model->rear_overhang;
    const double our_front = our_rear + ego.model->length;
    const auto clear_of =
        [&](const Eigen::Vector3d& position, const world::VehicleModel& model, double speed) {
            if ((position - ego.position).squaredNorm() > sight * sight)
                return true;
            const world::LaneProjection at = world::project(there, position);
            if (std::abs(at.t) > (there.width + model.width) / 2 || at.distance > there.width + 3)
                return true;
            const double rear = at.s - model.rear_overhang;
            return leaves_room(rear, rear + model.length, speed, our_rear, our_front, ego.speed);
        };
    return std::all_of(last.cars().begin(),
                       last.cars().end(),
                       [&](const world::CarState& car) {
                           return clear_of(world::to_eigen(car.position()),
                                           world::vehicle_models()[car.model()],
                                           static_cast<double>(car.speed()));
                       }) &&
           std::all_of(last.vehicles().begin(),
                       last.vehicles().end(),
                       [&](const world::VehicleState& other) {
                           const Ego seen = ego_of(other);
                           return seen.id == ego.id ||
                                  clear_of(seen.position, *seen.model, seen.speed);
                       });
}

}  // namespace reprise::drivers
