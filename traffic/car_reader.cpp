// What it must do: read SUMO's cars after its step, and write them into the tick.
// What it assumes: between two steps a car moves by speed times step along its lane (SUMO's Euler
//   update); what it does beside that is no driving.
// How it goes: libsumo's getters, about 30 ns each (SUMO finds the car by its name once), and none
//   for what cannot have changed or follows from the speed.
// What it keeps: nothing beside the cars.
#include "traffic/car_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <libsumo/libsumo.h>

#include "traffic/cars/vehicle_lookup.h"
#include "traffic/roads/even_yaw.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

using libsumo::Vehicle;
using world::none;
using world::rounded;

/// SUMO's bits: 1 right indicator, 2 left indicator.
std::uint16_t indicators_of(int signals) {
    int lamps = 0;
    if ((signals & 1) != 0)
        lamps |= world::lamp_right;
    if ((signals & 2) != 0)
        lamps |= world::lamp_left;
    return static_cast<std::uint16_t>(lamps);
}

/// The foot is on the brake from a deceleration that rolling and the engine do not give, until the
/// car slows down no more; who stands holds it. SUMO's own lamp is that of its plan, which dawdling
/// drivers change twice a second.
bool brakes(const Car& car) {
    constexpr double rolls_out = 0.8;  // [m/s^2]
    constexpr double stands = 0.1;     // [m/s]
    const bool braked = (car.lamps & world::lamp_brake) != 0;
    return (car.speed < stands && car.acceleration < 0.2) ||
           car.acceleration < (braked ? -0.1 : -rolls_out);
}

/// Can one tick of driving have moved the bumper by this, with the car heading that way? `driven`
/// [m] at its speed. Bends and lane changes move it sideways, too.
bool is_driven(const Eigen::Vector2d& moved, const Eigen::Vector2d& ahead, double driven) {
    constexpr double rounding = 0.002;  // [m]
    constexpr double sideways = 0.4;    // [m] at most
    const double along = moved.dot(ahead);
    const double across = std::abs(world::cross(ahead, moved));
    return along > -rounding && moved.norm() < 1.1 * driven + 0.05 * (driven > 0) + rounding &&
           across < std::min(0.7 * driven, sideways) + rounding;
}

/// SUMO lets one who stands behind somebody inch on every other second: who has waited for minutes
/// would begin anew with each of these millimetres.
void count_standing(Car& car) {
    constexpr double creeping = 0.25;  // [m]
    car.standing_ticks = car.speed < 0.1 ? car.standing_ticks + 1 : 0;
    const double way = std::abs(car.trail.travelled() - car.stuck_from);  // it may begin anew
    const bool stuck = car.speed < 0.1 || (car.stuck_ticks > 0 && way < creeping);
    car.stuck_ticks = stuck ? car.stuck_ticks + 1 : 0;
    if (!stuck)
        car.stuck_from = car.trail.travelled();
}

}  // namespace

CarReader::CarReader(const world::TownT& town,
                     const RoadGraph& graph,
                     double step,
                     std::uint64_t seed)
    : town_(&town),
      graph_(&graph),
      step_(step),
      sumo_step_(std::round(step * 1000) / 1000),
      seed_(seed) {
    constexpr double rounding = 0.01;  // [m]

    struct Road {
        int lanes = 0;
        double shortest = world::infinity;
    };

    std::map<std::string_view, Road> roads;
    for (const world::LaneT& lane : town.lanes)
        if (lane.kind != world::LaneKind::sidewalk) {
            Road& road = roads[lane.edge];
            ++road.lanes;
            road.shortest = std::min(road.shortest, lane.sumo_length);
        }
    measures_.reserve(town.lanes.size());
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        const world::LaneT& lane = town.lanes[i];
        lanes_by_name_.emplace(lane.name, i);
        const Road& road = roads[lane.edge];
        measures_.push_back({lane.length,
                             lane.sumo_length,
                             road.shortest - rounding,
                             graph.index_of(i),
                             road.lanes == 1});
    }
}

