#include "kernel/physics/door_boxes.h"

#include <algorithm>
#include <tuple>

#include "world/frames.h"
#include "world/models/catalogue.h"
#include "world/models/doors.h"

namespace reprise::kernel {

namespace {

constexpr double nearest = 30;  ///< [m] of a vehicle's middle: further doors touch nobody

}  // namespace

struct DoorBoxes::Box {
    Box(const world::Door& which, const btVector3& half) : door(which), shape(half) {}

    world::Door door;
    bool wanted = true;
    std::uint16_t model = 0;
    Eigen::Isometry3d pose_world_car = Eigen::Isometry3d::Identity();  ///< without mass
    bool with_mass = false;
    btBoxShape shape;
    std::unique_ptr<btRigidBody> body;
    const btRigidBody* carrier = nullptr;  ///< is not felt
    std::uint32_t put_down = 0;            ///< of the carrier, when it was last seen

    std::tuple<std::uint32_t, std::uint8_t> key() const { return {door.actor(), door.door()}; }

    /// Its vehicle has another body since it was put down elsewhere: the door is there with it,
    /// and has not swept over what lies between.
    void go_with(const Vehicle* vehicle) {
        if (carrier != nullptr)
            body->setIgnoreCollisionCheck(carrier, false);
        carrier = vehicle != nullptr ? &vehicle->body() : nullptr;
        put_down = vehicle != nullptr ? vehicle->times_put_down() : 0;
        if (carrier != nullptr)
            body->setIgnoreCollisionCheck(carrier, true);
        body->setInterpolationWorldTransform(body->getWorldTransform());
    }

    /// Where it is with the vehicle here.
    void place(const Eigen::Isometry3d& pose_world_vehicle) {
        const world::DoorLeaf leaf = world::door_leaf(
            world::vehicle_models()[model], pose_world_vehicle, door.door(), door.angle());
        body->setWorldTransform(to_bullet(leaf.pose));
    }
};

namespace {

Eigen::Isometry3d pose_of(const Vehicle& vehicle) {
    const btTransform& body = vehicle.body().getCenterOfMassTransform();
    const btVector3 foot =
        body(btVector3(-vehicle.model().com_ahead, 0, -vehicle.model().com_height));
    const btQuaternion turn = body.getRotation();
    return world::pose(to_vec3(foot), to_quat(turn));
}

}  // namespace

DoorBoxes::DoorBoxes(btDynamicsWorld& world) : world_(&world) {}

DoorBoxes::~DoorBoxes() {
    for (const auto& box : boxes_)
        world_->removeRigidBody(box->body.get());
}

void DoorBoxes::enter(const world::Door& door, const world::VehicleModel& model) {
    const world::DoorLeaf leaf =
        world::door_leaf(model, Eigen::Isometry3d::Identity(), door.door(), 0);
    auto box = std::make_unique<Box>(door, to_bullet(leaf.half));
    btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, &box->shape);
    info.m_friction = 0.6;
    info.m_restitution = 0.1;
    box->body = std::make_unique<btRigidBody>(info);
    btRigidBody& body = *box->body;
    body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    body.setActivationState(DISABLE_DEACTIVATION);
    tag(body, car_body, door.actor());
    boxes_.push_back(std::move(box));
}

void DoorBoxes::choose(const world::TickDraft& next,
                       std::span<const std::unique_ptr<Vehicle>> vehicles,
                       std::span<const btVector3> centres) {
    if (next.tick.doors.empty() && boxes_.empty())
        return;
    for (const auto& box : boxes_)
        box->wanted = false;
    for (const world::Door& door : next.tick.doors) {
        const auto vehicle = std::find_if(vehicles.begin(), vehicles.end(), [&](const auto& each) {
            return each->id() == door.actor();
        });
        const bool with_mass = vehicle != vehicles.end();
        const world::CarState* car = world::find(next.traffic.cars, door.actor());
        if (!with_mass && car == nullptr)
            continue;
        const Eigen::Isometry3d pose =
            with_mass ? pose_of(**vehicle)
                      : world::pose(car->position(), double{car->yaw()}, double{car->pitch()});
        const btVector3 here = to_bullet(Eigen::Vector3d(pose.translation()));
        const bool near = std::any_of(centres.begin(), centres.end(), [&](const btVector3& centre) {
            return centre.distance2(here) < nearest * nearest;
        });
        if (!near)
            continue;
        auto box = std::find_if(boxes_.begin(), boxes_.end(), [&](const auto& each) {
            return each->key() == std::tuple(door.actor(), door.door());
        });
        const std::uint16_t model = with_mass ? (*vehicle)->model_index() : car->model();
        const bool is_new = box == boxes_.end();
        if (is_new) {
            enter(door, world::vehicle_models()[model]);
            box = boxes_.end() - 1;
        }
        Box& own = **box;
        own.door = door;
        own.wanted = true;
        own.model = model;
        own.with_mass = with_mass;
        own.pose_world_car = pose;
        own.place(pose);
        const Vehicle* carrier = with_mass ? vehicle->get() : nullptr;
        if (is_new || own.put_down != (with_mass ? carrier->times_put_down() : 0))
            own.go_with(carrier);
        if (is_new)
            world_->addRigidBody(own.body.get());
    }
    std::erase_if(boxes_, [&](const auto& box) {
        if (!box->wanted)
            world_->removeRigidBody(box->body.get());
        return !box->wanted;
    });
    std::sort(boxes_.begin(), boxes_.end(), [](const auto& a, const auto& b) {
        return a->key() < b->key();
    });
}

void DoorBoxes::move(std::span<const std::unique_ptr<Vehicle>> vehicles) {
    for (const auto& box : boxes_)
        if (box->with_mass)
            for (const auto& vehicle : vehicles)
                if (vehicle->id() == box->door.actor())
                    box->place(pose_of(*vehicle));
}

void DoorBoxes::drop(std::uint32_t actor) {
    std::erase_if(boxes_, [&](const auto& box) {
        const bool is_its = box->door.actor() == actor;
        if (is_its)
            world_->removeRigidBody(box->body.get());
        return is_its;
    });
}

void DoorBoxes::add_to(world::Hasher& hasher) const {
    for (const auto& box : boxes_) {
        hasher.add(box->door.actor());
        hasher.add(box->door.door());
        add_transform(hasher, box->body->getWorldTransform());
    }
}

}  // namespace reprise::kernel
