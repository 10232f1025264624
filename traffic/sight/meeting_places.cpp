#include "traffic/sight/meeting_places.h"

#include <algorithm>
#include <utility>

#include "traffic/cars/fleet.h"
#include "traffic/roads/crossing_lanes.h"
#include "traffic/sight/swing.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

constexpr double off_its_lane = 0.6;  // [m] of bumper or tail, from the middle of its lane

}  // namespace

MeetingPlaces::MeetingPlaces(const LaneLines& lines, const RoadGraph& graph)
    : lines_(&lines),
      graph_(&graph),
      crosses_(lanes_that_cross(lines.town())) {}

/// Between two lanes, as who changes them: a tail in the other one stays there while its own lane
/// stands.
bool MeetingPlaces::is_between_lanes(const Car& car) const {
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const world::LaneT& lane = lines_->town().lanes[car.lane];
    const double s = car.lane_position * lane.length / lane.sumo_length;
    for (const double behind : {0.0, model.length}) {
        const Eigen::Vector2d place =
            car.rear.head<2>() + (model.length - model.rear_overhang - behind) * car.ahead;
        const Eigen::Vector2d middle = lines_->position_at(car.lane, std::max(s - behind, 0.0));
        if ((place - middle).squaredNorm() > off_its_lane * off_its_lane)
            return true;
    }
    return false;
}

bool MeetingPlaces::Pose::is_of(const Car& car) const {
    return lane_position == car.lane_position && speed == car.speed && lane == car.lane &&
           model == car.model && yaw == car.yaw && travelled == car.trail.travelled() &&
           trail == car.trail.points_digest() && front == car.trail.front() && rear == car.rear &&
           route == car.route;
}

void MeetingPlaces::Pose::take(const Car& car) {
    lane = car.lane;
    model = car.model;
    lane_position = car.lane_position;
    speed = car.speed;
    yaw = car.yaw;
    travelled = car.trail.travelled();
    trail = car.trail.points_digest();
    front = car.trail.front();
    rear = car.rear;
    route = car.route;
}

/// One for each of them, in their order: of who was there before, his own.
void MeetingPlaces::remember(std::span<const Car> cars) {
    const auto is_its = [](const Car& car, const std::unique_ptr<Memory>& memory) {
        return memory != nullptr && memory->id == car.id;
    };
    if (std::equal(cars.begin(), cars.end(), memories_.begin(), memories_.end(), is_its))
        return;
    std::vector<std::unique_ptr<Memory>> before = std::move(memories_);
    memories_.clear();
    auto at = before.begin();
    for (const Car& car : cars) {
        while (at != before.end() && (*at)->id < car.id)
            ++at;
        if (at != before.end() && (*at)->id == car.id) {
            memories_.push_back(std::move(*at++));
            continue;
        }
        memories_.push_back(std::make_unique<Memory>());
        memories_.back()->id = car.id;
    }
}

MeetingPlaces::Place MeetingPlaces::place_of(const Car& car, const MetDriver& driver) const {
    const world::LaneT& lane = lines_->town().lanes[car.lane];
    const double left = (lane.sumo_length - car.lane_position) * lane.length / lane.sumo_length;
    const double length = 2 * driver.half_length;
    Place place;
    place.x = driver.middle.x();
    place.reach = driver.reach;
    place.area = area_ahead(car, *lines_, *graph_, driver.reach);
    place.area.take(place.area.low, Foresight::room);
    place.area.take(place.area.high, Foresight::room);
    place.lane = car.lane;
    place.is_turning = lane.kind == world::LaneKind::internal || left < driver.reach ||
                       length > longest_short_car || car.lane_position < length ||
                       crosses_[car.lane] || is_between_lanes(car);
    return place;
}

void MeetingPlaces::gather(std::span<const Car> cars, std::span<const MetDriver> drivers) {
    remember(cars);
    places_.clear();
    for (std::size_t i = 0; i < cars.size(); ++i) {
        if (drivers[i].car == nullptr)
            continue;
        Memory& memory = *memories_[i];
        if (!memory.pose.is_of(cars[i])) {
            memory.pose.take(cars[i]);
            memory.place = place_of(cars[i], drivers[i]);
            memory.is_foreseen = false;
        }
        places_.push_back(memory.place);
        places_.back().driver = static_cast<std::uint32_t>(i);
    }
    std::sort(places_.begin(), places_.end(), [](const Place& one, const Place& other) {
        return std::pair(one.x, one.driver) < std::pair(other.x, other.driver);
    });
}

Foresight* MeetingPlaces::foresight(std::size_t index, const MetDriver& driver) {
    Memory& memory = *memories_[index];
    if (memory.is_foreseen)
        memory.foresight.stay(*driver.car);
    else
        memory.foresight.look(*driver.car, *lines_, *graph_, driver.reach);
    memory.is_foreseen = true;
    return &memory.foresight;
}

bool MeetingPlaces::has_stayed(std::size_t index, const Car& car, bool takes_part) const {
    const Memory& memory = *memories_[index];
    return memory.id == car.id && (!takes_part || memory.pose.is_of(car));
}

}  // namespace reprise::traffic
