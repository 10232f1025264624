#include "walkers/threats.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "world/check.h"
#include "world/frames.h"
#include "world/geometry2d.h"
#include "world/models/catalogue.h"

namespace reprise::walkers {

namespace {

constexpr double foresight = 1;  // [s]
constexpr double margin = 0.3;   // [m] that nobody likes a car to come nearer
constexpr double rolls = 0.3;    // [m/s]
constexpr double widest = 1;     // [m] radius of anybody on foot

}  // namespace

void Threats::add(const Eigen::Vector2d& rear_axle,
                  const Eigen::Vector2d& ahead,
                  double speed,
                  double acceleration,
                  std::uint16_t model) {
    if (std::abs(speed) < rolls)
        return;
    // Who brakes is seen to brake; that somebody may step on it is not thought of.
    const double braking = speed * acceleration < 0 ? std::abs(acceleration) : 0;
    const double time = braking > 0 ? std::min(foresight, std::abs(speed) / braking) : foresight;
    const double driven = std::copysign(std::abs(speed) * time - braking * time * time / 2, speed);
    const world::VehicleModel& body = world::vehicle_models()[model];
    const double middle = body.length / 2 - body.rear_overhang;
    Threat threat{rear_axle + middle * ahead,
                  ahead,
                  -body.length / 2 + std::min(0.0, driven),
                  body.length / 2 + std::max(0.0, driven),
                  body.width / 2};
    // Of most walkers most threats are far away: two comparisons tell.
    const double beside = threat.half_width + widest + margin;
    for (const double end : {threat.rear - widest - margin, threat.front + widest + margin})
        threat.around.take(threat.middle + end * ahead, beside);
    threats_.push_back(threat);
}

void Threats::look(const world::TickView& last, const world::TickDraft& next) {
    threats_.clear();
    for (const world::CarState& car : next.traffic.cars)
        add({car.position().x(), car.position().y()},
            world::ahead_of(static_cast<double>(car.yaw())),
            static_cast<double>(car.speed()),
            static_cast<double>(car.acceleration()),
            car.model());
    for (const world::VehicleState& vehicle : last.vehicles()) {
        const Eigen::Vector3d ahead =
            world::to_eigen(vehicle.orientation()) * Eigen::Vector3d::UnitX();
        const double speed = ahead.dot(world::to_eigen(vehicle.velocity()));
        const double acceleration = ahead.dot(world::to_eigen(vehicle.acceleration()));
        add({vehicle.position().x(), vehicle.position().y()},
            world::ahead_of(std::atan2(ahead.y(), ahead.x())),
            speed,
            acceleration,
            vehicle.model());
    }
}

std::optional<Eigen::Vector2d> Threats::way_out(const Eigen::Vector2d& p, double radius) const {
    REPRISE_CHECK(radius <= widest, std::to_string(radius));
    const double room = radius + margin;
    std::optional<Eigen::Vector2d> way;
    double nearest = 0;
    for (const Threat& threat : threats_) {
        if (p.x() < threat.around.low.x() || p.x() > threat.around.high.x() ||
            p.y() < threat.around.low.y() || p.y() > threat.around.high.y())
            continue;
        const Eigen::Vector2d from = p - threat.middle;
        const double along = from.dot(threat.ahead);
        if (along < threat.rear - room || along > threat.front + room)
            continue;
        const Eigen::Vector2d left = world::turned_left(threat.ahead);
        const double across = from.dot(left);
        const double gap = std::abs(across) - threat.half_width - room;
        if (gap < nearest) {
            nearest = gap;
            way = across < 0 ? Eigen::Vector2d(-left) : left;
        }
    }
    return way;
}

}  // namespace reprise::walkers