/// Onto the lane of this name. What lies behind is no longer part of the car's route.
void CarReader::enter_lane(Car& car, std::string_view lane) const {
    const auto found = lanes_by_name_.find(lane);
    car.lane = found == lanes_by_name_.end() ? none : found->second;
    const std::uint32_t edge = car.lane == none ? none : graph_->edge_of(car.lane);
    const auto here = std::find(car.route.begin(), car.route.end(), edge);
    if (here != car.route.end())
        car.route.erase(car.route.begin(), here);
}

/// The front bumper as SUMO has it, at the height of the town's road.
Eigen::Vector3d CarReader::bumper_of(const Car& car) const {
    // SUMO writes a height only where the network has one; elsewhere it is a number of its own.
    const libsumo::TraCIPosition p = Vehicle::getPosition3D(car.sumo);
    const bool has_height = p.z != libsumo::INVALID_DOUBLE_VALUE;
    Eigen::Vector3d front(p.x, p.y, has_height ? p.z : 0.0);
    // Where paths cross, the town's road is not the network's: see ground/mesh/level_paths.h.
    if (has_height && car.lane != none &&
        town_->lanes[car.lane].kind == world::LaneKind::internal) {
        const world::LaneT& path = town_->lanes[car.lane];
        front.z() = world::point_at(path, world::project(path, front).s).position.z();
    }
    return front;
}

/// Does its body lie along its lane? In a junction and behind a lane's first metres none need.
bool CarReader::is_straight(const Car& car) const {
    constexpr double askew = 0.15;  // [rad]
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    if (car.lane == none || town_->lanes[car.lane].kind == world::LaneKind::internal ||
        car.lane_position < model.length)
        return true;
    const world::LaneT& lane = town_->lanes[car.lane];
    const double middle = car.lane_position * lane.length / lane.sumo_length - model.wheelbase / 2;
    return std::abs(world::wrap_angle(world::point_at(lane, middle).yaw - car.yaw)) < askew;
}

/// As its order wants it, and as the car drives: a standing car stands.
void CarReader::move_aside(Car& car, std::uint64_t tick) const {
    // Metres aside for each metre driven; more with the wheels turned as far as they go.
    const double steepest = car.pass ? 1.0 : 0.5;
    const OffsetOrder& order = *car.offset_order;
    const double seconds = static_cast<double>(tick - order.start) * step_;
    const double most = steepest * car.speed * step_;
    car.offset += std::clamp(order.change.value(seconds) - car.offset, -most, most);
    const bool done = car.offset == 0 && order.change.to == 0 && seconds >= order.change.duration;
    if (done && (car.origin != Origin::demand || is_straight(car)))
        car.offset_order.reset();
}

/// SUMO's cars jump: where a change of lanes is cut short by a junction, on a curve where the lanes
/// are not equally long, and to and fro where lanes are shorter than a tick's way. What driving
/// cannot have done becomes a slip between the car shown and SUMO's, which it works off while it
/// drives: a standing car stands. The slip is kept in the world's frame; in the lane's, each corner
/// of the centre line would turn it, and the car with it.
Eigen::Vector3d CarReader::without_jumps(Car& car, const Eigen::Vector3d& sumo_front) const {
    const Eigen::Vector2d moved = (sumo_front - car.sumo_front).head<2>();
    car.sumo_front = sumo_front;
    double driven = car.speed * step_;
    if (car.lane != none)
        driven *= measures_[car.lane].length / measures_[car.lane].sumo_length;
    const bool plausible = is_driven(moved, car.ahead, driven);
    if (plausible && car.slip.isZero(0))
        return sumo_front;

    const double lane_yaw = lane_yaw_of(car);
    const Eigen::Vector2d ahead = world::ahead_of(lane_yaw);
    const Eigen::Vector2d left = world::turned_left(ahead);
    constexpr double farthest = 8;  // [m]; further is a new place, not a jump
    if (!plausible && !is_driven(moved, ahead, driven) && moved.norm() < farthest)
        car.slip += std::clamp(moved.dot(ahead), 0.0, driven) * ahead - moved;
    // Shares of the way driven; sideways such that the turn to it and back stays gentle.
    constexpr double gentle = 7;  // [m^2/s^2] 2 m/s^2 sideways, times 3.5 m from bumper to axle
    const double aside = std::min(0.2, gentle / std::max(car.speed * car.speed, 1.0));
    const double along = car.slip.dot(ahead);
    const double across = car.slip.dot(left);
    car.slip -= std::copysign(std::min(std::abs(along), 0.2 * driven), along) * ahead;
    car.slip -= std::copysign(std::min(std::abs(across), aside * driven), across) * left;
    if (car.slip.squaredNorm() < 1e-12)
        car.slip.setZero();
    return sumo_front + Eigen::Vector3d(car.slip.x(), car.slip.y(), 0);
}

