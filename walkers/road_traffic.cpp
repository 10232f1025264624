#include "walkers/road_traffic.h"

#include <algorithm>
#include <cmath>

#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::walkers {

namespace {

constexpr double sight = 60;         // [m] up the road
constexpr double longest_tail = 15;  // [m]
constexpr std::size_t most_approaches = 64;
constexpr double half_car = 1.25;      // [m] with what it needs beside it
constexpr double standing = 0.5;       // [m/s]
constexpr double painless = 2.0;       // [m/s^2] braking that nobody minds
constexpr double before_us = 0.7;      // [s] that somebody wants to be off before a car comes
constexpr double behind_it = 0.3;      // [s] and to step on behind it
constexpr double stop_short = 2;       // [m] that a car stops before a walker
constexpr double at_bumper = 0.5;      // [m] before one that stands there is room to walk
constexpr double for_long_on_it = 12;  // [s] who waits for it may be whom it waits for

bool seems_to_yield(double speed, double acceleration) {
    constexpr double slow = 2;        // [m/s]
    constexpr double braking = -0.3;  // [m/s^2]
    return std::abs(speed) < slow || acceleration < braking;
}

/// Where a polyline crosses a segment: [m] along both.
struct Meeting {
    double along_lane = 0;
    double along_way = 0;
    double sine = 1;  ///< of the angle between
};

std::vector<Meeting> meetings(const world::LaneT& lane,
                              const Eigen::Vector3d& from,
                              const Eigen::Vector3d& to) {
    constexpr double storey = 3;  // [m]
    std::vector<Meeting> found;
    const Eigen::Vector2d way = (to - from).head<2>();
    const double length = way.norm();
    double s = 0;
    for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i) {
        const Eigen::Vector2d start = world::in_plan(lane.centre[i]);
        const Eigen::Vector2d piece = world::in_plan(lane.centre[i + 1]) - start;
        const double across = world::cross(way, piece);
        const Eigen::Vector2d gap = start - from.head<2>();
        const double share = across != 0 ? world::cross(gap, piece) / across : -1;
        const double on_piece = across != 0 ? world::cross(gap, way) / across : -1;
        if (share >= 0 && share <= 1 && on_piece >= 0 && on_piece < 1 &&
            std::abs(lane.centre[i].z() - from.z()) < storey)
            found.push_back({s + on_piece * piece.norm(),
                             share * length,
                             std::abs(across) / (length * piece.norm())});
        s += piece.norm();
    }
    return found;
}

}  // namespace

RoadTraffic::RoadTraffic(const world::TownT& town, const world::LaneMap& lanes)
    : town_(&town),
      lanes_(&lanes),
      before_(town.lanes.size()),
      behind_(town.lanes.size()) {
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (!world::is_for_cars(town.lanes[i]))
            continue;
        for (const world::Link& link : town.lanes[i].links) {
            const std::uint32_t onto = link.via() != world::none ? link.via() : link.to();
            if (onto == world::none || !world::is_for_cars(town.lanes[onto]))
                continue;
            before_[onto].push_back(i);
            behind_[i].push_back(onto);
        }
    }
}

void RoadTraffic::add_approaches(std::uint32_t lane, double distance, Conflict& conflict) const {
    const auto add = [&](std::uint32_t one, double far) {
        const bool known = std::any_of(conflict.approaches.begin(),
                                       conflict.approaches.end(),
                                       [&](const auto& other) { return other.lane == one; });
        if (!known && conflict.approaches.size() < most_approaches)
            conflict.approaches.push_back({one, far});
        return !known;
    };
    const std::size_t first = conflict.approaches.size();
    add(lane, distance);
    for (std::size_t i = first; i < conflict.approaches.size(); ++i) {
        const auto [on, far] = conflict.approaches[i];
        if (far < 0 || far >= sight)
            continue;
        for (const std::uint32_t onto : before_[on])
            add(onto, far + town_->lanes[onto].length);
    }
    // Whose bumper is past the place may have his tail on it, whichever way he turns behind it.
    std::vector<Conflict::Approach> tails{{lane, distance}};
    for (std::size_t i = 0; i < tails.size(); ++i) {
        const auto [on, far] = tails[i];
        const double tail = far - town_->lanes[on].length;
        if (tail <= -longest_tail)
            continue;
        for (const std::uint32_t onto : behind_[on])
            if (add(onto, tail))
                tails.push_back({onto, tail});
    }
}

