#include "traffic/sight/meetings.h"

#include <algorithm>
#include <cmath>

#include "traffic/cars/fleet.h"
#include "traffic/sight/braking.h"
#include "traffic/sight/footprints.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double look_ahead = 2.6;         // [s]
constexpr double sample = 0.13;            // [s] between two of a driver's bodies
constexpr double least_sweep = 6;          // [m] and its length: of way that also slow ones want
constexpr double least_speed = 1.5;        // [m/s] that who waits will have in a moment
constexpr double speeding_up = 2.0;        // [m/s] that who brakes would have without
constexpr double room = 0.1;               // [m] at each side of one who passes
constexpr double gap_before = 0.7;         // [m] before another's way
constexpr double beside_its_lane = 0.6;    // [m] from its lane: seen as an obstruction
constexpr double lets_go_first = 6;        // [s] of one who stands; then the other one waits
constexpr std::uint64_t pushes_for = 240;  // [ticks]
constexpr double halt = 0.1;               // [m/s]
constexpr double hard = 0.8;               // of the hardest braking, that one plans with
constexpr double longest_body = 12;        // [m]
constexpr double spacing = 0.4;            // [m] of its steps

/// With a hair of room, as rounding must not tell bodies apart that touch.
world::Box box_around(const BodyBox& body) {
    constexpr double hair = 1e-6;  // [m]
    const Eigen::Vector2d reach = body.half_length * body.ahead.cwiseAbs() +
                                  body.half_width * world::turned_left(body.ahead).cwiseAbs();
    world::Box box;
    box.take(body.middle + reach, hair);
    box.take(body.middle - reach, hair);
    return box;
}

bool touch(const world::Box& one, const world::Box& other) {
    return (one.low.array() <= other.high.array()).all() &&
           (other.low.array() <= one.high.array()).all();
}

}  // namespace

Meetings::Meetings(const world::TownT& town, const RoadGraph& graph, double step)
    : town_(&town),
      graph_(&graph),
      step_(step),
      yields_(town.lanes.size(), false) {
    for (const world::LaneT& lane : town.lanes)
        for (const world::Link& link : lane.links)
            if (world::is_for_cars(lane) && link.yields())
                for (std::uint32_t via = link.via();
                     via != none && town.lanes[via].kind == world::LaneKind::internal &&
                     !yields_[via];) {
                    yields_[via] = true;
                    const auto& links = town.lanes[via].links;
                    via = links.empty()                 ? none
                          : links.front().via() == none ? links.front().to()
                                                        : links.front().via();
                }
}

void Meetings::gather(Cars& cars) {
    drivers_.clear();
    foreseen_ = 0;
    const auto all = cars.all();
    allowed_.assign(all.size(), world::infinity);
    for (std::size_t i = 0; i < all.size(); ++i) {
        Car& car = all[i];
        if (car.sumo.empty() || car.origin == Origin::parked || car.lane == none || car.pass ||
            std::abs(car.offset) > beside_its_lane)
            continue;
        const world::VehicleModel& model = world::vehicle_models()[car.model];
        Driver driver;
        driver.car = &car;
        driver.index = i;
        driver.half_length = model.length / 2;
        driver.middle = car.rear.head<2>() +
                        (driver.half_length - model.rear_overhang) * world::ahead_of(car.yaw);
        driver.reach = std::max(look_ahead * (car.speed + speeding_up), least_sweep + model.length);
        const world::LaneT& lane = town_->lanes[car.lane];
        const double left = (lane.sumo_length - car.lane_position) * lane.length / lane.sumo_length;
        driver.is_turning = lane.kind == world::LaneKind::internal || left < driver.reach ||
                            model.length > longest_short_car || car.lane_position < model.length;
        drivers_.push_back(std::move(driver));
    }
    std::sort(drivers_.begin(), drivers_.end(), [](const Driver& one, const Driver& other) {
        return std::pair(one.middle.x(), one.car->id) < std::pair(other.middle.x(), other.car->id);
    });
}

/// Near enough, and one of them in a place where bodies turn.
bool Meetings::could_meet(const Driver& one, const Driver& other) const {
    if ((!one.is_turning && !other.is_turning) ||
        std::abs(one.car->rear.z() - other.car->rear.z()) > world::level_clearance)
        return false;
    const double reach = one.reach + other.reach + one.half_length + other.half_length + 2 * room;
    return (one.middle - other.middle).squaredNorm() < reach * reach;
}

void Meetings::Swath::clear() {
    bodies.clear();
    around = {};
}

void Meetings::Swath::add(const BodyBox& body) {
    bodies.push_back(body);
    around.take(box_around(body));
}

