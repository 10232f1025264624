#include "traffic/sight/way_ahead.h"

#include <algorithm>
#include <cmath>

#include "traffic/cars/fleet.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double comes_back = 6;  // [m] of driving until it is back in the middle of its lane

}  // namespace

bool overlap(const BodyBox& one, const BodyBox& other) {
    const Eigen::Vector2d apart = other.middle - one.middle;
    const double reach = one.half_length + one.half_width + other.half_length + other.half_width;
    if (apart.squaredNorm() > reach * reach)
        return false;
    const double along = std::abs(one.ahead.dot(other.ahead));
    const double across = std::abs(world::cross(one.ahead, other.ahead));
    const auto is_apart = [&](const BodyBox& own, const BodyBox& its) {
        return std::abs(apart.dot(own.ahead)) >
                   own.half_length + its.half_length * along + its.half_width * across ||
               std::abs(world::cross(own.ahead, apart)) >
                   own.half_width + its.half_length * across + its.half_width * along;
    };
    return !is_apart(one, other) && !is_apart(other, one);
}

std::uint32_t lane_after(std::uint32_t lane,
                         const Car& car,
                         const world::TownT& town,
                         const RoadGraph& graph) {
    const auto next = [](const world::Link& link) {
        return link.via() != none ? link.via() : link.to();
    };
    const world::LaneT& here = town.lanes[lane];
    if (here.kind == world::LaneKind::internal)
        return here.links.empty() ? none : next(here.links.front());
    const auto at = std::find(car.route.begin(), car.route.end(), graph.edge_of(lane));
    if (at == car.route.end() || at + 1 == car.route.end())
        return none;
    for (const world::Link& link : here.links)
        if (link.to() != none && graph.edge_of(link.to()) == *(at + 1))
            return next(link);
    return none;
}

WayAhead::WayAhead(const Car& car, const world::TownT& town, const RoadGraph& graph, double reach)
    : car_(&car),
      to_axle_(origin_to_front(car.model)),
      half_length_(world::vehicle_models()[car.model].length / 2),
      half_width_(world::vehicle_models()[car.model].width / 2),
      rear_overhang_(world::vehicle_models()[car.model].rear_overhang),
      rolled_((car.rear - car.trail.rear()).head<2>()) {
    constexpr std::size_t most_lanes = 16;  // nobody drives over more of them in seconds
    const Eigen::Vector2d front = car.trail.front().head<2>();
    add(front);
    double start = 0;  // [m] on the lane
    Eigen::Vector2d aside(0, 0);
    for (std::uint32_t lane = car.lane; lane != none && lanes_.size() < most_lanes;
         lane = lane_after(lane, car, town, graph)) {
        const world::LaneT& on = town.lanes[lane];
        if (lanes_.empty()) {
            start = std::min(car.lane_position / on.sumo_length, 1.0) * on.length;
            aside = front - world::point_at(on, start).position.head<2>();
        }
        lanes_.push_back(lane);
        double s = 0;
        for (std::size_t i = 0; i < on.centre.size(); ++i) {
            const Eigen::Vector2d p = world::in_plan(on.centre[i]);
            if (i > 0)
                s += (p - world::in_plan(on.centre[i - 1])).norm();
            if (s > start)
                add(p + aside * std::max(0.0, 1 - length() / comes_back));
        }
        start = 0;
        if (length() > reach)
            break;
    }
    if (points_.size() == 1)
        add(front + world::ahead_of(car.yaw) * 0.01);
}

void WayAhead::add(const Eigen::Vector2d& p) {
    ends_.push_back(points_.empty() ? 0 : ends_.back() + (p - points_.back()).norm());
    points_.push_back(p);
}

Eigen::Vector2d WayAhead::bumper_at(double driven) const {
    const auto above = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, driven);
    const auto i = static_cast<std::size_t>(above - ends_.begin());
    const double piece = std::max(ends_[i] - ends_[i - 1], 1e-9);
    const double share = std::min((driven - ends_[i - 1]) / piece, 1.0);
    return points_[i - 1] + (points_[i] - points_[i - 1]) * share;
}

BodyBox WayAhead::at(double driven) const {
    driven = std::min(driven, length());
    const Eigen::Vector2d front = bumper_at(driven);
    Eigen::Vector2d rear = driven >= to_axle_ ? bumper_at(driven - to_axle_)
                                              : car_->trail.behind(to_axle_ - driven).head<2>();
    rear += rolled_ * std::max(0.0, 1 - driven / comes_back);
    BodyBox box;
    const Eigen::Vector2d body = front - rear;
    box.ahead =
        body.squaredNorm() > 1e-6 ? Eigen::Vector2d(body.normalized()) : world::ahead_of(car_->yaw);
    box.half_length = half_length_;
    box.half_width = half_width_;
    box.middle = rear + (half_length_ - rear_overhang_) * box.ahead;
    return box;
}

world::Box WayAhead::around(double driven) const {
    constexpr double spacing = 1;  // [m]
    constexpr double bulge = 0.1;  // [m] of the trail between two places
    world::Box box;
    for (double behind = 0; behind < to_axle_ + spacing; behind += spacing)
        box.take(car_->trail.behind(std::min(behind, to_axle_)).head<2>());
    for (std::size_t i = 0; i < points_.size(); ++i) {
        box.take(points_[i]);
        if (ends_[i] > driven)
            break;
    }
    // From axle to bumper a body is as wide as it is; behind the axle its tail swings out.
    const double aside = std::hypot(rear_overhang_, half_width_) + rolled_.norm() + bulge;
    box.low -= Eigen::Vector2d::Constant(aside);
    box.high += Eigen::Vector2d::Constant(aside);
    return box;
}

}  // namespace reprise::traffic
