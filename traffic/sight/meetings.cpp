#include "traffic/sight/meetings.h"

#include <algorithm>
#include <cmath>

#include "traffic/cars/fleet.h"
#include "traffic/roads/crossing_lanes.h"
#include "traffic/sight/braking.h"
#include "traffic/sight/footprints.h"
#include "traffic/sight/swing.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double gap_before = 0.7;      // [m] before another's way
constexpr double lets_go_first = 6;     // [s] of one who stands; then the other one waits
constexpr double has_just_started = 3;  // [m/s]
constexpr double hard = 0.8;            // of the hardest braking, that one plans with
constexpr double longest_body = 12;     // [m]

}  // namespace

Meetings::Meetings(const world::TownT& town,
                   const RoadGraph& graph,
                   const RightOfWay& right_of_way,
                   double step)
    : lines_(town),
      graph_(&graph),
      places_(lines_, graph),
      pushing_past_(lines_),
      right_of_way_(&right_of_way),
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

void Meetings::gather(std::span<const Car> cars) {
    drivers_.resize(cars.size());
    for (std::size_t i = 0; i < cars.size(); ++i)
        drivers_[i].take(cars[i]);
    allowed_.assign(cars.size(), world::infinity);
    found_.clear();
    places_.gather(cars, drivers_);
}

/// On one level, and near enough.
bool Meetings::could_meet(const Driver& one, const Driver& other) const {
    if (std::abs(one.car->rear.z() - other.car->rear.z()) > world::level_clearance)
        return false;
    const double reach =
        one.reach + other.reach + one.half_length + other.half_length + 2 * Foresight::room;
    return (one.middle - other.middle).squaredNorm() < reach * reach;
}

void Meetings::prepare(Driver& driver) {
    if (driver.seen == nullptr)
        driver.seen =
            places_.foresight(static_cast<std::size_t>(&driver - drivers_.data()), driver);
}

bool Meetings::has_stood(const Driver& driver) const {
    return driver.car->standing_ticks * step_ > lets_go_first;
}

/// As that, but creeping by a hand's breadth is no way out.
bool Meetings::is_stuck(const Driver& driver) const {
    return driver.car->stuck_ticks * step_ > lets_go_first;
}

/// Its lane in the first junction on its way, or none.
std::uint32_t Meetings::in_junction(const Driver& driver) const {
    for (const std::uint32_t lane : driver.seen->way().lanes())
        if (lines_.town().lanes[lane].kind == world::LaneKind::internal)
            return lane;
    return none;
}

/// Before the first place where its body would lie on the other's way, which begins at `first`.
Meetings::Stop Meetings::stop_at(const Driver& driver,
                                 const Foresight::Entry& entry,
                                 const Driver& other,
                                 const BodyBox& first) {
    const Car& car = *driver.car;
    Stop stop;
    stop.distance = entry.is_any ? entry.driven - Foresight::spacing : driver.reach;
    if (entry.is_first)
        stop.speed = std::max(other.car->speed * first.ahead.dot(entry.body.ahead), 0.0);
    const double needed = car.speed * car.speed / (2 * hard * emergency_braking(car.model));
    stop.is_possible = stop.distance >= needed;
    stop.time = stop.distance / std::max(car.speed, Foresight::least_speed);
    return stop;
}

Meetings::Stop Meetings::stop_before_way(const Driver& driver, const Driver& other) {
    return stop_at(
        driver, driver.seen->first_on_way_of(*other.seen), other, other.seen->way_start());
}

Meetings::Stop Meetings::stop_before_body(const Driver& driver, const Driver& other) {
    const BodyBox& body = other.seen->now();
    return stop_at(driver, driver.seen->first_on(body), other, body);
}

double Meetings::speed_before(const Car& car, const Hold& hold) const {
    const Braking braking{
        car.speed, comfortable_braking(car.model), emergency_braking(car.model), step_};
    return braking.speed_before(hold.distance, gap_before, hold.speed);
}

void Meetings::hold(const Driver& driver, const Stop& stop) {
    const auto index = static_cast<std::size_t>(&driver - drivers_.data());
    found_.push_back(
        {driver.car->id, static_cast<std::uint32_t>(index), stop.distance, stop.speed});
    allowed_[index] = std::min(allowed_[index], speed_before(*driver.car, found_.back()));
}

/// Whom it waits for goes on, as far as there is room beside who waits.
void Meetings::wait(Driver& driver, Driver& other, const Stop& stop) {
    driver.waits_for.push_back(other.car->id);
    hold(driver, stop);
    const bool is_in_its_way = other.seen->would_meet(driver.seen->now());
    if (is_in_its_way)
        hold(other, stop_before_body(other, driver));
    if (is_in_its_way && is_stuck(other))
        other.blocked_by.push_back(driver.car->id);
    // Both stand, each for the other's body: nobody else will solve it.
    if (is_in_its_way && is_stuck(driver) && is_stuck(other) &&
        driver.seen->would_meet(other.seen->now()))
        pushing_past_.begin(driver, other, tick_);
}

