#include "drivers/hazards.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "drivers/control/steering.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::drivers {

namespace {

constexpr double ample_room = 0.3;      // [m] between our side and theirs
constexpr double close_room = 0.2;      // [m]
constexpr double bare_room = 0.1;       // [m]
constexpr double stands = 0.1;          // [m/s]
constexpr double horizon = 1.5;         // [s] of foresight
constexpr double look_step = 0.25;      // [s]
constexpr double furthest_turn = 1.5;   // [rad] foreseen
constexpr double side_by_side = 0.9;    // cosine of the angle to us: drives as we do
constexpr double long_half = 3.5;       // [m]
constexpr double corner_margin = 0.1;   // [m] of the front's outer corner in a bend
constexpr double swing = 0.8;           // [m] to both sides
constexpr double turning = 0.5;         // [rad] over the junction,
constexpr double askew = 0.98;          // and cosine of 0.2 rad between body and lane elsewhere
constexpr std::size_t coarse_step = 8;  // [samples] = 4 m

}  // namespace

namespace {

/// How far the front's outer corner reaches from the path, in a bend of that curvature. [m]
double corner_reach(const world::VehicleModel& model, double curvature) {
    const double radius = 1 / std::abs(curvature);
    const double tracked = tracked_ahead(model);
    const double to_front = model.length - model.rear_overhang;
    const double rear = std::sqrt(std::max(radius * radius - tracked * tracked, 0.0));
    return std::hypot(rear + model.width / 2, to_front) - radius;
}

/// Where a body is that follows a lane.
struct LaneFoot {
    Eigen::Vector2d middle;
    Eigen::Vector2d direction;
};

/// Beyond its ends a lane goes on straight.
LaneFoot point_on(const world::LaneT& lane, double s) {
    const world::LanePoint at = world::point_at(lane, s);
    const Eigen::Vector2d direction(std::cos(at.yaw), std::sin(at.yaw));
    const double beyond = s - std::clamp(s, 0.0, lane.length);
    return {at.position.head<2>() + beyond * direction, direction};
}

/// Both ends of a long one are on its lane; in a bend its middle cuts the corner.
LaneFoot foot_on(const world::LaneT& lane, double s, double half_length) {
    if (half_length < long_half)
        return point_on(lane, s);
    const Eigen::Vector2d front = point_on(lane, s + half_length).middle;
    const Eigen::Vector2d rear = point_on(lane, s - half_length).middle;
    return {(front + rear) / 2, (front - rear).normalized()};
}

}  // namespace

struct Hazards::Scene {
    const Ego& ego;
    const Path& path;
    const DrivingStyle& style;
};

Hazards::Hazards(const world::TownT& town) : town_(&town) {
    coarse_.reserve(64);
    coarse_index_.reserve(64);
    overlaps_.reserve(64);
}

void Hazards::make_corridor(const Ego& ego, const Path& path, const DrivingStyle& style) {
    const double sight = std::clamp(20 + 4 * ego.speed / style.speed_share(), 30.0, 150.0);
    half_width_ = ego.model->width / 2 + side_margin_;
    sight_start_ = ego.front_s() - 1;
    coarse_.clear();
    coarse_index_.clear();
    box_ = {};
    model_ = ego.model;
    const std::size_t last = path.index(sight_start_ + sight);
    for (std::size_t i = path.index(sight_start_);; i = std::min(i + coarse_step, last)) {
        const Eigen::Vector2d point = path.points()[i].position.head<2>();
        coarse_.push_back(point);
        coarse_index_.push_back(i);
        box_.take(point);
        if (i >= last)
            break;
    }
    double widest = half_width_;
    for (std::size_t i = coarse_index_.front(); i <= last; ++i) {
        const SweptWidth width = corridor_at(path, i);
        widest = std::max({widest, width.left, width.right});
    }
    half_width_ = widest;
}

/// With the margin beside it. In a bend the front's outer corner leaves the path of the axles.
SweptWidth Hazards::corridor_at(const Path& path, std::size_t sample) const {
    constexpr double gentle = 0.03;  // [1/m] what the corner does then, the margin holds
    const double half = model_->width / 2 + side_margin_;
    SweptWidth width{half, half};
    if (!swept_.empty())
        width = {swept_[sample].left + side_margin_, swept_[sample].right + side_margin_};
    const double curvature = path.points()[sample].curvature;
    if (!swept_.empty() || std::abs(curvature) < gentle)
        return width;
    double& outer = curvature > 0 ? width.right : width.left;
    outer = std::max(outer, corner_reach(*model_, curvature) + corner_margin);
    return width;
}

