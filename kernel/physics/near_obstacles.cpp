#include "kernel/physics/near_obstacles.h"

#include <algorithm>

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

}  // namespace reprise::kernel