/// Who is pushed past stands until the other one is through: two that push meet in the middle.
void Meetings::let_past(const Driver& driver, const Driver& other) {
    Stop stop = stop_before_way(driver, other);
    stop.speed = 0;
    hold(driver, stop);
}

/// Who lies in another one's body gets out of it, and no deeper in.
void Meetings::part(const Driver& one, const Driver& other) {
    constexpr double looked_at = 2;    // [m] of way
    constexpr double rounding = 0.03;  // [m]
    const double now = depth(one.seen->now(), other.seen->now()) + rounding;
    const double soon = one.seen->depth_in(other.seen->now(), looked_at);
    const double its_soon = other.seen->depth_in(one.seen->now(), looked_at);
    const bool is_deep = std::min(soon, its_soon) > std::max(now, PushingPast::deepest);
    if (soon > now && (soon > its_soon || is_deep))
        hold(one, {});
    if (its_soon > now && (its_soon >= soon || is_deep))
        hold(other, {});
}

/// In a junction, behind the last place in it where one waits.
bool Meetings::leaves_junction(const Driver& driver) const {
    const world::LaneT& lane = lines_.town().lanes[driver.car->lane];
    return lane.kind == world::LaneKind::internal &&
           (lane.links.empty() || lane.links.front().via() == none);
}

/// Who is still in a junction when another one's light turns green gets out of it first. He who has
/// just started would come as far as to a place where he waits, and often that is in the way out.
bool Meetings::lets_out(const Driver& driver, const Driver& other) const {
    return driver.car->speed < has_just_started && !leaves_junction(driver) &&
           leaves_junction(other) && !has_stood(other) &&
           stop_before_way(driver, other).is_possible;
}

bool Meetings::first_waits(const Driver& one, const Driver& other) const {
    const auto waits = [](const Driver& driver, const Driver& for_whom) {
        const auto& ids = driver.car->waits_for;
        return std::find(ids.begin(), ids.end(), for_whom.car->id) != ids.end();
    };
    const bool both_stand = has_stood(one) && has_stood(other);
    if (waits(one, other))
        return !both_stand;
    if (waits(other, one))
        return both_stand;
    const Stop stop_one = stop_before_way(one, other);
    const Stop stop_other = stop_before_way(other, one);
    if (stop_one.is_possible != stop_other.is_possible)
        return stop_one.is_possible;
    // SUMO's own word first: else each would wait for the other one.
    const std::uint32_t lane = in_junction(one);
    const std::uint32_t its_lane = in_junction(other);
    if (lane != none && its_lane != none) {
        if (right_of_way_->lets_go(lane, its_lane))
            return true;
        if (right_of_way_->lets_go(its_lane, lane))
            return false;
    }
    const bool yields = lane != none && yields_[lane];
    const bool other_yields = its_lane != none && yields_[its_lane];
    if (yields != other_yields)
        return yields;
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
    const auto lanes = driver.seen->way().lanes();
    return std::find(lanes.begin(), lanes.end(), leader.car->lane) != lanes.end();
}

/// SUMO does. But where it has the driver go the other way of a fork, it stops him at his line,
/// with his nose in the tail of who has just gone this way.
void Meetings::keep_behind(const Driver& driver, const Driver& leader) {
    if (graph_->forks(driver.car->lane))
        hold(driver, stop_before_body(driver, leader));
}

/// Else its tail may still lie where others cross.
bool Meetings::is_all_on_its_lane(const Driver& driver) {
    return driver.car->lane_position > 2 * driver.half_length;
}

/// Round a hairpin who drives ahead comes towards those behind him, perhaps onto their lane.
bool Meetings::comes_back(const Driver& one, const Driver& other) {
    return one.car->ahead.dot(other.car->ahead) < 0;
}

/// In a bend a long one lies over the oncoming lane, often for as long as a queue stands there. Who
/// came up to its body would soon be in its way, too, and neither would ever get past.
bool Meetings::lies_in_way_of(const Driver& driver, const Driver& comer) const {
    const auto on_the_road = [&](const Driver& each) {
        return lines_.town().lanes[each.car->lane].kind != world::LaneKind::internal;
    };
    return 2 * driver.half_length > longest_short_car && on_the_road(driver) &&
           is_all_on_its_lane(driver) && on_the_road(comer) &&
           graph_->edge_of(driver.car->lane) != graph_->edge_of(comer.car->lane) &&
           comer.seen->first_on(driver.seen->now()).is_any &&
           !driver.seen->first_on(comer.seen->now()).is_any &&
           stop_before_way(comer, driver).is_possible;
}

