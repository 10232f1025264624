#include "traffic/sight/lane_change_pace.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/cars/vehicle_lookup.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

constexpr double crawl = 0.5;      // [m/s] slower than that nobody steers anywhere
constexpr double steepest = 0.35;  // metres aside for each metre driven

/// [m/s] sideways of one that stands or crawls. SUMO lets nobody go faster than it takes to end a
/// change on this lane: one with free road gets what it will be able to do in a moment, or it would
/// never start.
double aside_while_waiting(const Car& car, const world::LaneT& lane, double usual) {
    using libsumo::Vehicle;
    constexpr double room = 1;        // [m] more than the gap that it keeps when standing
    constexpr double next_to = 12;    // [m] before the lane's end there is no way left for a change
    constexpr double nothing = 0.01;  // SUMO divides by it
    if (lane.sumo_length - car.lane_position < next_to)
        return usual;
    if (Vehicle::getLateralLanePosition(car.sumo) == 0)
        return nothing;
    const auto [leader, gap] = Vehicle::getLeader(car.sumo, next_to);
    return !leader.empty() && gap < room ? nothing : steepest;
}

/// [m/s] sideways at most. In few steps: each is told to SUMO.
double steerable(double speed) {
    constexpr double steps = 2;  // for each m/s
    return steepest * std::floor(speed * steps) / steps;
}

}  // namespace

LaneChangePace::LaneChangePace(const world::TownT& town) : town_(&town) {
    for (const world::LaneT& lane : town.lanes)
        has_neighbour_.push_back(lane.left != world::none || lane.right != world::none);
}

/// Looked for once: few of the cars, and side by side.
std::vector<LaneChangePace::Waiting> LaneChangePace::waiting(const Cars& cars) {
    constexpr double slow = 3;  // [m/s] of a queue's cars
    std::vector<Waiting> found;
    for (const Car& car : cars.all())
        if (car.speed < slow && car.lane != world::none)
            found.push_back(
                {car.lane, car.lane_position, world::vehicle_models()[car.model].length});
    return found;
}

/// [m] for all of a change.
double LaneChangePace::wanted_way(const Car& car) const {
    constexpr double margin = 4;  // [m]
    const double width = town_->lanes[car.lane].width;
    return std::max(width / steepest, width / usual_aside * car.speed) + margin;
}

/// Does nothing lie, stand or walk beside the car's way within that of a change, on the line or on
/// the next lane? What stands before it is no reason to stay.
bool LaneChangePace::is_clear(const Car& car, const Obstructions& obstructions) const {
    const world::LaneT& lane = town_->lanes[car.lane];
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const double half_width = model.width / 2;
    const double bumper = car.lane_position * lane.length / lane.sumo_length;
    const double begin = bumper - model.length;
    const double end = bumper + wanted_way(car);
    const auto is_between = [&](const Obstruction& one) {
        return !one.drives && one.end > begin && one.begin < end;
    };
    for (const Obstruction& one : obstructions.on(car.lane))
        if (is_between(one) && (one.right > half_width || one.left < -half_width))
            return false;
    for (const std::uint32_t beside : {lane.left, lane.right})
        if (beside != world::none) {
            const auto there = obstructions.on(beside);
            if (std::any_of(there.begin(), there.end(), is_between))
                return false;
        }
    return true;
}

/// Is there way enough for all of a change, before the lane ends and before those who wait on it?
/// Who begins without would stand across two lanes.
bool LaneChangePace::has_way(const Car& car, const std::vector<Waiting>& waiting) const {
    const world::LaneT& lane = town_->lanes[car.lane];
    double way = lane.sumo_length - car.lane_position;
    for (const Waiting& other : waiting)
        if (other.lane == car.lane && other.lane_position > car.lane_position)
            way = std::min(way, other.lane_position - car.lane_position - other.length);
    return way > wanted_way(car);
}

void LaneChangePace::follow(Cars& cars,
                            const Obstructions& obstructions,
                            std::uint64_t tick) const {
    constexpr int as_it_likes = 1621;  // SUMO's default
    constexpr int as_asked = 512;      // as RescueLane asks, where nobody is hindered
    constexpr int never = 0;
    const std::vector<Waiting> queues = waiting(cars);
    for (Car& car : cars.all()) {
        if (car.sumo.empty() || car.origin == Origin::parked || car.lane == world::none)
            continue;
        // It was given its pace, and changes no lanes besides.
        if (car.pass && car.pass->joins)
            continue;
        const KnownVehicle known(car.sumo, car.in_sumo);
        const world::LaneT& lane = town_->lanes[car.lane];
        // A quarter of the cars is asked in each tick.
        if (has_neighbour_[car.lane] && car.origin == Origin::demand && (tick + car.id) % 4 == 0) {
            const bool may =
                car.speed > crawl && has_way(car, queues) && is_clear(car, obstructions);
            const int mode = !may ? never : car.makes_way ? as_asked : as_it_likes;
            if (mode != car.lane_change_mode)
                libsumo::Vehicle::setLaneChangeMode(car.sumo, mode);
            car.lane_change_mode = mode;
        }
        if (car.lane_order)
            car.aside_wanted = lane.width / std::max(car.lane_order->duration, 1.0);
        double limit = car.aside_wanted == 0 ? usual_aside : car.aside_wanted;
        if (has_neighbour_[car.lane])
            limit = std::min(
                limit,
                car.speed < crawl ? aside_while_waiting(car, lane, limit) : steerable(car.speed));
        if (limit == (car.aside_limit < 0 ? usual_aside : car.aside_limit))
            continue;
        libsumo::Vehicle::setMaxSpeedLat(car.sumo, limit);
        car.aside_limit = limit;
    }
}

}  // namespace reprise::traffic
