#include "traffic/cars/bends.h"

#include <algorithm>
#include <cmath>

#include <libsumo/libsumo.h>

#include "traffic/cars/fleet.h"
#include "traffic/cars/vehicle_lookup.h"
#include "traffic/roads/car_network.h"
#include "world/geometry2d.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

using Line = std::vector<Eigen::Vector2d>;

// Everyday drivers stay below 3 m/s^2 sideways in town; ours drive by up to 1.2 times what a lane
// allows (the speed factor in fleet.cpp), which is 1.44 times the acceleration.
constexpr double sideways = 3.0;   // [m/s^2]
constexpr double slowest = 1.5;    // [m/s] that anybody takes any bend at
constexpr double tight = 2.5;      // [m/s] slower bends turn the tail when the bumper is out
constexpr double braking = 1.5;    // [m/s^2] before a bend
constexpr double window = 3;       // [m] over which a way is one direction: about a wheelbase
constexpr double short_lane = 40;  // [m]
constexpr double tail = 4;         // [m] that still are in the bend when the bumper is out

Line in_plan_of(const world::LaneT& lane) {
    Line line;
    for (const world::Vec3& point : lane.centre)
        line.push_back(world::in_plan(point));
    return line;
}

/// The way from one end of a line: places on it by metres, beyond its ends straight on.
class Way {
  public:
    explicit Way(Line line) : line_(std::move(line)), ends_{0} {
        for (std::size_t i = 1; i < line_.size(); ++i)
            ends_.push_back(ends_.back() + (line_[i] - line_[i - 1]).norm());
    }

    double length() const { return ends_.back(); }

    Eigen::Vector2d at(double s) const {
        const auto above = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, s);
        const auto i = static_cast<std::size_t>(above - ends_.begin());
        const double piece = std::max(ends_[i] - ends_[i - 1], 1e-9);
        return line_[i - 1] + (line_[i] - line_[i - 1]) * ((s - ends_[i - 1]) / piece);
    }

    /// [1/m]
    double curvature(double s) const {
        const Eigen::Vector2d first = at(s) - at(s - window);
        const Eigen::Vector2d second = at(s + window) - at(s);
        const double turned = std::atan2(world::cross(first, second), first.dot(second));
        return std::abs(turned) / window;
    }

  private:
    Line line_;
    std::vector<double> ends_;  ///< [i] metres to line_[i]
};

double speed_for(double curvature) {
    return std::max(slowest, std::sqrt(sideways / std::max(curvature, 1e-6)));
}

/// The last metres of a line, or the first.
Line end_of(const Line& line) {
    const Way way(line);
    return {way.at(way.length() - 2 * window), way.at(way.length() - window)};
}

Line start_of(const Line& line) {
    const Way way(line);
    return {way.at(window), way.at(2 * window)};
}

bool is_slowed_whole(const world::LaneT& lane) {
    return world::is_for_cars(lane) &&
           (lane.kind == world::LaneKind::internal || lane.sumo_length < short_lane);
}

}  // namespace

Bends::Bends(const world::TownT& town) : town_(&town), bends_(town.lanes.size()) {
    // What is before and behind each lane of a junction: there its curve begins and ends.
    std::vector<Line> before(town.lanes.size());
    std::vector<Line> behind(town.lanes.size());
    for (const world::LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        for (const world::Link& link : lane.links) {
            const std::uint32_t next = link.via() == world::none ? link.to() : link.via();
            if (town.lanes[next].kind == world::LaneKind::internal)
                before[next] = end_of(in_plan_of(lane));
            const auto index = static_cast<std::size_t>(&lane - town.lanes.data());
            if (lane.kind == world::LaneKind::internal)
                behind[index] = start_of(in_plan_of(town.lanes[next]));
        }
    }
    std::vector<double> limits(town.lanes.size(), world::infinity);
    const std::vector<bool> is_known = lanes_in_sumo(town);
    for (std::size_t i = 0; i < town.lanes.size(); ++i)
        if (world::is_for_cars(town.lanes[i]) && is_known[i])
            limits[i] = add_lane(town.lanes[i], before[i], behind[i]);
    for (std::size_t i = 0; i < town.lanes.size(); ++i)
        if (is_slowed_whole(town.lanes[i]) && is_known[i])
            slow_before_bends(town.lanes[i], limits[i]);
    for (std::size_t i = 0; i < town.lanes.size(); ++i)
        if (town.lanes[i].kind == world::LaneKind::internal && limits[i] < tight)
            keep_slow_behind(town.lanes[i], limits[i]);
}