void Meetings::meet(Driver& one, Driver& other) {
    prepare(one);
    prepare(other);
    const bool pushes = one.pushes_until > tick_ || other.pushes_until > tick_;
    if ((!pushes && !one.seen->may_touch(*other.seen)) ||
        !overlap(one.seen->corridor(), other.seen->corridor()))
        return;
    const bool one_follows = follows(one, other);
    const bool other_follows = follows(other, one);
    if (one_follows && other_follows)
        return;
    if (!comes_back(one, other)) {
        if (one_follows && is_all_on_its_lane(other))
            return keep_behind(one, other);
        if (other_follows && is_all_on_its_lane(one))
            return keep_behind(other, one);
    }
    if (PushingPast::has_begun(one, other, tick_))
        return let_past(other, one);
    if (PushingPast::has_begun(other, one, tick_))
        return let_past(one, other);
    if (overlap(one.seen->now(), other.seen->now()))
        return part(one, other);
    if (lies_in_way_of(one, other))
        return wait(other, one, stop_before_way(other, one));
    if (lies_in_way_of(other, one))
        return wait(one, other, stop_before_way(one, other));
    const bool first = !other_follows && one.seen->would_meet(*other.seen);
    const bool second = !one_follows && other.seen->would_meet(*one.seen);
    if (!first && !second)
        return;
    const bool one_lets = !other_follows && lets_out(one, other);
    const bool other_lets = !one_follows && lets_out(other, one);
    if (one_lets || (!other_lets && first && (!second || first_waits(one, other))))
        wait(one, other, stop_before_way(one, other));
    else
        wait(other, one, stop_before_way(other, one));
}

void Meetings::look_at_pairs() {
    double farthest = 0;
    using Place = MeetingPlaces::Place;
    const std::vector<Place>& places = places_.all();
    for (const Place& place : places)
        farthest = std::max(farthest, place.reach + longest_body / 2);
    const Place* const end = places.data() + places.size();
    for (const Place* at = places.data(); at != end; ++at) {
        const Place one = *at;
        const double window = one.reach + longest_body / 2 + farthest;
        for (const Place* next = at + 1; next != end; ++next) {
            const Place& other = *next;
            if (other.x - one.x > window)
                break;
            if (one.lane == other.lane)
                follow(drivers_[one.driver], drivers_[other.driver]);
            else if ((one.is_turning || other.is_turning) && world::touch(one.area, other.area) &&
                     could_meet(drivers_[one.driver], drivers_[other.driver]))
                meet(drivers_[one.driver], drivers_[other.driver]);
        }
    }
}

void Meetings::look_ahead(std::span<const Car> cars, std::uint64_t tick) {
    tick_ = tick;
    ahead_of_ = 0;
    gather(cars);
    look_at_pairs();
    ahead_of_ = tick;
}

/// Are they just as they were when it looked ahead to this tick?
bool Meetings::has_foreseen(std::span<const Car> cars, std::uint64_t tick) const {
    if (ahead_of_ != tick || drivers_.size() != cars.size())
        return false;
    for (std::size_t i = 0; i < cars.size(); ++i) {
        const Car& car = cars[i];
        const Driver& driver = drivers_[i];
        const bool takes_part = Driver::takes_part(car);
        if (takes_part != (driver.car != nullptr) || !places_.has_stayed(i, car, takes_part) ||
            (takes_part && !driver.manner.is_of(car)))
            return false;
    }
    return true;
}

void Meetings::keep(const Cars& cars) {
    const auto all = cars.all();
    allowed_.assign(all.size(), world::infinity);
    for (Hold& hold : kept_) {
        const bool is_there = hold.index < all.size() && all[hold.index].id == hold.id;
        const Car* car = is_there ? &all[hold.index] : cars.find(hold.id);
        if (car == nullptr || !Driver::takes_part(*car))
            continue;
        hold.distance += (hold.speed - car->speed) * step_;
        double& allowed = allowed_[static_cast<std::size_t>(car - all.data())];
        allowed = std::min(allowed, speed_before(*car, hold));
    }
}

void Meetings::add_to(world::Hasher& hasher) const {
    for (const Hold& hold : kept_) {
        hasher.add(hold.id);
        hasher.add(hold.distance);
        hasher.add(hold.speed);
    }
}

void Meetings::look(Cars& cars, std::uint64_t tick) {
    const auto all = cars.all();
    if (!has_foreseen(all, tick)) {
        tick_ = tick;
        gather(all);
        look_at_pairs();
    }
    ahead_of_ = 0;
    kept_ = found_;
    for (std::size_t i = 0; i < drivers_.size(); ++i) {
        const Driver& driver = drivers_[i];
        all[i].waits_for = driver.waits_for;
        all[i].blocked_by = driver.blocked_by;
        if (driver.car == nullptr)
            continue;
        all[i].pushes_until = driver.pushes_until;
        all[i].pushes_past = driver.pushes_past;
        PushingPast::steer(all[i], driver, tick_);
    }
}

}  // namespace reprise::traffic
