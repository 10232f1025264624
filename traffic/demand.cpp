#include "traffic/demand.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "traffic/cars/fleet.h"
#include "traffic/sight/stuck.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/actors.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

constexpr double too_long = 100;     // [s] of standing, after which a car is taken out
constexpr double out_of_sight = 80;  // [m] from every physics vehicle
// Two that wait for each other within its sight would do so for ever, and others behind them.
constexpr double far_too_long = 150;  // [s] of standing
constexpr double not_beside = 30;     // [m]
// Nobody waits so long inside of a junction but for one who waits for him, or who never moves.
constexpr double far_too_long_in_junction = 50;  // [s] of standing, whoever sees it
// Who waits for one who waits for him; see sight/stuck.h for others who go nowhere.
constexpr double ring_lasts = 36;   // [s] of standing: Standoffs had its turns
constexpr double ring_stands = 12;  // [s] of the others in that ring
constexpr double at_its_edge = 1;   // [m] where one who waited to go in is no hindrance
// But in a row before lights behind it: beside a vehicle with mass only who is first of it goes.
constexpr double in_a_row = 100;  // [s] of standing, in case that the row is a ring
constexpr double soonest = 1;     // [s] of standing, before which nobody is stuck

/// A speed at which a car may appear there without anybody braking hard; `room` [m] ahead. [m/s]
double entry_speed(const world::LaneT& lane, const InsertionPoint& point, double room) {
    constexpr double gentle = 2.5;  // [m/s^2]
    const double free_road = std::min(room, lane.length - point.s);
    return std::min(0.8 * lane.speed_limit, std::sqrt(2 * gentle * std::max(0.0, free_road)));
}

/// At the start of a run every place will do; later cars appear out of everybody's way.
InsertionSearch search_in(std::uint64_t tick) {
    InsertionSearch search;
    search.tick = tick;
    search.purpose = world::Purpose::demand_place;
    const bool first = tick == 1;
    search.tries = first ? 200 : 12;
    search.margin = first ? 12 : 25;
    search.sight = first ? 0 : 60;
    search.everywhere = first;
    return search;
}

/// Is there somebody close before its bumper who points where it points? He may have just started:
/// then it goes next.
bool is_right_behind_another(const Car& car, const Cars& cars, const world::TickView& last) {
    constexpr double close = 8;          // [m]
    constexpr double beside = 1;         // [m]
    constexpr double same_course = 0.7;  // cosine
    const world::Extent body = world::extent_of(world::vehicle_models()[car.model]);
    const Eigen::Vector2d bumper = car.rear.head<2>() + body.front * car.ahead;
    const auto is_before_it =
        [&](const Eigen::Vector2d& rear, const Eigen::Vector2d& ahead, std::uint16_t model) {
            const world::Extent other = world::extent_of(world::vehicle_models()[model]);
            const Eigen::Vector2d gap = rear + other.rear * ahead - bumper;
            const double along = gap.dot(car.ahead);
            return along > -beside && along < close &&
                   std::abs(world::cross(car.ahead, gap)) < beside &&
                   ahead.dot(car.ahead) > same_course;
        };
    for (const Car& other : cars.all())
        if (other.id != car.id && is_before_it(other.rear.head<2>(), other.ahead, other.model))
            return true;
    for (const world::VehicleState& other : last.vehicles()) {
        const Eigen::Vector3d ahead =
            world::to_eigen(other.orientation()) * Eigen::Vector3d::UnitX();
        if (is_before_it(world::in_plan(other.position()), ahead.head<2>(), other.model()))
            return true;
    }
    return false;
}

/// Ids of those whom it waits for, of those whom these wait for, and so on: of who has stood.
std::vector<std::uint32_t> standing_before(const Car& car, const Cars& cars, double step) {
    std::vector<std::uint32_t> ids;
    const auto add = [&](const Car& one) {
        if (one.stuck_ticks * step < ring_stands)
            return;
        for (const auto* before : {&one.waits_for, &one.blocked_by})
            for (const std::uint32_t id : *before)
                if (std::find(ids.begin(), ids.end(), id) == ids.end())
                    ids.push_back(id);
    };
    add(car);
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (const Car* one = cars.find(ids[i]))
            add(*one);
    return ids;
}

}  // namespace

Demand::Demand(const world::EpisodeT& episode,
               const world::TownT& town,
               const RoadGraph& graph,
               const RightOfWay& right_of_way,
               const InsertionPoints& points,
               const Insertion& insertion)
    : episode_(&episode),
      town_(&town),
      graph_(&graph),
      right_of_way_(&right_of_way),
      points_(&points),
      insertion_(&insertion),
      step_(world::seconds(1, episode.step_ns)),
      at_home_(points.common_classes()) {}