/// Of its lane, where its bumper is.
double CarReader::lane_yaw_of(const Car& car) const {
    if (car.lane == none)
        return car.yaw;
    const world::LaneT& on = town_->lanes[car.lane];
    return world::point_at(on, car.lane_position * on.length / on.sumo_length).yaw;
}

double CarReader::even_lane_yaw_of(const Car& car) const {
    if (car.lane == none)
        return car.yaw;
    const world::LaneT& on = town_->lanes[car.lane];
    return even_yaw_at(on, car.lane_position * on.length / on.sumo_length);
}

/// To its left. Of who leans aside in a junction by its own axes: lanes begin there at an angle to
/// those before them, and where a lane begins nobody is moved.
Eigen::Vector2d CarReader::aside_of(const Car& car) const {
    return world::turned_left(car.leans ? car.ahead : world::ahead_of(even_lane_yaw_of(car)));
}

/// The pose that the car shows, after its bumper.
void CarReader::move_body(Car& car) const {
    Eigen::Vector3d shown = without_jumps(car, bumper_of(car));
    if (car.offset != 0)
        shown.head<2>() += car.offset * aside_of(car);
    car.trail.advance(shown);
    car.rear = rolled(car, car.trail.rear());
    const bool is_short = world::vehicle_models()[car.model].length < Trail::least_reach;
    const Eigen::Vector3d body = car.trail.front() - (is_short ? car.trail.heads_from() : car.rear);
    car.turn_to(turned(car.yaw, std::atan2(body.y(), body.x()), step_));
    car.pitch = body.z() == 0 ? 0 : std::atan2(body.z(), body.head<2>().norm());
}

double CarReader::turned(double yaw, double wanted, double step) {
    constexpr double fastest = 3.1;  // [rad/s] 9 degrees in a tick
    const double most = fastest * step;
    const double turn = world::wrap_angle(wanted - yaw);
    return std::abs(turn) <= most ? wanted : world::wrap_angle(yaw + std::copysign(most, turn));
}

/// The rear axle follows the bumper's way only as far as wheels roll: on the tightest bends, of
/// long vehicles, it would go sideways. `wanted` is where it would be.
Eigen::Vector3d CarReader::rolled(const Car& car, const Eigen::Vector3d& wanted) const {
    constexpr double steepest = 0.45;  // metres aside for each metre driven
    constexpr double elsewhere = 6;    // [m] further is a new place
    const Eigen::Vector2d moved = (wanted - car.rear).head<2>();
    const Eigen::Vector2d& ahead = car.ahead;
    const double aside = world::cross(ahead, moved);
    const double most = steepest * car.speed * step_;
    if (std::abs(aside) <= most || moved.norm() > elsewhere)
        return wanted;
    const Eigen::Vector2d left = world::turned_left(ahead);
    const Eigen::Vector2d back = left * (aside - std::copysign(most, aside));
    return wanted - Eigen::Vector3d(back.x(), back.y(), 0);
}

/// [m] along its lane, in SUMO's measure. SUMO's step adds just this to it, wherever no road ends:
/// so it need not be asked. Of the scenario's cars it is: their words may put them elsewhere.
double CarReader::position_of(const Car& car, double speed) const {
    if (car.lane != none && car.origin == Origin::demand) {
        const double driven_to = car.lane_position + speed * sumo_step_;
        if (driven_to < measures_[car.lane].inside)
            return driven_to;
    }
    return Vehicle::getLanePosition(car.sumo);
}

