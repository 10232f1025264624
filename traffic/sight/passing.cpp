#include "traffic/sight/passing.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/sight/swing.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double pass_patience = 8;      // [s]
constexpr double patience_beside = 20;   // [s] where a lane beside its own may get free
constexpr double first_in_line = 9;      // [m] at most to what is passed
constexpr double longest_row = 25;       // [m] of what is passed at once
constexpr double room_to_return = 14;    // [m] of the lane, beside the car's own length
constexpr double slow_pass = 3.5;        // [m/s] on average
constexpr double beside_oncoming = 2.4;  // [m] from middle to middle
constexpr double room_in_queue = 12;     // [m] between the place where it is back and who is there

}  // namespace

/// What a car needs to be free, seen from its bumper along its lane. [m]
struct Passing::Stretch {
    Eigen::Vector2d front;
    Eigen::Vector2d ahead;
    double aside = 0;   ///< of the way past, left of the lane's middle
    double shift = 0;   ///< of the lane's middle, left of the bumper
    double length = 0;  ///< until it is back in its lane
    double time = 0;    ///< [s] that this takes
    std::uint32_t opposite = none;
    double from_end = 0;  ///< of the bumper, along the opposite lane

    /// Somebody with his middle there would be in the way.
    bool holds(const Eigen::Vector2d& p,
               double half_length,
               const Eigen::Vector2d& velocity) const {
        const Eigen::Vector2d offset = p - front;
        const double x = offset.dot(ahead);
        const double y = world::cross(ahead, offset) - shift;
        const double towards = std::max(-velocity.dot(ahead), 0.0);
        const bool in_oncoming = std::abs(y - aside) < beside_oncoming && x + half_length > -2 &&
                                 x - half_length < length + 8 + towards * time;
        const bool in_own =
            std::abs(y) < 1.6 && x - half_length > 0.5 && x - half_length < length + 12;
        return in_oncoming || in_own;
    }
};

namespace {

/// Does SUMO still have it behind one whom it has passed? It keeps a lane's vehicles in the order
/// in which they came, unless it knows an opposite lane: there such a one stays its leader, for
/// whom it would wait for ever.
bool follows_who_is_passed(const Car& car) {
    using libsumo::Vehicle;
    constexpr double far = 100;  // [m]
    const auto [leader, gap] = Vehicle::getLeader(car.sumo, far);
    return !leader.empty() &&
           gap < -(world::vehicle_models()[car.model].length + Vehicle::getLength(leader));
}

}  // namespace

/// Where the row of things ends that the car stands before; none where it cannot be passed.
std::optional<double> Passing::end_of_row(const Car& car, double front, double aside) const {
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const double half = model.width / 2;
    std::optional<double> end;
    for (const Obstruction& one : obstructions_->on(car.lane)) {
        if (one.begin < front - 0.3 || one.left < -half || one.right > half)
            continue;
        if (one.begin > end.value_or(front) + (end ? model.length + 8 : first_in_line))
            break;
        const bool leaves_room = aside > 0 ? one.left < aside - half : one.right > aside + half;
        // One of SUMO's would stay its leader in their lane for ever.
        if (!one.lasts || one.boxed_in || !leaves_room)
            return std::nullopt;
        end = std::max(end.value_or(front), one.end);
    }
    if (end && *end - front > longest_row)
        return std::nullopt;
    return end;
}

bool Passing::is_free(const Stretch& stretch,
                      const Car& car,
                      const Cars& cars,
                      const world::TickView& last) const {
    const auto all = cars.all();
    const world::LaneT& opposite = town_->lanes[stretch.opposite];
    for (const Car& other : all) {
        if (other.id == car.id)
            continue;
        const world::VehicleModel& model = world::vehicle_models()[other.model];
        const Eigen::Vector2d& ahead = other.ahead;
        const Eigen::Vector2d middle =
            other.rear.head<2>() + (model.length / 2 - model.rear_overhang) * ahead;
        // What is passed stands in the lane itself, and was looked at.
        const bool passed = other.origin == Origin::parked;
        if (!passed && stretch.holds(middle, model.length / 2, other.speed * ahead))
            return false;
        // Its own lane's queue, round a bend too: who waits behind others passes nobody.
        if (!passed && other.lane == car.lane && other.lane_position > car.lane_position &&
            other.lane_position - model.length < car.lane_position + stretch.length + room_in_queue)
            return false;
        if (other.lane != stretch.opposite)
            continue;
        const double way =
            stretch.from_end - other.lane_position / opposite.sumo_length * opposite.length;
        if (way > -model.length && way < stretch.length + 8 + other.speed * stretch.time)
            return false;
    }
    for (const world::VehicleState& other : last.vehicles()) {
        const world::VehicleModel& model = world::vehicle_models()[other.model()];
        const Eigen::Vector3d ahead =
            world::to_eigen(other.orientation()) * Eigen::Vector3d::UnitX();
        const Eigen::Vector2d middle = Eigen::Vector2d(other.position().x(), other.position().y()) +
                                       (model.length / 2 - model.rear_overhang) * ahead.head<2>();
        const Eigen::Vector2d velocity(other.velocity().x(), other.velocity().y());
        const auto here = obstructions_->on(car.lane);
        const bool passed = std::any_of(here.begin(), here.end(), [&](const Obstruction& one) {
            return one.id == other.id() && one.lasts;
        });
        if (!passed && stretch.holds(middle, model.length / 2, velocity))
            return false;
    }
    // In the middle of that lane it drives; what reaches over the line a little leaves it room.
    const double half = world::vehicle_models()[car.model].width / 2;
    const auto there = obstructions_->on(stretch.opposite);
    return std::none_of(there.begin(), there.end(), [&](const Obstruction& one) {
        return one.left > -half && one.right < half &&
               one.end > stretch.from_end - stretch.length - 5 && one.begin < stretch.from_end + 5;
    });
}

