#include "traffic/scripted_spawns.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/orders.h"
#include "world/check.h"
#include "world/models/vehicle_classes.h"
#include "world/story/wording.h"

namespace reprise::traffic {

namespace {

using world::none;

[[noreturn]] void fail_spawn(const world::EpisodeT& episode,
                             const world::CommandT& command,
                             const std::string& what) {
    throw world::Error(fmt::format("{}:{}: spawn: {}", episode.scenario_path, command.line, what));
}

/// Does a parked car stand in the way of a car that drives in the middle of the lane?
bool stands_in_the_way(const world::LaneT& lane, const world::VehicleModel& model, double offset) {
    constexpr double half_car = 1.0;
    return world::is_for_cars(lane) && std::abs(offset) - model.width / 2 < half_car;
}

}  // namespace

/// The command's s is the origin's, as for every vehicle; SUMO wants the front bumper. Without a
/// lane any free place will do.
InsertionPoint ScriptedSpawns::point_of(const world::CommandT& command,
                                        const Cars& cars,
                                        const world::TickView& last,
                                        const world::TickDraft& next) const {
    if (command.lane != none) {
        if (command.lane >= town_->lanes.size())
            fail_spawn(*episode_, command, fmt::format("no lane of index {}", command.lane));
        return {command.lane, command.s + origin_to_front(command.model)};
    }
    const world::VehicleModel& model = world::vehicle_models()[command.model];
    InsertionSearch search{model.length,
                           world::class_bit("passenger"),
                           episode_->seed,
                           next.tick.index,
                           world::Purpose::place,
                           std::uint64_t{command.actor} << 16U,
                           400,
                           20,
                           40};
    const auto found = points_->find(points_->occupied(cars.all(), last, next), search);
    if (!found)
        fail_spawn(*episode_, command, "no free place for " + world::with_article(model.name));
    return *found;
}

bool ScriptedSpawns::is_on_road(std::uint32_t lane) const {
    return world::is_for_cars(town_->lanes[lane]) && graph_->edge_of(lane) != none;
}

/// Takes out background cars that stand there.
void ScriptedSpawns::make_room(const InsertionPoint& point,
                               double car_length,
                               Cars& cars,
                               world::TickDraft& next) const {
    for (std::size_t i = cars.size(); i-- > 0;) {
        const OccupiedBox other = box_of(cars[i]);
        if (cars[i].origin == Origin::demand &&
            !points_->is_free(point, car_length, std::span(&other, 1), 2, 0))
            cars.remove_from_sumo(i, next);
    }
}

void ScriptedSpawns::make_room_for(const world::CommandT& command,
                                   Cars& cars,
                                   world::TickDraft& next) const {
    if (command.has_pose)
        return make_room_at(command, cars, next);
    const world::VehicleModel& model = world::vehicle_models()[command.model];
    const double front = command.s + origin_to_front(command.model);
    make_room({command.lane, std::min(front, town_->lanes[command.lane].length)},
              model.length,
              cars,
              next);
}

/// Takes out background cars that stand within 2 m of the one that comes there.
void ScriptedSpawns::make_room_at(const world::CommandT& command,
                                  Cars& cars,
                                  world::TickDraft& next) const {
    const world::VehicleModel& model = world::vehicle_models()[command.model];
    const Eigen::Vector2d ahead(std::cos(command.heading), std::sin(command.heading));
    const Eigen::Vector2d middle(command.target.x(), command.target.y());
    const double to_middle = model.length / 2 - model.rear_overhang;
    for (std::size_t i = cars.size(); i-- > 0;) {
        if (cars[i].origin != Origin::demand)
            continue;
        const OccupiedBox other = box_of(cars[i]);
        const Eigen::Vector2d apart = other.centre - (middle + ahead * to_middle);
        const double along = std::abs(apart.dot(ahead));
        const double across = std::abs(apart.x() * ahead.y() - apart.y() * ahead.x());
        // As wide as it is long where it stands across.
        const double turn = std::abs(std::sin(other.yaw - command.heading));
        if (along < (model.length + other.length) / 2 + 2 && across < 2.6 + turn * other.length / 2)
            cars.remove_from_sumo(i, next);
    }
}

void ScriptedSpawns::spawn_at_pose(const world::CommandT& command,
                                   Car car,
                                   Cars& cars,
                                   world::TickDraft& next) const {
    make_room_at(command, cars, next);
    const Placements::Pose pose = placements_->pose_of(command);
    placements_->stand(car, pose);
    const bool on_road = car.lane != none;
    if (car.origin != Origin::parked) {
        if (!placements_->enter_sumo(car, next.tick.index))
            fail_spawn(*episode_,
                       command,
                       fmt::format("({:.2f}, {:.2f}) is on no lane for cars that leads its way",
                                   command.target.x(),
                                   command.target.y()));
    } else if (on_road) {
        const world::LaneT& lane = town_->lanes[car.lane];
        const double offset = world::project(lane, pose.rear).t;
        if (stands_in_the_way(lane, world::vehicle_models()[car.model], offset)) {
            using libsumo::Vehicle;
            const double s = car.lane_position / lane.sumo_length * lane.length;
            insertion_->insert(car, {car.lane, s}, scripted_type(car.model));
            Vehicle::setLaneChangeMode(car.sumo, 0);
            Vehicle::setSpeedMode(car.sumo, 0);
            Vehicle::setSpeed(car.sumo, 0);
            placements_->stand(car, pose);
        }
    }
    cars.add(std::move(car), command.text, command.line, next);
}

/// Stands the car there, `offset` [m] left of the middle of the lane.
void ScriptedSpawns::park(Car& car, const InsertionPoint& point, double offset) const {
    const world::LaneT& lane = town_->lanes[point.lane];
    const double length = origin_to_front(car.model);
    const world::LanePoint at = world::point_at(lane, point.s - length);
    const Eigen::Vector3d left(-std::sin(at.yaw), std::cos(at.yaw), 0);
    car.lane = point.lane;
    car.lane_position = std::min(point.s / lane.length, 1.0) * lane.sumo_length;
    car.rear = at.position + left * offset;
    car.turn_to(at.yaw);
    car.pitch = at.pitch;
    const Eigen::Vector3d behind(-std::cos(at.yaw), -std::sin(at.yaw), -std::tan(at.pitch));
    car.trail.start(car.rear - behind * length, behind, length);
}

void ScriptedSpawns::spawn(const world::CommandT& command,
                           Cars& cars,
                           const world::TickView& last,
                           world::TickDraft& next) const {
    const auto models = world::vehicle_models();
    REPRISE_CHECK(
        command.model < models.size() && cars.find(command.actor) == nullptr,
        fmt::format("actor {} model {} tick {}", command.actor, command.model, next.tick.index));
    const world::VehicleModel& model = models[command.model];
    const bool parked = command.driver == world::Driver::parked;
    Car car;
    car.id = command.actor;
    car.model = command.model;
    car.origin = parked ? Origin::parked : Origin::scripted;
    car.speed = parked ? 0 : command.speed;

    if (command.has_pose)
        return spawn_at_pose(command, std::move(car), cars, next);

    const InsertionPoint point = point_of(command, cars, last, next);
    const world::LaneT& lane = town_->lanes[point.lane];
    const bool on_road = is_on_road(point.lane);
    if (!parked && !on_road)
        fail_spawn(*episode_, command, fmt::format("lane '{}' is not for cars", lane.name));

    const InsertionPoint on_lane{point.lane, std::min(point.s, lane.length)};
    make_room(on_lane, model.length, cars, next);

    if (!parked || (on_road && stands_in_the_way(lane, model, command.offset))) {
        using libsumo::Vehicle;
        insertion_->insert(car, on_lane, scripted_type(car.model));
        Vehicle::setLaneChangeMode(car.sumo, parked ? 0 : changes_as_told);
        if (parked) {
            Vehicle::setSpeedMode(car.sumo, 0);
            Vehicle::setSpeed(car.sumo, 0);
        }
    }
    if (parked)
        park(car, point, command.offset);
    cars.add(std::move(car), command.text, command.line, next);
}

}  // namespace reprise::traffic
