#include "traffic/places.h"

#include <algorithm>
#include <cmath>

#include "world/models/vehicle_classes.h"

namespace reprise::traffic {

namespace {

constexpr double behind = 1;  // [m] kept free at the start of a lane
constexpr double ahead = 4;   // [m] and before its end

Eigen::Vector2d direction(double yaw) {
    return {std::cos(yaw), std::sin(yaw)};
}

}  // namespace

Places::Places(const world::TownT& town, const RoadGraph& graph) : town_(&town), graph_(&graph) {
    double sum = 0;
    for (std::uint32_t i = 0; i < town.lanes.size(); ++i) {
        if (town.lanes[i].kind != world::LaneKind::driving)
            continue;
        sum += town.lanes[i].length;
        lanes_.push_back(i);
        ends_.push_back(sum);
    }
}

std::optional<Place> Places::at(double drawn, double car_length, world::ClassSet car) const {
    const double metre = drawn * ends_.back();
    const auto found = std::upper_bound(ends_.begin(), ends_.end(), metre);
    const auto index = std::min(static_cast<std::size_t>(found - ends_.begin()), lanes_.size() - 1);
    const std::uint32_t lane = lanes_[index];
    const double length = town_->lanes[lane].length;
    const double s = metre - (ends_[index] - length);
    if (s < car_length + behind || s > length - ahead || !graph_->may_use(lane, car))
        return std::nullopt;
    return Place{lane, s};
}

world::ClassSet Places::common_classes() const {
    world::ClassSet common = 0;
    const double total = ends_.empty() ? 0 : ends_.back();
    for (const std::string_view name : world::vehicle_class_names()) {
        double open = 0;
        for (const std::uint32_t lane : lanes_)
            if (graph_->may_use(lane, world::class_bit(name)))
                open += town_->lanes[lane].length;
        if (open >= total / 2)
            common |= world::class_bit(name);
    }
    return common;
}

Taken Places::ground(const Place& place, double car_length) const {
    const world::LanePoint at = world::point_at(town_->lanes[place.lane], place.s - car_length / 2);
    return {at.position.head<2>(), at.yaw, car_length, false};
}

bool Places::is_free(const Place& place,
                     double car_length,
                     std::span<const Taken> taken,
                     double margin,
                     double sight) const {
    constexpr double beside = 2.6;  // [m] between the middle lines of cars that pass each other
    const Taken ground = this->ground(place, car_length);
    const Eigen::Vector2d along = direction(ground.yaw);
    return std::none_of(taken.begin(), taken.end(), [&](const Taken& other) {
        const Eigen::Vector2d apart = other.centre - ground.centre;
        if (other.seen_from && apart.norm() < sight)
            return true;
        const double dx = std::abs(apart.dot(along));
        const double dy = std::abs(apart.x() * along.y() - apart.y() * along.x());
        // A car across the way reaches out to the side.
        const double across =
            std::abs(direction(other.yaw).dot(Eigen::Vector2d(-along.y(), along.x())));
        return dy < beside + across * other.length / 2 &&
               dx < (car_length + other.length) / 2 + margin;
    });
}

}  // namespace reprise::traffic
