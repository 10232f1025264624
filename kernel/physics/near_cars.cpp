#include "kernel/physics/near_cars.h"

#include <algorithm>

#include "world/check.h"
#include "world/frames.h"
#include "world/models/catalogue.h"

namespace reprise::kernel {

namespace {

double nearest_squared(std::span<const btVector3> centres, const world::Vec3& p) {
    double nearest = 1e300;
    for (const btVector3& centre : centres)
        nearest = std::min(nearest, centre.distance2(to_bullet(p)));
    return nearest;
}

/// Middle of the box, in a car's frame (ground below the rear axle).
Eigen::Translation3d middle_of(std::uint16_t model) {
    const world::VehicleModel& m = world::vehicle_models()[model];
    return {m.length / 2 - m.rear_overhang,
            0,
            NearCars::clearance + (m.height - NearCars::clearance) / 2};
}

btTransform box_pose(const world::CarState& car) {
    const double yaw = static_cast<double>(car.yaw());
    const double pitch = static_cast<double>(car.pitch());
    return to_bullet(world::pose(car.position(), yaw, pitch) * middle_of(car.model()));
}

btVector3 half_of(const world::VehicleModel& m) {
    return btVector3(m.length, m.width, m.height - NearCars::clearance) / 2;
}

}  // namespace

PlacedBox box_of(const world::CarState& car) {
    return {box_pose(car), half_of(world::vehicle_models()[car.model()])};
}

btTransform between(const btTransform& from, const btTransform& to, double share) {
    const btQuaternion turn_from = from.getRotation();
    btQuaternion turn_to = to.getRotation();
    if (turn_to.dot(turn_from) < 0)
        turn_to = -turn_to;
    const btQuaternion turn = turn_from + (turn_to - turn_from) * share;
    return btTransform(turn.normalized(), from.getOrigin().lerp(to.getOrigin(), share));
}

struct NearCars::Box {
    std::uint32_t id = 0;
    std::uint16_t model = 0;
    btVector3 from;
    btVector3 way;  ///< in this tick
    btQuaternion turn_from;
    btQuaternion turn_way;  ///< added to turn_from, then normalised
    bool moves = false;
    bool wanted = false;  ///< stays in this tick
    bool is_out = false;  ///< taken out of Bullet's world for the rest of the tick
    std::unique_ptr<btRigidBody> body;
};

NearCars::NearCars(btDynamicsWorld& world) : world_(&world) {
    for (const world::VehicleModel& m : world::vehicle_models())
        shapes_.push_back(std::make_unique<btBoxShape>(half_of(m)));
}

NearCars::~NearCars() {
    for (const auto& box : boxes_)
        world_->removeRigidBody(box->body.get());
}

void NearCars::choose(std::span<const world::CarState> last,
                      std::span<const world::CarState> next,
                      std::span<const btVector3> centres,
                      const Displaced& displaced) {
    // Who stays: still there and not too far.
    std::vector<const world::CarState*> entering;
    auto old = boxes_.begin();
    for (const auto& box : boxes_)
        box->wanted = false;
    for (const world::CarState& car : next) {
        while (old != boxes_.end() && (*old)->id < car.id())
            ++old;
        const double d2 = nearest_squared(centres, car.position());
        if (old != boxes_.end() && (*old)->id == car.id())
            (*old)->wanted = d2 <= leave_distance * leave_distance;
        else if (d2 <= enter_distance * enter_distance)
            entering.push_back(&car);
    }
    // Leave, then enter.
    std::erase_if(boxes_, [&](const auto& box) {
        if (!box->wanted)
            world_->removeRigidBody(box->body.get());
        return !box->wanted;
    });
    for (const world::CarState* car : entering)
        enter(*car);
    std::sort(
        boxes_.begin(), boxes_.end(), [](const auto& a, const auto& b) { return a->id < b->id; });
    // Where to.
    for (const auto& box : boxes_)
        aim(*box,
            holds(displaced, box->id) ? nullptr : world::find(last, box->id),
            *world::find(next, box->id));
}

void NearCars::enter(const world::CarState& car) {
    auto box = std::make_unique<Box>();
    box->id = car.id();
    box->model = car.model();
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, shapes_[car.model()].get());
    info.m_friction = 0.6;
    info.m_restitution = 0.3;
    info.m_startWorldTransform = box_pose(car);
    box->body = std::make_unique<btRigidBody>(info);
    btRigidBody& body = *box->body;
    body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
    tag(body, car_body, car.id());
    tag_mass(body, world::vehicle_models()[car.model()].mass);
    world_->addRigidBody(&body);
    boxes_.push_back(std::move(box));
}