void Hazards::look(const world::TickView& last,
                   const Ego& ego,
                   const Path& path,
                   const DrivingStyle& style,
                   std::span<const SweptWidth> swept,
                   Room room) {
    swept_ = swept;
    side_margin_ = room == Room::ample ? ample_room : room == Room::close ? close_room : bare_room;
    overlaps_.clear();
    acceleration_ = world::infinity;
    if (path.points().size() < 2)
        return;
    make_corridor(ego, path, style);
    horizon_ = horizon / style.speed_share();
    const Scene scene{ego, path, style};
    collect_bodies(last, ego.id, box_, horizon_, bodies_);
    for (Body& body : bodies_) {
        if (swings_out(body))
            body.half_width += swing;
        if (body.kind == BodyKind::walker || body.speed > stands) {
            body.half_width += ample_room - side_margin_;
            body.half_length += ample_room - side_margin_;
        }
        consider(body, scene);
    }
}

/// A long vehicle that turns in a junction, or in a tight bend anywhere: its tail leaves the way of
/// its front.
bool Hazards::swings_out(const Body& body) const {
    if (body.half_length < long_half || body.speed < 0.3 || body.lane >= town_->lanes.size())
        return false;
    const world::LaneT& lane = town_->lanes[body.lane];
    if (lane.kind == world::LaneKind::internal)
        return std::abs(world::wrap_angle(world::point_at(lane, lane.length).yaw -
                                          world::point_at(lane, 0).yaw)) > turning;
    const double ahead = world::point_at(lane, std::min(body.lane_s, lane.length)).yaw;
    return world::ahead_of(ahead).dot(body.direction) < askew;
}

void Hazards::consider(const Body& body, const Scene& scene) {
    const double distance = coarse_distance(body.centre) - body.radius() - half_width_;
    // Half a coarse step is the most that the coarse polyline can overlook.
    if (distance > 2.1 + horizon_ * body.speed)
        return;
    const double contact = distance > 2.1 ? world::infinity : first_contact(body, scene.path);
    if (contact == world::infinity) {
        foresee(body, scene, distance);
        return;
    }
    // Who comes towards us, as many do in junctions, drives off our path before we are there: until
    // then it is an obstacle that stands.
    const double along = std::max(body.velocity.dot(scene.path.at(contact).direction), 0.0);
    const double gap = contact - scene.ego.front_s();
    overlaps_.push_back({contact, along, body.id});
    acceleration_ =
        std::min(acceleration_, follow_acceleration(gap, scene.ego.speed, along, scene.style));
}

/// Somebody beside the path: will they be on it when we come?
void Hazards::foresee(const Body& body, const Scene& scene, double distance) {
    const Ego& ego = scene.ego;
    if (body.speed < 0.3 || distance > 2.1 + horizon_ * body.speed)
        return;
    // Who drives beside or behind us in our direction will look out for us.
    const Eigen::Vector2d nose =
        ego.position.head<2>() + (ego.model->length - ego.model->rear_overhang) * ego.direction;
    const double heading = body.direction.dot(ego.direction);
    const Eigen::Vector2d from_nose = body.centre - nose;
    const bool follows = from_nose.dot(ego.direction) < 0 && heading > 0.7;
    if (follows && !is_swung_into(body, ego))
        return;

    double entered = world::infinity;
    double left = 0;
    double contact = world::infinity;
    Body moved = body;
    for (double time = look_step; time <= horizon_; time += look_step) {
        if (!place_after(body, time, moved))
            break;
        const double touched = first_contact(moved, scene.path);
        if (touched == world::infinity)
            continue;
        entered = std::min(entered, time);
        left = time;
        contact = std::min(contact, touched);
    }
    if (contact == world::infinity)
        return;
    if (left > horizon_ - look_step)
        left += 1;  // still there at the end of our foresight
    if (follows) {
        acceleration_ = std::min(acceleration_, let_past(contact, left, scene));
        return;
    }

    const double along = moved.speed * moved.direction.dot(scene.path.at(contact).direction);
    const double gap = contact - ego.front_s();
    if (along > 0.7 * body.speed && along > 1) {
        // Joins our way: follow at once, from where it is now. Who comes onto it beside us at an
        // angle crosses before us first.
        const double behind = gap - along * entered;
        if (behind > 0 || heading > side_by_side) {
            if (behind > 0)
                acceleration_ = std::min(
                    acceleration_, follow_acceleration(behind, ego.speed, along, scene.style));
            return;
        }
    }
    // Crosses: into our side, where braking helps nobody, but who has hardly begun to drive stays
    // where he is, if it is at his nose; or before us, then only if we are there at the same time,
    // half a second more or less.
    constexpr double begins = 1;     // [m/s]
    constexpr double beside = -1.5;  // [m]
    if (gap < (std::abs(ego.speed) < begins ? beside : 0))
        return;
    const double speed = std::max(ego.speed, 2 * scene.style.speed_share());
    const double come = gap / speed;
    const double gone = (gap + ego.model->length + 2 * body.half_width) / speed;
    if (come > left + 0.5 || gone < entered - 0.5)
        return;
    acceleration_ = std::min(
        acceleration_, stop_acceleration(gap - 1, ego.speed, 3 * scene.style.share, scene.style));
}