void Meetings::prepare(Driver& driver) {
    if (driver.seen != nullptr)
        return;
    if (foreseen_ == foresights_.size())
        foresights_.push_back(std::make_unique<Foresight>());
    Foresight& seen = *foresights_[foreseen_++];
    driver.seen = &seen;
    const Car& car = *driver.car;
    seen.way.emplace(car, *town_, *graph_, driver.reach + 1);
    seen.area = seen.way->around(driver.reach);
    seen.area.take(seen.area.low, room);
    seen.area.take(seen.area.high, room);
    seen.now = seen.way->at(0);
    seen.has_bodies = false;
    seen.soon.clear();
    seen.sweep.clear();
    seen.steps.clear();
    for (const std::uint32_t lane : seen.way->lanes())
        if (town_->lanes[lane].kind == world::LaneKind::internal) {
            driver.yields = yields_[lane];
            break;
        }
}

const Meetings::Foresight& Meetings::with_bodies(const Driver& driver) {
    Foresight& seen = *driver.seen;
    if (seen.has_bodies)
        return seen;
    seen.has_bodies = true;
    const double speed = driver.car->speed;
    seen.around = {};
    for (std::size_t i = 0; i < samples; ++i) {
        const bool same = i == 0 || speed == 0;
        seen.bodies[i] = same ? seen.now : seen.way->at(speed * sample * static_cast<double>(i));
        if (i == 0 || !same)
            seen.around.take(box_around(seen.bodies[i]));
    }
    return seen;
}

const Meetings::Swath& Meetings::soon(const Driver& driver) {
    Swath& soon = driver.seen->soon;
    if (soon.bodies.empty()) {
        const double speed = driver.car->speed;
        for (const double tried : {std::max(speed, least_speed), speed + speeding_up})
            for (std::size_t i = 1; i < samples; ++i)
                soon.add(
                    driver.seen->way->at(tried * sample * static_cast<double>(i)).widened(room));
    }
    return soon;
}

const Meetings::Swath& Meetings::sweep(const Driver& driver) {
    Swath& sweep = driver.seen->sweep;
    if (sweep.bodies.empty())
        for (std::size_t i = 0; i < samples; ++i)
            sweep.add(driver.seen->way->at(driver.reach / (samples - 1) * static_cast<double>(i)));
    return sweep;
}

const Meetings::Swath& Meetings::steps(const Driver& driver) {
    Swath& steps = driver.seen->steps;
    if (steps.bodies.empty())
        for (double s = 0; s <= driver.reach; s += spacing)
            steps.add(driver.seen->way->at(s).widened(room));
    return steps;
}

bool Meetings::has_stood(const Driver& driver) const {
    return driver.car->standing_ticks * step_ > lets_go_first;
}

/// Would it come into the other's body, as that drives on, at about the speed that it has or will
/// have in a moment?
bool Meetings::would_meet(const Driver& driver, const Foresight& other) {
    if (!touch(driver.seen->area, other.around))
        return false;
    const Swath& own = soon(driver);
    if (!touch(own.around, other.around))
        return false;
    for (std::size_t i = 0; i < own.bodies.size(); ++i)
        if (overlap(own.bodies[i], other.bodies[1 + i % (samples - 1)]))
            return true;
    return false;
}

bool Meetings::would_meet(const Driver& driver, const BodyBox& standing) {
    const Swath& own = soon(driver);
    return touch(own.around, box_around(standing)) &&
           std::any_of(own.bodies.begin(), own.bodies.end(), [&](const BodyBox& body) {
               return overlap(body, standing);
           });
}

/// Before the first place where its body would lie on the other's way, which begins where that is.
Meetings::Stop Meetings::stop_before(const Driver& driver,
                                     const Driver& other,
                                     std::span<const BodyBox> way) const {
    const Car& car = *driver.car;
    Stop stop;
    stop.distance = driver.reach;
    double s = -spacing;
    for (const BodyBox& body : steps(driver).bodies) {
        s = s < 0 ? 0 : s + spacing;
        const auto on = std::find_if(
            way.begin(), way.end(), [&](const BodyBox& box) { return overlap(body, box); });
        if (on == way.end())
            continue;
        stop.distance = s - spacing;
        if (on == way.begin())
            stop.speed = std::max(other.car->speed * way[0].ahead.dot(body.ahead), 0.0);
        break;
    }
    const double needed = car.speed * car.speed / (2 * hard * emergency_braking(car.model));
    stop.is_possible = stop.distance >= needed;
    stop.time = stop.distance / std::max(car.speed, least_speed);
    return stop;
}