std::vector<Conflict> RoadTraffic::conflicts(const Eigen::Vector3d& from,
                                             const Eigen::Vector3d& to) const {
    constexpr double beside = 5;  // [m]
    std::vector<Conflict> found;
    const double reach = (to - from).norm() / 2 + beside;
    for (const std::uint32_t i : lanes_->near((from + to) / 2, reach)) {
        const world::LaneT& lane = town_->lanes[i];
        if (!world::is_for_cars(lane))
            continue;
        for (const Meeting& meeting : meetings(lane, from, to)) {
            Conflict conflict;
            conflict.at = meeting.along_way;
            conflict.half_width = half_car / std::max(meeting.sine, 0.5);
            add_approaches(i, meeting.along_lane, conflict);
            found.push_back(std::move(conflict));
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const Conflict& one, const Conflict& other) {
        return one.at < other.at;
    });
    return found;
}

void RoadTraffic::look(std::span<const RoadUser> users) {
    comers_.clear();
    for (const RoadUser& user : users)
        if (user.lane != world::none)
            comers_.push_back({user.lane,
                               user.front_s,
                               std::abs(user.speed),
                               world::vehicle_models()[user.model].length,
                               user.stood,
                               seems_to_yield(user.speed, user.acceleration),
                               user.id});
    std::sort(comers_.begin(), comers_.end(), [](const Comer& one, const Comer& other) {
        return one.lane != other.lane ? one.lane < other.lane : one.id < other.id;
    });
}

std::span<const RoadTraffic::Comer> RoadTraffic::comers_on(std::uint32_t lane) const {
    const auto first = std::lower_bound(
        comers_.begin(), comers_.end(), lane, [](const Comer& one, std::uint32_t wanted) {
            return one.lane < wanted;
        });
    auto last = first;
    while (last != comers_.end() && last->lane == lane)
        ++last;
    return {first, last};
}

std::uint32_t RoadTraffic::long_waiting(const Conflict& conflict) const {
    constexpr double for_long = 15;  // [s]
    constexpr double close = 10;     // [m] over two crossings one behind the other as well
    double nearest = close;
    std::uint32_t id = 0;
    for (const Conflict::Approach& approach : conflict.approaches) {
        const auto& links = town_->lanes[approach.lane].links;
        if (approach.distance < 0 ||
            std::any_of(links.begin(), links.end(), [](const world::Link& link) {
                return link.signal() != world::none;
            }))
            continue;
        for (const Comer& comer : comers_on(approach.lane)) {
            const double left = approach.distance - comer.s;
            if (comer.stood < for_long || comer.speed > standing || left < 0 || left >= nearest)
                continue;
            nearest = left;
            id = comer.id;
        }
    }
    return id;
}

bool RoadTraffic::is_before(const Conflict& conflict, std::uint32_t id) const {
    for (const Conflict::Approach& approach : conflict.approaches)
        for (const Comer& comer : comers_on(approach.lane))
            if (comer.id == id && approach.distance - comer.s + comer.length >= -1)
                return true;
    return false;
}

bool RoadTraffic::is_free(const Conflict& conflict,
                          Stay stay,
                          Trust trust,
                          bool around_standing) const {
    for (const Conflict::Approach& approach : conflict.approaches) {
        for (const Comer& comer : comers_on(approach.lane)) {
            const double left = approach.distance - comer.s;  // [m] of its front to the place
            if (left + comer.length < -1)
                continue;  // is past it
            if (comer.speed < standing &&
                (left >= at_bumper || around_standing || comer.stood > for_long_on_it))
                continue;
            if (comer.speed < standing)
                return false;  // stands on it
            const double clears = (left + comer.length + 1) / std::max(comer.speed, standing);
            if (clears + behind_it < stay.from)
                continue;  // is past it by then
            const double arrives = left / (comer.speed + 1);
            if (arrives > stay.to + before_us)
                continue;  // comes later
            const double room = left - stop_short;
            const bool trusted = trust == Trust::all || (trust == Trust::seen && comer.yields);
            if (trusted && room > 0 && comer.speed * comer.speed / (2 * room) < painless)
                continue;
            return false;
        }
    }
    return true;
}

}  // namespace reprise::walkers