bool Demand::add_car(Cars& cars,
                     std::span<const OccupiedBox> occupied,
                     double& scanned,
                     world::TickDraft& next) {
    Car car;
    car.id = next_id_;
    InsertionSearch search = search_in(next.tick.index);
    const double drawn =
        world::draw(episode_->seed, search.tick, world::Purpose::demand_model, draws_);
    car.model = demand_model(drawn, at_home_);
    search.car_length = world::vehicle_models()[car.model].length;
    search.car = model_class(car.model);
    search.seed = episode_->seed;
    search.item = draws_;
    search.scanned = scanned;
    const auto point = points_->find(occupied, search);
    draws_ = search.item;
    scanned = search.scanned;
    if (!point)
        return false;
    ++next_id_;
    car.speed = entry_speed(town_->lanes[point->lane], *point, search.margin / 2);
    insertion_->insert(car, *point, demand_type(car.model));
    const std::string name = world::vehicle_models()[car.model].name;
    cars.add(std::move(car), name, 0, next);
    return true;
}

void Demand::fill_up(Cars& cars, const world::TickView& last, world::TickDraft& next) {
    const auto all = cars.all();
    auto count = static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [](const Car& car) { return car.origin == Origin::demand; }));
    if (count >= episode_->cars)
        return;
    std::vector<OccupiedBox> occupied = points_->occupied(all, last, next);
    // Ids only grow, and lie above the scenario's: the new car is the last one.
    double scanned = 0;
    // Where a lorry finds no room a small car may.
    for (int refused = 0; count < episode_->cars && refused < (next.tick.index == 1 ? 10 : 1);) {
        if (add_car(cars, occupied, scanned, next)) {
            occupied.push_back(box_of(cars.all().back()));
            ++count;
        } else {
            ++refused;
        }
    }
    if (next.tick.index == 1 && count < episode_->cars) {
        world::EventT event;
        event.kind = world::EventKind::printed;
        event.text = fmt::format("traffic: {} cars were asked for, {} has room for {}",
                                 episode_->cars,
                                 town_->name,
                                 count);
        next.tick.events.push_back(std::move(event));
    }
}

void Demand::hear_of_wrecks(const world::TickView& last) {
    if (last.tick->events() == nullptr)
        return;
    for (const world::Event* event : *last.tick->events())
        if (event->kind() == world::EventKind::wrecked)
            wrecks_.insert(std::lower_bound(wrecks_.begin(), wrecks_.end(), event->actor()),
                           event->actor());
}

bool Demand::is_seen(const Eigen::Vector3d& p, const world::TickView& last, double sight) const {
    const auto vehicles = last.vehicles();
    return std::any_of(vehicles.begin(), vehicles.end(), [&](const world::VehicleState& vehicle) {
        return std::hypot(vehicle.position().x() - p.x(), vehicle.position().y() - p.y()) < sight &&
               !std::binary_search(wrecks_.begin(), wrecks_.end(), vehicle.id());
    });
}

bool Demand::is_longest_in_a_ring(const Car& car, const Cars& cars) const {
    if (car.stuck_ticks * step_ < ring_lasts)
        return false;
    const std::vector<std::uint32_t> held_by = standing_before(car, cars, step_);
    const auto is_in = [](const std::vector<std::uint32_t>& ids, const Car& one) {
        return std::find(ids.begin(), ids.end(), one.id) != ids.end();
    };
    return is_in(held_by, car) &&
           std::none_of(held_by.begin(), held_by.end(), [&](std::uint32_t id) {
               const Car* other = cars.find(id);
               return other != nullptr && other->origin == Origin::demand &&
                      other->stuck_ticks > car.stuck_ticks &&
                      is_in(standing_before(*other, cars, step_), car);
           });
}

bool Demand::is_stuck(const Car& car, const Cars& cars, const world::TickView& last) const {
    const double stood = car.stuck_ticks * step_;
    if (stood < soonest)
        return false;
    if ((stood > too_long && !is_seen(car.rear, last, out_of_sight)) ||
        (stood > far_too_long && !is_seen(car.rear, last, not_beside)) ||
        waits_for_ever(car, step_) || is_at_an_end(car, step_, *town_) ||
        faces_one_who_stands(car, step_, last) ||
        lies_in_one_who_stands(car, cars.all(), step_, *town_) || is_longest_in_a_ring(car, cars))
        return true;
    const bool is_in_junction =
        car.lane_position > at_its_edge && right_of_way_->is_crossed(car.lane);
    return ((stood > far_too_long_in_junction && is_in_junction) ||
            is_wedged(car, step_, last.index())) &&
           (stood > in_a_row || !is_seen(car.rear, last, not_beside) ||
            !is_right_behind_another(car, cars, last));
}

void Demand::remove_leaving(Cars& cars, const world::TickView& last, world::TickDraft& next) {
    hear_of_wrecks(last);
    for (std::size_t i = cars.size(); i-- > 0;) {
        const Car& car = cars[i];
        if (car.origin != Origin::demand || car.lane == world::none)
            continue;
        // Where the route ends, SUMO would take it out in the middle of the next step.
        const double left = town_->lanes[car.lane].sumo_length - car.lane_position;
        const bool arrives = car.dead_end && car.route.size() == 1 &&
                             car.route.front() == graph_->edge_of(car.lane) &&
                             left < 2 * step_ * (car.speed + 1) + 1;
        if (arrives || is_stuck(car, cars, last))
            cars.remove_from_sumo(i, next);
    }
}

void Demand::add_to(world::Hasher& hasher) const {
    hasher.add(next_id_);
    hasher.add(draws_);
    hasher.add(std::span<const std::uint32_t>(wrecks_));
}

}  // namespace reprise::traffic