/// Who has just turned round in a few metres speeds up when all of him has.
void Bends::keep_slow_behind(const world::LaneT& lane, double limit) {
    for (const world::Link& link : lane.links)
        if (link.via() == world::none && link.to() != world::none) {
            std::vector<Bend>& bends = bends_[link.to()];
            bends.insert(bends.begin(), {0, tail, limit});
        }
}

/// Who comes onto a long lane too fast for a bend soon behind its start could not slow down there.
void Bends::slow_before_bends(const world::LaneT& lane, double limit) const {
    constexpr double firm_braking = 4;  // [m/s^2]
    double wanted = limit;
    for (const world::Link& link : lane.links)
        if (link.via() == world::none && link.to() != world::none)
            for (const Bend& bend : bends_[link.to()])
                wanted = std::min(
                    wanted, std::sqrt(bend.speed * bend.speed + 2 * firm_braking * bend.from));
    if (wanted < std::min(limit, lane.speed_limit))
        libsumo::Lane::setMaxSpeed(lane.name, wanted);
}

/// [m/s] that it is slowed to as a whole; infinite: is not.
double Bends::add_lane(const world::LaneT& lane, const Line& before, const Line& behind) {
    constexpr double spacing = 1;  // [m]
    const Line own = in_plan_of(lane);
    Line line = before;
    line.insert(line.end(), own.begin(), own.end());
    line.insert(line.end(), behind.begin(), behind.end());
    const Way way(line);
    const double start = before.empty() ? 0 : Way(before).length() + window;
    const double length = Way(own).length();
    const double to_sumo = lane.sumo_length / std::max(length, 1e-3);
    std::vector<Bend> bends;
    double least = lane.speed_limit;
    for (double s = 0; s <= length; s += spacing) {
        const double speed = speed_for(way.curvature(start + s));
        if (speed >= lane.speed_limit)
            continue;
        least = std::min(least, speed);
        // One bend for what belongs together.
        const double from = s * to_sumo;
        if (!bends.empty() && from - bends.back().to < 1.5 * spacing * to_sumo + tail &&
            std::abs(speed - bends.back().speed) < 0.1 * speed) {
            bends.back().to = from + tail;
            bends.back().speed = std::min(bends.back().speed, speed);
        } else {
            bends.push_back({from, from + tail, speed});
        }
    }
    if (bends.empty())
        return world::infinity;
    if (is_slowed_whole(lane)) {
        libsumo::Lane::setMaxSpeed(lane.name, least);
        return least;
    }
    bends_[static_cast<std::size_t>(&lane - town_->lanes.data())] = std::move(bends);
    return world::infinity;
}

/// [m/s] for the bends of its lane, or 0 where there is none ahead.
double Bends::limit_at(const Car& car) const {
    double least = world::infinity;  // [m^2/s^2]
    for (const Bend& bend : bends_[car.lane]) {
        if (car.lane_position > bend.to)
            continue;
        const double distance = std::max(bend.from - car.lane_position, 0.0);
        if (2 * braking * distance > least)  // those behind it are further
            break;
        least = std::min(least, bend.speed * bend.speed + 2 * braking * distance);
    }
    return least == world::infinity ? 0 : std::sqrt(least);
}

void Bends::follow(Cars& cars) const {
    constexpr double visible = 0.2;  // [m/s] less is not told
    for (Car& car : cars.all()) {
        if (car.sumo.empty() || car.origin == Origin::parked)
            continue;
        const bool free = car.lane != world::none && !car.speed_order;
        double limit = free && !bends_[car.lane].empty() ? limit_at(car) : 0;
        const double top = top_speed(car.model);
        if (limit >= top)
            limit = 0;
        if (limit == car.bend_limit || (limit != 0 && std::abs(limit - car.bend_limit) < visible))
            continue;
        const KnownVehicle known(car.sumo, car.in_sumo);
        libsumo::Vehicle::setMaxSpeed(car.sumo, limit == 0 ? top : limit);
        car.bend_limit = limit;
    }
}

}  // namespace reprise::traffic