/// `on_its_road`: it has entered no other one, but may have changed lanes.
void CarReader::read_lane(Car& car, bool on_its_road) const {
    if (on_its_road &&
        (measures_[car.lane].is_alone ||
         Vehicle::getLaneIndex(car.sumo) == static_cast<int>(measures_[car.lane].index)))
        return;
    const std::string lane = Vehicle::getLaneID(car.sumo);
    if (car.lane == none || town_->lanes[car.lane].name != lane)
        enter_lane(car, lane);
}

void CarReader::read_car(Car& car, std::uint64_t tick) const {
    const double speed = Vehicle::getSpeed(car.sumo);
    const double position = position_of(car, speed);
    // A car that neither drives nor moved along its lane is where it was: see LaneChangePace. One
    // that moved by just its speed is on the same road (entering another one would take off the
    // length of the last).
    const bool stands =
        car.lane != none && speed == 0 && car.speed == 0 && position == car.lane_position;
    const bool on_its_road =
        car.lane != none && std::abs(position - car.lane_position - speed * step_) < 1e-6;
    car.lane_position = position;
    car.acceleration = (speed - car.speed) / step_;
    car.speed = speed;
    count_standing(car);
    // Indicators can wait: a quarter of the cars is asked in each tick, so they are at most 0.2 s
    // old.
    std::uint16_t lamps = car.lamps & (world::lamp_left | world::lamp_right);
    if (car.lane == none || (tick + car.id) % 4 == 0)
        lamps = indicators_of(Vehicle::getSignals(car.sumo));
    if (brakes(car))
        lamps |= world::lamp_brake;
    car.lamps = lamps;
    if (stands)
        return;
    if (car.offset_order)
        move_aside(car, tick);
    read_lane(car, on_its_road);
    move_body(car);
}

void CarReader::read(std::span<Car> cars, std::uint64_t tick) const {
    for (Car& car : cars) {
        if (car.origin == Origin::parked || car.sumo.empty())
            continue;
        const KnownVehicle known(car.sumo, car.in_sumo);
        read_car(car, tick);
    }
}

void CarReader::write(const Cars& cars, const world::TickView& last, world::TickDraft& next) const {
    constexpr double per_metre = 1024;
    constexpr double per_radian = 8192;
    constexpr double per_acceleration = 64;  // a lamp and a plot need no more
    auto& out = next.traffic.cars;
    auto& looks = next.traffic.looks;
    out.clear();
    looks.clear();
    out.reserve(cars.size());
    looks.reserve(cars.size());
    const std::span<const world::Look> drawn = last.car_looks();  // by id, too
    auto look = drawn.begin();
    for (const Car& car : cars.all()) {
        double lane_s = 0;
        if (car.lane != none)
            lane_s =
                car.lane_position * measures_[car.lane].length / measures_[car.lane].sumo_length;
        double yaw = rounded(car.yaw, per_radian);
        if (yaw > std::acos(-1.0) || yaw <= -std::acos(-1.0))
            yaw = std::floor(std::acos(-1.0) * per_radian) / per_radian;
        out.emplace_back(world::Vec3(rounded(car.rear.x(), per_metre),
                                     rounded(car.rear.y(), per_metre),
                                     rounded(car.rear.z(), per_metre)),
                         static_cast<float>(yaw),
                         static_cast<float>(rounded(car.pitch, per_radian)),
                         static_cast<float>(rounded(car.speed, per_metre)),
                         static_cast<float>(rounded(lane_s, per_metre)),
                         car.id,
                         car.lane,
                         car.model,
                         car.lamps,
                         static_cast<float>(rounded(car.acceleration, per_acceleration)));
        while (look != drawn.end() && look->actor() < car.id)
            ++look;
        const bool is_known = look != drawn.end() && look->actor() == car.id;
        looks.push_back(is_known ? *look : world::drawn_look(seed_, car.id));
    }
}

}  // namespace reprise::traffic
