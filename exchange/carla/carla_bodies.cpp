#include "exchange/carla/carla_bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/units.h"

namespace reprise::exchange {

namespace {

using Eigen::Vector3d;

constexpr double braking = 0.02;  // pedal; at rest it is 0

/// Bits of carla.VehicleLightState, as documented in CARLA's Python API reference.
std::uint16_t lamps_of(std::uint32_t flags) {
    std::uint16_t lamps = 0;
    const auto take = [&](std::uint32_t theirs, std::uint16_t ours) {
        if ((flags & theirs) != 0)
            lamps = static_cast<std::uint16_t>(lamps | ours);
    };
    take(0x2 | 0x4, world::lamp_low_beam);  // low and high beam
    take(0x8, world::lamp_brake);
    take(0x10, world::lamp_right);
    take(0x20, world::lamp_left);
    take(0x40, world::lamp_reverse);
    return lamps;
}

std::uint16_t lamps_of(const CarlaControl& control) {
    return static_cast<std::uint16_t>((control.brake > braking ? world::lamp_brake : 0) |
                                      (control.gear < 0 ? world::lamp_reverse : 0));
}

template <typename Items>
void sort_by_actor(Items& items) {
    std::stable_sort(items.begin(), items.end(), [](const auto& one, const auto& other) {
        return one.actor < other.actor;
    });
}

template <typename Items>
const typename Items::value_type* find_sorted(const Items& items, std::uint32_t actor) {
    const auto found =
        std::lower_bound(items.begin(), items.end(), actor, [](const auto& item, auto wanted) {
            return item.actor < wanted;
        });
    return found != items.end() && found->actor == actor ? &*found : nullptr;
}

/// What a frame says of vehicles besides where they are.
void add_details(std::vector<Body>& bodies, const CarlaFrame& frame) {
    std::vector<CarlaControl> controls = frame.controls;
    std::vector<CarlaLamps> lamps = frame.lamps;
    std::vector<CarlaMotion> motions = frame.motions;
    sort_by_actor(controls);
    sort_by_actor(lamps);
    sort_by_actor(motions);
    for (Body& body : bodies) {
        if (const CarlaControl* control = find_sorted(controls, body.id))
            body.lamps = lamps_of(*control);
        if (const CarlaLamps* of_body = find_sorted(lamps, body.id))
            body.lamps = static_cast<std::uint16_t>(body.lamps | lamps_of(of_body->flags));
        const CarlaMotion* motion = find_sorted(motions, body.id);
        if (motion != nullptr && motion->velocity.allFinite() && motion->velocity.norm() < fastest)
            body.velocity =
                Vector3d(motion->velocity.x(), -motion->velocity.y(), motion->velocity.z());
    }
}

}  // namespace

Vector3d ahead_of(double yaw, double pitch) {
    return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

Body body_of(const CarlaPose& pose, const CarlaSurvey& survey, const Vector3d& offset) {
    const CarlaRole& role = survey.roles.at(pose.actor);
    Body body;
    body.id = pose.actor;
    body.yaw = world::wrap_angle(-pose.rotation.z() * world::degree);
    body.pitch = role.actor.kind == CarlaKind::walker
                     ? 0
                     : world::wrap_angle(pose.rotation.y() * world::degree);
    body.position = from_carla(pose.location) + offset +
                    role.ahead * ahead_of(body.yaw, body.pitch) - Vector3d(0, 0, role.above);
    return body;
}

Instant instant_of(const CarlaFrame& frame, const CarlaSurvey& survey, const Vector3d& offset) {
    Instant instant;
    instant.elapsed = frame.elapsed;
    std::vector<Body>& bodies = instant.bodies;
    for (const CarlaPose& pose : frame.poses)
        if (survey.roles.count(pose.actor) > 0)
            bodies.push_back(body_of(pose, survey, offset));
    std::stable_sort(bodies.begin(), bodies.end(), [](const Body& one, const Body& other) {
        return one.id < other.id;
    });
    const auto same = [](const Body& one, const Body& other) { return one.id == other.id; };
    bodies.erase(std::unique(bodies.begin(), bodies.end(), same), bodies.end());
    add_details(bodies, frame);
    return instant;
}

bool jumps_between(const Body& from, const Body& to, double duration) {
    return (to.position - from.position).norm() > 1 + fastest * duration;
}

Body between(const Body& from, const Body& to, double share, double duration) {
    Body body = from;
    if (duration <= 0 || jumps_between(from, to, duration))
        return body;
    const Vector3d path = to.position - from.position;
    body.position += share * path;
    body.yaw = from.yaw + share * world::wrap_angle(to.yaw - from.yaw);
    body.pitch = from.pitch + share * world::wrap_angle(to.pitch - from.pitch);
    if (from.velocity && to.velocity)
        body.velocity = *from.velocity + share * (*to.velocity - *from.velocity);
    else
        body.velocity = path / duration;
    return body;
}

}  // namespace reprise::exchange