void Passing::begin(Car& car,
                    const Cars& cars,
                    const world::TickView& last,
                    std::uint64_t tick) const {
    constexpr double beside = 0.3;  // [m] who is no further aside may begin again
    if (car.origin != Origin::demand || car.speed > 0.1 ||
        (car.offset_order && (car.offset_order->change.to != 0 || std::abs(car.offset) > beside)) ||
        static_cast<double>(car.standing_ticks) * step_ < pass_patience)
        return;
    const world::LaneT& lane = town_->lanes[car.lane];
    const std::uint32_t inner = town_->left_hand ? lane.right : lane.left;
    const std::uint32_t outer = town_->left_hand ? lane.left : lane.right;
    if (lane.kind != world::LaneKind::driving || lane.opposite == none || inner != none ||
        town_->lanes[lane.opposite].kind != world::LaneKind::driving ||
        (outer != none && static_cast<double>(car.standing_ticks) * step_ < patience_beside))
        return;
    const world::LaneT& opposite = town_->lanes[lane.opposite];
    const double aside = (town_->left_hand ? -1 : 1) * (lane.width + opposite.width) / 2;
    const Eigen::Vector3d& front = car.trail.front();
    const world::LaneProjection at = world::project(lane, front);
    const auto end = end_of_row(car, at.s, aside);
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    if (!end || *end + model.length + room_to_return > lane.length)
        return;
    Stretch stretch;
    stretch.front = front.head<2>();
    stretch.ahead = world::ahead_of(world::point_at(lane, at.s).yaw);
    stretch.aside = aside;
    stretch.shift = -at.t;
    stretch.length = *end - at.s + model.length + room_to_return;
    stretch.time = pull_out_time + stretch.length / slow_pass;
    stretch.opposite = lane.opposite;
    stretch.from_end = world::project(opposite, front).s;
    if (!is_free(stretch, car, cars, last))
        return;
    double pace = speed;
    const auto touches = [&](double at_pace) {
        return swings_into_any(car, lane, at, aside, at_pace, obstructions_->footprints());
    };
    if (touches(pace))
        pace = slow_pull_out;
    if (pace < speed && touches(pace))
        return;
    car.pass = PassOrder{car.lane, *end + model.length + 1, pace};
    car.offset_order =
        OffsetOrder{{car.offset, aside, pull_out_time, world::Shape::linear}, tick - 1};
}

double Passing::allowed_speed(const Car& car) {
    constexpr double aside_enough = 0.3;  // [m]
    const bool pulls_out = car.offset_order &&
                           (car.pass->joins || car.offset_order->change.to != 0) &&
                           std::abs(car.offset_order->change.to - car.offset) > aside_enough;
    return pulls_out ? car.pass->pace : speed;
}

void Passing::follow(Car& car, std::uint64_t tick) const {
    constexpr double gives_up = 30;  // [s] of standing since it began
    std::uint64_t stood = car.standing_ticks;
    if (car.offset_order)
        stood = std::min(stood, tick - car.offset_order->start);
    const bool comes_back =
        car.lane != car.pass->lane ||
        world::project(town_->lanes[car.lane], car.trail.front()).s > car.pass->end ||
        (car.offset != 0 && static_cast<double>(stood) * step_ > gives_up);
    if (!comes_back)
        return;
    const bool is_back = car.offset_order ? car.offset_order->change.to == 0 : car.offset == 0;
    if (!is_back)
        car.offset_order =
            OffsetOrder{{car.offset, 0, pull_out_time, world::Shape::linear}, tick - 1};
    if (!follows_who_is_passed(car))
        car.pass.reset();
}

}  // namespace reprise::traffic