void NearCars::aim(Box& box, const world::CarState* before, const world::CarState& next) {
    const btTransform to = box_pose(next);
    btTransform from = before != nullptr ? box_pose(*before) : to;
    if (from.getOrigin().distance2(to.getOrigin()) > longest_move * longest_move)
        from = to;
    box.from = from.getOrigin();
    box.way = to.getOrigin() - from.getOrigin();
    box.turn_from = from.getRotation();
    btQuaternion turn_to = to.getRotation();
    if (turn_to.dot(box.turn_from) < 0)
        turn_to = -turn_to;
    box.turn_way = turn_to - box.turn_from;
    const bool moves = box.way.length2() > 0 || box.turn_way.length2() > 0;
    // A box that stands still needs its pose only once, and where Bullet believed it was, too: else
    // a jump would count as a velocity.
    if (!moves || box.body->getWorldTransform().getOrigin().distance2(box.from) > 1e-6) {
        box.body->setWorldTransform(from);
        box.body->setInterpolationWorldTransform(from);
    }
    box.moves = moves;
}

void NearCars::move(double share) {
    for (const auto& box : boxes_) {
        if (!box->moves || box->is_out)
            continue;
        const btQuaternion turn = box->turn_from + box->turn_way * share;
        box->body->setWorldTransform(btTransform(turn.normalized(), box->from + box->way * share));
    }
}

// --- One that becomes a body with mass.

std::vector<std::unique_ptr<NearCars::Box>>::iterator NearCars::place(std::uint32_t id) {
    const auto at = std::lower_bound(
        boxes_.begin(), boxes_.end(), id, [](const auto& box, std::uint32_t wanted) {
            return box->id < wanted;
        });
    REPRISE_CHECK(at != boxes_.end() && (*at)->id == id, "near car " + std::to_string(id));
    return at;
}

std::optional<NearCars::Way> NearCars::way(std::size_t index) const {
    const Box& box = *boxes_[index];
    if (box.is_out)
        return std::nullopt;
    return Way{box.id, box.model, shapes_[box.model]->getHalfExtentsWithMargin(), box.way.length()};
}

btTransform NearCars::pose_at(std::size_t index, double share) const {
    const Box& box = *boxes_[index];
    const btQuaternion turn = box.turn_from + box.turn_way * share;
    return btTransform(turn.normalized(), box.from + box.way * share);
}

Eigen::Isometry3d NearCars::car_at(std::size_t index, double share) const {
    const btTransform pose = pose_at(index, share);
    return world::pose(to_vec3(pose.getOrigin()), to_quat(pose.getRotation())) *
           middle_of(boxes_[index]->model).inverse();
}

NearCars::Motion NearCars::motion(std::size_t index, double step) const {
    Motion motion;
    btTransformUtil::calculateVelocity(
        pose_at(index, 0), pose_at(index, 1), step, motion.velocity, motion.spin);
    return motion;
}

void NearCars::take_out(std::size_t index) {
    Box& box = *boxes_[index];
    world_->removeRigidBody(box.body.get());
    box.is_out = true;
}

void NearCars::put_back(std::uint32_t id) {
    Box& box = **place(id);
    const auto index = static_cast<std::size_t>(place(id) - boxes_.begin());
    box.body->setWorldTransform(pose_at(index, 1));
    box.body->setInterpolationWorldTransform(pose_at(index, 1));
    world_->addRigidBody(box.body.get());
    box.is_out = false;
}

void NearCars::forget(std::uint32_t id) {
    boxes_.erase(place(id));
}

void NearCars::add_to(world::Hasher& hasher) const {
    hasher.add(static_cast<std::uint64_t>(boxes_.size()));
    for (const auto& box : boxes_) {
        hasher.add(box->id);
        add_transform(hasher, box->body->getWorldTransform());
        add_vector(hasher, box->body->getLinearVelocity());
        add_vector(hasher, box->body->getAngularVelocity());
    }
}

}  // namespace reprise::kernel