/// Who follows or passes us looks out for us, but not for a body that swings out over his lane.
bool Hazards::is_swung_into(const Body& body, const Ego& ego) const {
    const double aside =
        std::abs(world::cross(ego.direction, body.centre - ego.position.head<2>()));
    return !swept_.empty() && body.kind != BodyKind::walker &&
           aside > ego.model->width / 2 + 0.9 * body.half_width;
}

/// Someone beside or behind us who will be where we swing out, until then [s]. [m/s^2]
double Hazards::let_past(double contact, double left, const Scene& scene) const {
    const double gap = contact - scene.ego.front_s();
    const double speed = std::max(scene.ego.speed, 2 * scene.style.speed_share());
    const double come = std::max(gap, 0.0) / speed;
    if (come > left + 0.5)
        return world::infinity;
    constexpr double hardest = 1.5;  // times that: there may be others behind us
    const double braking = 3 * scene.style.share;
    return std::max(stop_acceleration(gap - 1, scene.ego.speed, braking, scene.style),
                    -hardest * braking);
}

/// Where the body will be: along its lane when it follows one, as it moves and turns otherwise.
/// False when that cannot be said: past the end of a lane, where drivers choose.
bool Hazards::place_after(const Body& body, double time, Body& moved) const {
    if (body.lane < town_->lanes.size()) {
        const world::LaneT& lane = town_->lanes[body.lane];
        const double now = body.lane_s - body.half_length;
        const LaneFoot here = foot_on(lane, now, body.half_length);
        if (here.direction.dot(body.direction) > 0.95) {
            const double s = now + body.speed * time;
            if (s > lane.length && lane.kind == world::LaneKind::driving)
                return false;
            const LaneFoot then = foot_on(lane, s, body.half_length);
            moved.direction = then.direction;
            const double aside = world::cross(here.direction, body.centre - here.middle);
            moved.centre =
                then.middle + aside * Eigen::Vector2d(-then.direction.y(), then.direction.x());
            return true;
        }
    }
    const double turn = std::clamp(body.yaw_rate * time, -furthest_turn, furthest_turn);
    const Eigen::Rotation2Dd half(turn / 2);
    moved.direction = half * (half * body.direction);
    moved.centre = body.centre + time * (half * body.velocity) +
                   body.axle_ahead * (body.direction - moved.direction);
    return true;
}

double Hazards::coarse_distance(const Eigen::Vector2d& p_world) const {
    double least = world::infinity;
    for (const Eigen::Vector2d& point : coarse_)
        least = std::min(least, (point - p_world).squaredNorm());
    return std::sqrt(least);
}

/// Where along the path the corridor first touches the body, to 2 cm; infinity: nowhere.
double Hazards::first_contact(const Body& one, const Path& path) const {
    const double reach = one.radius() + half_width_ + 2.1;
    const auto nearest = std::min_element(
        coarse_.begin(), coarse_.end(), [&](const Eigen::Vector2d& p, const Eigen::Vector2d& q) {
            return (p - one.centre).squaredNorm() < (q - one.centre).squaredNorm();
        });
    const std::size_t beside = coarse_index_[static_cast<std::size_t>(nearest - coarse_.begin())];
    const Body body = one.seen_in_steps(path.points()[beside].direction, Path::spacing);
    const auto touches =
        [&](std::size_t sample, const Eigen::Vector3d& p, const Eigen::Vector2d& direction) {
            const SweptWidth width = corridor_at(path, sample);
            const Eigen::Vector2d left(-direction.y(), direction.x());
            const Eigen::Vector2d middle = p.head<2>() + (width.left - width.right) / 2 * left;
            const Eigen::Vector2d half = (width.left + width.right) / 2 * left;
            return std::abs(p.z() - body.z) < world::level_clearance && body.meets(middle, half);
        };
    for (std::size_t k = 0; k < coarse_.size(); ++k) {
        if ((coarse_[k] - body.centre).squaredNorm() > reach * reach)
            continue;
        const std::size_t from = coarse_index_[k == 0 ? 0 : k - 1];
        const std::size_t to = coarse_index_[std::min(k + 1, coarse_.size() - 1)];
        for (std::size_t i = from; i <= to; ++i) {
            const PathPoint& point = path.points()[i];
            if (!touches(i, point.position, point.direction))
                continue;
            if (i == coarse_index_.front())
                return path.s_of(i);
            // Between the last free sample and this one: halve.
            const PathPoint& before = path.points()[i - 1];
            double free = 0;
            double met = 1;
            for (int round = 0; round < 5; ++round) {
                const double middle = (free + met) / 2;
                const Eigen::Vector3d p =
                    before.position + middle * (point.position - before.position);
                const Eigen::Vector2d direction =
                    before.direction + middle * (point.direction - before.direction);
                (touches(i, p, direction) ? met : free) = middle;
            }
            return path.s_of(i - 1) + met * Path::spacing;
        }
    }
    return world::infinity;
}

}  // namespace reprise::drivers
