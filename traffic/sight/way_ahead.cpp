#include "traffic/sight/way_ahead.h"

#include <algorithm>
#include <cmath>

#include "traffic/cars/fleet.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::traffic {

namespace {

using world::none;

constexpr double comes_back = 6;        // [m] of driving until it is back in the middle of its lane
constexpr double least_chord = 0.6;     // of the way from axle to bumper, on the tightest bend
constexpr std::size_t most_lanes = 16;  // nobody drives over more of them in seconds

/// [m] that the bumper may have been beside the straight line from where it is to the rear axle: no
/// further than the metres between them allow.
double bulge_of(double to_axle, const Eigen::Vector2d& front_to_rear) {
    return std::sqrt(std::max(0.0, to_axle * to_axle - front_to_rear.squaredNorm())) / 2;
}

/// Grows to hold what it takes, number by number: quicker than by vectors.
struct Bounds {
    double west = world::infinity, east = -world::infinity;
    double south = world::infinity, north = -world::infinity;

    void take(const Eigen::Vector2d& p) {
        west = std::min(west, p.x());
        east = std::max(east, p.x());
        south = std::min(south, p.y());
        north = std::max(north, p.y());
    }

    world::Box widened(double margin) const {
        return {{west - margin, south - margin}, {east + margin, north + margin}};
    }
};

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

double depth(const BodyBox& one, const BodyBox& other) {
    const Eigen::Vector2d apart = other.middle - one.middle;
    const double along = std::abs(one.ahead.dot(other.ahead));
    const double across = std::abs(world::cross(one.ahead, other.ahead));
    const auto least = [&](const BodyBox& own, const BodyBox& its) {
        return std::min(own.half_length + its.half_length * along + its.half_width * across -
                            std::abs(apart.dot(own.ahead)),
                        own.half_width + its.half_length * across + its.half_width * along -
                            std::abs(world::cross(own.ahead, apart)));
    };
    return std::max(0.0, std::min(least(one, other), least(other, one)));
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

world::Box area_ahead(const Car& car,
                      const LaneLines& lines,
                      const RoadGraph& graph,
                      double reach) {
    constexpr double rounding = 0.01;  // [m]
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    const double to_axle = origin_to_front(car.model);
    const Eigen::Vector2d front = car.trail.front().head<2>();
    const Eigen::Vector2d rear = car.trail.rear().head<2>();
    Bounds box;
    box.take(front);
    box.take(rear);
    const double bulge = bulge_of(to_axle, front - rear);
    std::uint32_t lane = car.lane;
    const world::LaneT& here = lines.town().lanes[lane];
    double start = std::clamp(car.lane_position / here.sumo_length, 0.0, 1.0) * here.length;
    const double aside = (front - lines.position_at(lane, start)).norm();
    double left = reach + 2 * aside + rounding;
    for (std::size_t i = 0; i < most_lanes && lane != none && left > 0; ++i) {
        const auto points = lines.points(lane);
        const auto metres = lines.metres(lane);
        auto next = static_cast<std::size_t>(std::upper_bound(metres.begin(), metres.end(), start) -
                                             metres.begin());
        for (; next < points.size() && metres[next] - start < left; ++next)
            box.take(points[next]);
        if (next < points.size()) {
            const double piece = metres[next] - metres[next - 1];
            const double share = (start + left - metres[next - 1]) / piece;
            box.take(points[next - 1] + share * (points[next] - points[next - 1]));
            break;
        }
        left -= std::max(metres.back() - start, 0.0);
        start = 0;
        lane = lane_after(lane, car, lines.town(), graph);
    }
    // From axle to bumper a body is as wide as it is; behind the axle its tail swings out.
    const double rolled = (car.rear.head<2>() - rear).norm();
    const double beside = std::hypot(model.rear_overhang, model.width / 2) + rolled +
                          std::max(bulge, aside) + rounding;
    return box.widened(beside);
}

/// Where the bumper has driven so far, between the point before this one and this one.
inline Eigen::Vector2d WayAhead::between(std::size_t i, double driven) const {
    const double piece = std::max(ends_[i] - ends_[i - 1], 1e-9);
    const double share = std::min((driven - ends_[i - 1]) / piece, 1.0);
    return points_[i - 1] + (points_[i] - points_[i - 1]) * share;
}

inline Eigen::Vector2d WayAhead::bumper_at(double driven) const {
    std::size_t i = 1;  // of few points: quicker one by one
    for (const std::size_t last = ends_.size() - 1; i < last && ends_[i] <= driven; ++i) {
    }
    return between(i, driven);
}

void WayAhead::look(const Car& car, const LaneLines& lines, const RoadGraph& graph, double reach) {
    const world::VehicleModel& model = world::vehicle_models()[car.model];
    car_ = &car;
    to_axle_ = origin_to_front(car.model);
    half_length_ = model.length / 2;
    half_width_ = model.width / 2;
    rear_overhang_ = model.rear_overhang;
    rolled_ = (car.rear - car.trail.rear()).head<2>();
    lanes_.clear();
    points_.clear();
    ends_.clear();
    const Eigen::Vector2d front = car.trail.front().head<2>();
    add(front);
    double start = 0;  // [m] on the lane
    Eigen::Vector2d aside(0, 0);
    for (std::uint32_t lane = car.lane; lane != none && lanes_.size() < most_lanes;
         lane = lane_after(lane, car, lines.town(), graph)) {
        if (lanes_.empty()) {
            const world::LaneT& on = lines.town().lanes[lane];
            start = std::min(car.lane_position / on.sumo_length, 1.0) * on.length;
            aside = front - lines.position_at(lane, start);
        }
        lanes_.push_back(lane);
        const auto points = lines.points(lane);
        const auto metres = lines.metres(lane);
        for (auto i = static_cast<std::size_t>(
                 std::upper_bound(metres.begin(), metres.end(), start) - metres.begin());
             i < points.size();
             ++i)
            add(points[i] + aside * std::max(0.0, 1 - length() / comes_back));
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

BodyBox WayAhead::corridor(double driven, const Eigen::Vector2d& ahead) const {
    constexpr double rounding = 0.01;  // [m]
    const Eigen::Vector2d& front = points_.front();
    const Eigen::Vector2d rear = car_->trail.rear().head<2>();
    Bounds box;  // in the frame of today's body, from its bumper
    const auto take = [&](const Eigen::Vector2d& p) {
        const Eigen::Vector2d offset = p - front;
        box.take({offset.dot(ahead), world::cross(ahead, offset)});
    };
    take(rear);
    for (std::size_t i = 0; i < points_.size() && ends_[i] < driven; ++i)
        take(points_[i]);
    take(bumper_at(std::min(driven, length())));
    const double off = bulge_of(to_axle_, front - rear) + rolled_.norm() + rounding;
    // A body that stands askew in the corridor has its tail further out.
    const Eigen::Vector2d extent(box.east - box.west, box.north - box.south);
    const double askew = std::min(1.0, (extent.y() + 2 * off) / (least_chord * to_axle_));
    const Eigen::Vector2d middle((box.west + box.east) / 2, (box.south + box.north) / 2);
    BodyBox around;
    around.ahead = ahead;
    around.middle = front + middle.x() * ahead + middle.y() * world::turned_left(ahead);
    around.half_length = extent.x() / 2 + off + std::hypot(rear_overhang_, half_width_);
    around.half_width = extent.y() / 2 + off + half_width_ + askew * rear_overhang_;
    return around;
}

void WayAhead::surround(std::span<Stretch> stretches) const {
    constexpr double rounding = 0.01;  // [m]
    const double end = length();
    const Eigen::Vector2d& front = points_.front();
    const Eigen::Vector2d rear = car_->trail.rear().head<2>();
    const double beside = std::hypot(rear_overhang_, half_width_) + rolled_.norm() + rounding;
    const double behind = beside + bulge_of(to_axle_, front - rear);
    const std::size_t last = points_.size() - 1;
    std::size_t first = 1;  // of the points ahead of where the axle begins
    for (Stretch& stretch : stretches) {
        const double from = std::min(stretch.from, end) - to_axle_;
        const double to = std::min(stretch.to, end);
        Bounds bounds;
        if (from < 0) {  // its axle comes along where the bumper has been
            bounds.take(rear);
            bounds.take(front);
        } else {
            while (first < last && ends_[first] <= from)
                ++first;
            bounds.take(between(first, from));
        }
        std::size_t next = first;
        for (; next < last && ends_[next] < to; ++next)
            bounds.take(points_[next]);
        bounds.take(between(next, to));
        stretch.area = bounds.widened(from < 0 ? behind : beside);
    }
}

/// Where both axle and bumper move by a metre the middle between them moves by no more, but that a
/// turning axle's end carries the overhang along.
double WayAhead::most_moved() const {
    constexpr double turning = 1.3;
    return turning + rolled_.norm() / comes_back;
}

}  // namespace reprise::traffic
