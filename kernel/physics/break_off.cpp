#include "kernel/physics/break_off.h"

#include <algorithm>
#include <cmath>

#include "world/check.h"
#include "world/models/prop_models.h"

namespace reprise::kernel {

namespace {

/// Where a vehicle is about to meet an upright pole.
struct Meeting {
    btVector3 place;    ///< on the vehicle's side, world
    btVector3 towards;  ///< the pole
    double gap = 0;     ///< [m]
};

Meeting meeting_of(const PlacedBox& box, const world::Obstacle& pole) {
    // At the height of the vehicle's middle.
    btVector3 axis = to_bullet(pole.position);
    axis.setZ(std::clamp(box.pose.getOrigin().z(), axis.z(), axis.z() + 2 * pole.half.z()));
    const btVector3 local = box.pose.inverse() * axis;
    btVector3 nearest = local;
    for (int i = 0; i < 3; ++i)
        nearest[i] = std::clamp(local[i], -box.half[i], box.half[i]);
    const btVector3 apart = local - nearest;
    const double far = apart.length();
    // Within the box by a glitch: towards the pole from the middle.
    const btVector3 way = far > 1e-6 ? apart / far : local.normalized();
    return {box.pose * nearest, box.pose.getBasis() * way, far - pole.radius};
}

/// [N s] that a pole which stands would take from it; 0: it is not about to hit it.
double hit_of(const Vehicle& vehicle, const Meeting& meeting, double substep) {
    constexpr double margin = 0.03;  // [m] Bullet finds contacts below 2 cm
    const btRigidBody& body = vehicle.body();
    const btVector3 lever = meeting.place - body.getCenterOfMassPosition();
    const double closing = body.getVelocityInLocalPoint(lever).dot(meeting.towards);
    if (closing <= 0 || meeting.gap > margin + closing * substep)
        return 0;
    return closing / body.computeImpulseDenominator(meeting.place, meeting.towards);
}

std::uint16_t sign_model() {
    static const auto model = world::find_prop_model("sign_post");
    REPRISE_CHECK(model.has_value(), "no such prop");
    return *model;
}

bool breaks(const world::Obstacle& pole,
            const std::vector<std::unique_ptr<Vehicle>>& vehicles,
            double substep,
            std::uint32_t id,
            Collisions& collisions) {
    bool any = false;
    for (const auto& vehicle : vehicles) {
        constexpr double storey = 4;  // [m]
        if (vehicle->is_guided() ||
            std::abs(vehicle->box().pose.getOrigin().z() - pole.position.z()) > storey)
            continue;
        const Meeting meeting = meeting_of(vehicle->box(), pole);
        if (hit_of(*vehicle, meeting, substep) < pole.breaks_at)
            continue;
        btRigidBody& body = vehicle->body();
        body.applyImpulse(-pole.breaks_at * meeting.towards,
                          meeting.place - body.getCenterOfMassPosition());
        collisions.add(vehicle->id(), id, pole.breaks_at, meeting.place);
        any = true;
    }
    return any;
}

}  // namespace

void break_off(NearObstacles& obstacles,
               const std::vector<std::unique_ptr<Vehicle>>& vehicles,
               double substep,
               Props& props,
               Collisions& collisions,
               std::vector<std::uint32_t>& broken) {
    for (std::size_t i = 0; i < obstacles.size();) {
        const world::Obstacle& pole = obstacles.near(i);
        const std::uint32_t id = world::first_broken_id + pole.town_prop;
        if (pole.breaks_at <= 0 || id > world::last_broken_id ||
            !breaks(pole, vehicles, substep, id, collisions)) {
            ++i;
            continue;
        }
        const Eigen::Isometry3d pose = Eigen::Translation3d(pole.position) *
                                       Eigen::AngleAxisd(pole.yaw, Eigen::Vector3d::UnitZ());
        props.add(id, sign_model(), pose);
        broken.push_back(id);
        obstacles.take_out(i);
    }
}

}  // namespace reprise::kernel