void Meetings::hold(const Driver& driver, const Stop& stop) {
    const Car& car = *driver.car;
    if (car.pushes_until > tick_)
        return;
    const Braking braking{
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    double& allowed = allowed_[driver.index];
    allowed = std::min(allowed, braking.speed_before(stop.distance, gap_before, stop.speed));
}

/// Whom it waits for goes on, as far as there is room beside who waits.
void Meetings::wait(Driver& driver, Driver& other, const Stop& stop) {
    driver.waits_for.push_back(other.car->id);
    hold(driver, stop);
    const BodyBox& here = driver.seen->now;
    const bool is_in_its_way = would_meet(other, here);
    if (is_in_its_way)
        hold(other, stop_before(other, driver, {&here, 1}));
    if (!has_stood(driver) || !has_stood(other))
        return;
    // Both stand, each for the other's body: nobody else will solve it.
    if (is_in_its_way && would_meet(driver, other.seen->now) && driver.car->pushes_until <= tick_)
        driver.car->pushes_until = tick_ + pushes_for;
}

bool Meetings::first_waits(const Driver& one,
                           const Driver& other,
                           const Stop& stop_one,
                           const Stop& stop_other) const {
    const auto waits = [](const Driver& driver, const Driver& for_whom) {
        const auto& ids = driver.car->waits_for;
        return std::find(ids.begin(), ids.end(), for_whom.car->id) != ids.end();
    };
    const bool both_stand = has_stood(one) && has_stood(other);
    if (waits(one, other))
        return !both_stand;
    if (waits(other, one))
        return both_stand;
    if (stop_one.is_possible != stop_other.is_possible)
        return stop_one.is_possible;
    if (one.yields != other.yields)
        return one.yields;
    if (stop_one.time != stop_other.time)
        return stop_one.time > stop_other.time;
    return one.car->id > other.car->id;
}

/// In one lane SUMO's cars follow each other, at more than this distance; but when a vehicle with
/// mass overtakes them there it loses their order, and some look at the wrong one ahead.
void Meetings::follow(const Driver& one, const Driver& other) {
    const bool is_ahead = one.car->lane_position > other.car->lane_position;
    const Driver& leader = is_ahead ? one : other;
    const Driver& follower = is_ahead ? other : one;
    const double distance =
        leader.car->lane_position - 2 * leader.half_length - follower.car->lane_position;
    if (distance > 0)
        hold(follower, {distance, leader.car->speed});
}

/// On its way through the lane that the other's bumper is on.
bool Meetings::follows(const Driver& driver, const Driver& leader) {
    const auto lanes = driver.seen->way->lanes();
    return std::find(lanes.begin(), lanes.end(), leader.car->lane) != lanes.end();
}

/// Else its tail may still lie where others cross.
bool Meetings::is_all_on_its_lane(const Driver& driver) {
    return driver.car->lane_position > 2 * driver.half_length;
}

void Meetings::meet(Driver& one, Driver& other) {
    prepare(one);
    prepare(other);
    if (!touch(one.seen->area, other.seen->area))
        return;
    const bool one_follows = follows(one, other);
    const bool other_follows = follows(other, one);
    if ((one_follows && other_follows) || (one_follows && is_all_on_its_lane(other)) ||
        (other_follows && is_all_on_its_lane(one)) || overlap(one.seen->now, other.seen->now))
        return;
    const bool first = !other_follows && would_meet(one, with_bodies(other));
    const bool second = !one_follows && would_meet(other, with_bodies(one));
    if (!first && !second)
        return;
    const Stop stop_one = stop_before(one, other, sweep(other).bodies);
    const Stop stop_other = stop_before(other, one, sweep(one).bodies);
    if (first && (!second || first_waits(one, other, stop_one, stop_other)))
        wait(one, other, stop_one);
    else
        wait(other, one, stop_other);
}

void Meetings::look(Cars& cars, std::uint64_t tick) {
    tick_ = tick;
    gather(cars);
    double farthest = 0;
    for (const Driver& driver : drivers_)
        farthest = std::max(farthest, driver.reach + longest_body / 2);
    for (std::size_t i = 0; i < drivers_.size(); ++i)
        for (std::size_t j = i + 1; j < drivers_.size(); ++j) {
            const double apart = drivers_[j].middle.x() - drivers_[i].middle.x();
            if (apart > drivers_[i].reach + longest_body / 2 + farthest)
                break;
            if (drivers_[i].car->lane == drivers_[j].car->lane)
                follow(drivers_[i], drivers_[j]);
            else if (could_meet(drivers_[i], drivers_[j]))
                meet(drivers_[i], drivers_[j]);
        }
    for (Driver& driver : drivers_)
        driver.car->waits_for = std::move(driver.waits_for);
}

}  // namespace reprise::traffic
