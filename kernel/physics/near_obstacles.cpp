#include "kernel/physics/near_obstacles.h"

#include <algorithm>
#include <cmath>

#include "kernel/physics/collisions.h"
#include "kernel/physics/props.h"
#include "kernel/physics/vehicle.h"
#include "world/check.h"
#include "world/models/prop_models.h"

namespace reprise::kernel {

namespace {

/// Its middle is half its height above its lower end.
std::unique_ptr<btCollisionShape> make_shape(const world::Obstacle& obstacle) {
    using Shape = world::Obstacle::Shape;
    switch (obstacle.shape) {
        case Shape::cylinder:
            return std::make_unique<btCylinderShapeZ>(to_bullet(obstacle.half));
        case Shape::prism: {
            auto hull = std::make_unique<btConvexHullShape>();
            for (const Eigen::Vector3d& corner : obstacle.corners)
                for (const double side : {-1.0, 1.0})
                    hull->addPoint(to_bullet(corner) + btVector3(0, 0, side * obstacle.half.z()),
                                   false);
            hull->recalcLocalAabb();
            return hull;
        }
        default:
            return std::make_unique<btBoxShape>(to_bullet(obstacle.half));
    }
}

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

NearObstacles::NearObstacles(std::span<const world::Obstacle> obstacles, btDynamicsWorld& world)
    : world_(&world),
      obstacles_(obstacles.begin(), obstacles.end()) {
    for (const world::Obstacle& obstacle : obstacles_)
        largest_radius_ = std::max(largest_radius_, obstacle.radius);
}

NearObstacles::~NearObstacles() {
    for (const Body& near : near_)
        world_->removeRigidBody(near.body.get());
}

bool NearObstacles::within(std::size_t index,
                           std::span<const btVector3> centres,
                           double distance) const {
    const world::Obstacle& obstacle = obstacles_[index];
    const double reach = obstacle.radius + distance;
    return std::any_of(centres.begin(), centres.end(), [&](const btVector3& centre) {
        const btVector3 way = centre - to_bullet(obstacle.position);
        return way.x() * way.x() + way.y() * way.y() <= reach * reach;
    });
}

NearObstacles::Body NearObstacles::make(std::size_t index) const {
    const world::Obstacle& obstacle = obstacles_[index];
    Body near{index, make_shape(obstacle), nullptr};
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, near.shape.get());
    info.m_friction = 0.6;
    info.m_restitution = 0.3;
    info.m_startWorldTransform = btTransform(
        btQuaternion(btVector3(0, 0, 1), obstacle.yaw),
        to_bullet(obstacle.position) + btVector3(0, 0, obstacle.half.z() - obstacle.depth));
    near.body = std::make_unique<btRigidBody>(info);
    tag(*near.body, obstacle_body, 0);
    return near;
}

void NearObstacles::choose(std::span<const btVector3> centres) {
    std::erase_if(near_, [&](const Body& near) {
        const bool leaves = !within(near.index, centres, leave_distance);
        if (leaves)
            world_->removeRigidBody(near.body.get());
        return leaves;
    });
    const auto index_before = [](const Body& near, std::size_t index) {
        return near.index < index;
    };
    for (const btVector3& centre : centres) {
        const double reach = largest_radius_ + enter_distance;
        auto at = std::lower_bound(
            obstacles_.begin(),
            obstacles_.end(),
            centre.x() - reach,
            [](const world::Obstacle& obstacle, double x) { return obstacle.position.x() < x; });
        for (; at != obstacles_.end() && at->position.x() <= centre.x() + reach; ++at) {
            const auto index = static_cast<std::size_t>(at - obstacles_.begin());
            if (!within(index, {&centre, 1}, enter_distance) ||
                std::binary_search(gone_.begin(), gone_.end(), index))
                continue;
            const auto place = std::lower_bound(near_.begin(), near_.end(), index, index_before);
            if (place != near_.end() && place->index == index)
                continue;
            const auto near = near_.insert(place, make(index));
            world_->addRigidBody(near->body.get());
        }
    }
}

void NearObstacles::take_out(std::size_t i) {
    const auto at = near_.begin() + static_cast<std::ptrdiff_t>(i);
    world_->removeRigidBody(at->body.get());
    gone_.insert(std::lower_bound(gone_.begin(), gone_.end(), at->index), at->index);
    near_.erase(at);
}

void NearObstacles::add_to(world::Hasher& hasher) const {
    for (const std::size_t index : gone_)
        hasher.add(static_cast<std::uint64_t>(index));
    hasher.add(static_cast<std::uint64_t>(near_.size()));
    for (const Body& near : near_)
        hasher.add(static_cast<std::uint64_t>(near.index));
}

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
