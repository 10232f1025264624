#include "drivers/bodies.h"

#include <algorithm>
#include <cmath>

#include "drivers/control/ego.h"
#include "world/frames.h"
#include "world/models/doors.h"
#include "world/models/prop_models.h"

namespace reprise::drivers {

namespace {

constexpr double least_prop = 0.2;  // [m] high: what is lower passes below the car

/// Rear axle, heading and model give the box.
void set_box(Body& body, const Eigen::Vector2d& rear_axle, const world::VehicleModel& model) {
    body.half_length = model.length / 2;
    body.half_width = model.width / 2;
    body.centre = rear_axle + (body.half_length - model.rear_overhang) * body.direction;
    body.kind = world::is_two_wheeler(model.body) ? BodyKind::two_wheeler : BodyKind::vehicle;
}

/// As far as one sees: no foot on the brake, or the hazard lights on.
bool looks_abandoned(std::uint16_t lamps) {
    return (lamps & world::lamp_brake) == 0 || has_hazard_lights(lamps);
}

Body body_of(const world::VehicleState& state) {
    const Ego other = ego_of(state);
    Body body;
    body.direction = other.direction;
    set_box(body, other.position.head<2>(), *other.model);
    body.velocity = {state.velocity().x(), state.velocity().y()};
    body.speed = body.velocity.norm();
    body.z = other.position.z();
    body.yaw_rate = other.yaw_rate;
    body.axle_ahead = other.model->rear_overhang - body.half_length;
    body.id = state.id();
    body.abandoned = looks_abandoned(state.lamps());
    return body;
}

Body body_of(const world::CarState& car) {
    const double speed = static_cast<double>(car.speed());
    const double yaw = static_cast<double>(car.yaw());
    Body body;
    body.direction = {std::cos(yaw), std::sin(yaw)};
    set_box(body, {car.position().x(), car.position().y()}, world::vehicle_models()[car.model()]);
    body.velocity = speed * body.direction;
    body.speed = std::abs(speed);
    body.z = car.position().z();
    body.id = car.id();
    body.lane = car.lane();
    body.lane_s = static_cast<double>(car.lane_s());
    body.abandoned = looks_abandoned(car.lamps());
    return body;
}

Body body_of(const world::WalkerState& walker) {
    const double speed = static_cast<double>(walker.speed());
    const double yaw = static_cast<double>(walker.yaw());
    Body body;
    body.direction = {std::cos(yaw), std::sin(yaw)};
    body.centre = {walker.position().x(), walker.position().y()};
    body.half_length = body.half_width = 0.25;
    if (walker.down())
        body.half_length = 0.9;
    body.velocity = speed * body.direction;
    body.speed = std::abs(speed);
    body.z = walker.position().z();
    body.id = walker.id();
    body.kind = BodyKind::walker;
    body.abandoned = walker.down();
    return body;
}

Body body_of(const world::PropState& prop, const world::PropModel& model) {
    Body body;
    body.direction = world::level_direction(prop.orientation());
    body.centre = {prop.position().x(), prop.position().y()};
    body.half_length = model.length / 2;
    body.half_width = model.width / 2;
    body.velocity = {prop.velocity().x(), prop.velocity().y()};
    body.speed = body.velocity.norm();
    body.z = prop.position().z();
    body.id = prop.id();
    body.kind = BodyKind::prop;
    body.abandoned = true;
    return body;
}

/// An open door is part of what stands there.
void collect_doors(const world::TickView& last, std::uint32_t self, std::vector<Body>& bodies) {
    for (const world::Door& door : last.doors()) {
        const world::VehicleState* vehicle = world::find(last.vehicles(), door.actor());
        const world::CarState* car = world::find(last.cars(), door.actor());
        if (door.actor() == self || (vehicle == nullptr && car == nullptr))
            continue;
        const std::uint16_t model = vehicle != nullptr ? vehicle->model() : car->model();
        const Eigen::Isometry3d pose =
            vehicle != nullptr ? world::pose(vehicle->position(), vehicle->orientation())
                               : world::pose(car->position(),
                                             static_cast<double>(car->yaw()),
                                             static_cast<double>(car->pitch()));
        const world::DoorLeaf leaf =
            world::door_leaf(world::vehicle_models()[model], pose, door.door(), door.angle());
        const Eigen::Vector3d along = leaf.pose.linear().col(0);
        Body body;
        body.centre = leaf.pose.translation().head<2>();
        body.direction = along.head<2>().normalized();
        body.half_length = leaf.half.x();
        body.half_width = leaf.half.y();
        body.velocity.setZero();
        body.z = pose.translation().z();
        body.id = door.actor();
        body.kind = BodyKind::door;
        body.abandoned = true;
        bodies.push_back(body);
    }
}

}  // namespace

/// Clips the segment against both pairs of sides.
bool Body::meets(const Eigen::Vector2d& middle, const Eigen::Vector2d& half) const {
    const Eigen::Vector2d from = middle - centre;
    double first = -1;
    double last = 1;
    const auto clip = [&](double at, double step, double size) {
        if (std::abs(step) < 1e-12)
            return std::abs(at) <= size;
        const double u = (-size - at) / step;
        const double v = (size - at) / step;
        first = std::max(first, std::min(u, v));
        last = std::min(last, std::max(u, v));
        return first <= last;
    };
    return clip(from.dot(direction), half.dot(direction), half_length) &&
           clip(world::cross(direction, from), world::cross(direction, half), half_width);
}

Body Body::seen_in_steps(const Eigen::Vector2d& ahead, double step) const {
    constexpr double rounding = 1e-9;  // [m]
    const double along = std::abs(direction.dot(ahead));
    const double across = std::abs(world::cross(direction, ahead));
    Body seen = *this;
    if (half_length * along + half_width * across < step / 2 - rounding) {
        seen.direction = ahead;
        seen.half_length = step / 2 + rounding;
        seen.half_width = half_length * across + half_width * along;
    }
    return seen;
}

void collect_bodies(const world::TickView& last,
                    std::uint32_t self,
                    const world::Box& around,
                    double horizon,
                    std::vector<Body>& bodies) {
    bodies.clear();
    const auto far = [&](const world::Vec3& p, double speed) {
        const double reach = 10 + horizon * std::abs(speed);
        return p.x() < around.low.x() - reach || p.x() > around.high.x() + reach ||
               p.y() < around.low.y() - reach || p.y() > around.high.y() + reach;
    };
    for (const world::VehicleState& state : last.vehicles())
        if (state.id() != self &&
            !far(state.position(), std::hypot(state.velocity().x(), state.velocity().y())))
            bodies.push_back(body_of(state));
    for (const world::CarState& car : last.cars())
        if (!far(car.position(), static_cast<double>(car.speed())))
            bodies.push_back(body_of(car));
    for (const world::WalkerState& walker : last.walkers())
        if (!far(walker.position(), static_cast<double>(walker.speed())))
            bodies.push_back(body_of(walker));
    for (const world::PropState& prop : last.props()) {
        const world::PropModel& model = world::prop_models()[prop.model()];
        if (model.height >= least_prop &&
            !far(prop.position(), std::hypot(prop.velocity().x(), prop.velocity().y())))
            bodies.push_back(body_of(prop, model));
    }
    collect_doors(last, self, bodies);
}

bool something_is_before(const world::TickView& last,
                         const Ego& ego,
                         double reach,
                         double slower_than) {
    constexpr double step = 0.2;    // [m]
    constexpr double margin = 0.1;  // [m] to both sides
    world::Box around;
    around.take(ego.position.head<2>(), 10);
    std::vector<Body> bodies;
    collect_bodies(last, ego.id, around, 0, bodies);
    std::erase_if(bodies, [&](const Body& body) { return body.speed >= slower_than; });
    const double half = ego.model->width / 2 + margin;
    const double front = ego.model->length - ego.model->rear_overhang;
    const double curvature = std::tan(ego.steering_angle) / ego.model->wheelbase;
    Eigen::Vector2d axle = ego.position.head<2>();
    double yaw = ego.yaw;
    for (double driven = 0; driven < reach + step; driven += step) {
        const Eigen::Vector2d ahead(std::cos(yaw), std::sin(yaw));
        const Eigen::Vector2d left(-ahead.y(), ahead.x());
        for (const Body& body : bodies)
            if (std::abs(body.z - ego.position.z()) < world::level_clearance &&
                body.seen_in_steps(ahead, step).meets(axle + front * ahead, half * left))
                return true;
        axle += step * ahead;
        yaw += step * curvature;
    }
    return false;
}

}  // namespace reprise::drivers
