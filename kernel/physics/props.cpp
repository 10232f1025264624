#include "kernel/physics/props.h"

#include <algorithm>
#include <cmath>

#include "world/check.h"
#include "world/models/car_model.h"

namespace reprise::kernel {

namespace {

constexpr int rest_ticks = 20;       ///< [ticks] a second of the usual step
constexpr double rest_speed = 0.03;  ///< [m/s]
constexpr double rest_rate = 0.05;   ///< [rad/s]
constexpr double drop = 0.01;        ///< [m] above the ground at its spawn
constexpr double heavy_mass = 50;    ///< [kg]
constexpr double lowest = -1000;     ///< [m] whoever fell off the world falls no further

/// A box of the prop, in its frame.
struct Part {
    btVector3 half;
    btVector3 centre;
    double share;  ///< of the mass
};

std::vector<Part> parts_of(const world::PropModel& model) {
    const double l = model.length / 2;
    const double w = model.width / 2;
    const double h = model.height / 2;
    switch (model.form) {
        case world::PropForm::cone:  // a heavy foot, and the cone's mean width
            return {{{l, w, 0.03}, {0, 0, 0.03}, 0.7},
                    {{l / 2, w / 2, h - 0.03}, {0, 0, h + 0.03}, 0.3}};
        case world::PropForm::barrier:  // New Jersey: broad below, slim above
            return {{{l, w, h / 2}, {0, 0, h / 2}, 0.65},
                    {{l, w / 2.5, h / 2}, {0, 0, 1.5 * h}, 0.35}};
        case world::PropForm::triangle:  // its feet reach across, its sheet is thin
            return {{{l / 2, w, 0.015}, {0, 0, 0.015}, 0.7}, {{l, 0.02, h}, {0, 0, h}, 0.3}};
        case world::PropForm::sign:  // a tube, and the plate on its upper end
            return {{{l / 2, l / 2, h}, {0, 0, h}, 0.75},
                    {{0.015, w, w}, {l / 2, 0, 2 * h - w}, 0.25}};
        default:
            return {{{l, w, h}, {0, 0, h}, 1}};
    }
}

}  // namespace

struct Props::Thing {
    Thing(std::uint32_t its_id, std::uint16_t its_model)
        : id(its_id),
          model(its_model),
          data(world::prop_models()[its_model]) {
        const std::vector<Part> parts = parts_of(data);
        for (const Part& part : parts)
            centre_of_mass += part.centre * part.share;
        btVector3 inertia(0, 0, 0);
        for (const Part& part : parts) {
            boxes.push_back(std::make_unique<btBoxShape>(part.half));
            const btVector3 at = part.centre - centre_of_mass;
            shape.addChildShape(btTransform(btQuaternion::getIdentity(), at), boxes.back().get());
            const double mass = data.mass * part.share;
            const btVector3 full = part.half * 2;
            for (int i = 0; i < 3; ++i) {
                const int j = (i + 1) % 3;
                const int k = (i + 2) % 3;
                inertia[i] += mass * ((full[j] * full[j] + full[k] * full[k]) / 12 + at[j] * at[j] +
                                      at[k] * at[k]);
            }
        }
        btRigidBody::btRigidBodyConstructionInfo info(data.mass, nullptr, &shape, inertia);
        info.m_friction = data.friction;
        info.m_restitution = 0.1;
        info.m_angularDamping = 0.1;  // what rolls on gravel and tyre walls
        body = std::make_unique<btRigidBody>(info);
        body->setActivationState(DISABLE_DEACTIVATION);
        body->setFlags(BT_DISABLE_WORLD_GRAVITY);
        body->setGravity(btVector3(0, 0, -world::gravity));
        tag(*body, prop_body, id);
    }

    btTransform pose() const {
        const btTransform& at = body->getCenterOfMassTransform();
        return btTransform(at.getBasis(), at(-centre_of_mass));
    }

    std::uint32_t id;
    std::uint16_t model;
    const world::PropModel& data;
    btVector3 centre_of_mass{0, 0, 0};  ///< in its frame
    std::vector<std::unique_ptr<btBoxShape>> boxes;
    btCompoundShape shape{false};
    std::unique_ptr<btRigidBody> body;
    bool awake = false;
    int still = 0;  ///< [ticks] in a row that it was slower than anybody sees
};

Props::Props(btDynamicsWorld& world) : world_(&world) {}

Props::~Props() {
    for (const auto& thing : things_)
        leave(*thing);
}

std::vector<std::unique_ptr<Props::Thing>>::iterator Props::place(std::uint32_t id) {
    return std::lower_bound(
        things_.begin(), things_.end(), id, [](const auto& thing, std::uint32_t wanted) {
            return thing->id < wanted;
        });
}

bool Props::has(std::uint32_t id) const {
    return std::any_of(
        things_.begin(), things_.end(), [&](const auto& thing) { return thing->id == id; });
}

void Props::enter(Thing& thing) {
    if (thing.awake)
        return;
    thing.awake = true;
    world_->addRigidBody(thing.body.get());
}

void Props::leave(Thing& thing) {
    if (!thing.awake)
        return;
    thing.awake = false;
    world_->removeRigidBody(thing.body.get());
    thing.body->setLinearVelocity({0, 0, 0});
    thing.body->setAngularVelocity({0, 0, 0});
}

void Props::add(std::uint32_t id, std::uint16_t model, const Eigen::Isometry3d& pose_world_prop) {
    REPRISE_CHECK(!has(id), "prop " + std::to_string(id));
    auto thing = std::make_unique<Thing>(id, model);
    btTransform pose = to_bullet(pose_world_prop);
    pose.setOrigin(pose(thing->centre_of_mass) + btVector3(0, 0, drop));
    thing->body->setCenterOfMassTransform(pose);
    thing->body->setInterpolationWorldTransform(pose);
    enter(*thing);
    things_.insert(place(id), std::move(thing));
}

world::Vec3 Props::remove(std::uint32_t id) {
    const auto at = place(id);
    REPRISE_CHECK(at != things_.end() && (*at)->id == id, "prop " + std::to_string(id));
    const world::Vec3 position = to_vec3((*at)->pose().getOrigin());
    leave(**at);
    things_.erase(at);
    return position;
}

void Props::wake(std::span<const Mover> movers) {
    for (const auto& thing : things_) {
        const btVector3& here = thing->body->getCenterOfMassPosition();
        const double own = thing->data.length / 2 + thing->data.height + 0.5;
        const bool near = std::any_of(movers.begin(), movers.end(), [&](const Mover& mover) {
            const double reach = mover.reach + own;
            return mover.centre.distance2(here) < reach * reach;
        });
        if (near || thing->still < rest_ticks)
            enter(*thing);
        else
            leave(*thing);
    }
}

bool Props::any_awake() const {
    return std::any_of(
        things_.begin(), things_.end(), [](const auto& thing) { return thing->awake; });
}

std::vector<Props::Heavy> Props::heavy() const {
    std::vector<Heavy> all;
    for (const auto& thing : things_) {
        if (!thing->awake || thing->data.mass < heavy_mass)
            continue;
        const btVector3 half =
            btVector3(thing->data.length, thing->data.width, thing->data.height) / 2;
        const btTransform foot = thing->pose();
        all.push_back({thing->id,
                       {btTransform(foot.getBasis(), foot(btVector3(0, 0, half.z()))), half},
                       thing->body->getLinearVelocity()});
    }
    return all;
}

void Props::add_centres(std::vector<btVector3>& centres) const {
    for (const auto& thing : things_)
        if (thing->awake)
            centres.push_back(thing->body->getCenterOfMassPosition());
}

void Props::set_road_friction(double factor) {
    for (const auto& thing : things_)
        thing->body->setFriction(thing->data.friction * factor);
}

void Props::write(std::vector<world::PropState>& states) {
    for (const auto& thing : things_) {
        btRigidBody& body = *thing->body;
        const bool fell_off = body.getCenterOfMassPosition().z() < lowest;
        const bool rests = body.getLinearVelocity().length2() < rest_speed * rest_speed &&
                           body.getAngularVelocity().length2() < rest_rate * rest_rate;
        thing->still = rests || fell_off ? std::min(thing->still + 1, rest_ticks) : 0;
        const btTransform pose = thing->pose();
        states.emplace_back(to_vec3(pose.getOrigin()),
                            to_quat(pose.getRotation()),
                            to_vec3(body.getVelocityInLocalPoint(pose.getOrigin() -
                                                                 body.getCenterOfMassPosition())),
                            to_vec3(body.getAngularVelocity()),
                            thing->id,
                            thing->model,
                            std::uint16_t{0});
        const world::Vec3& position = states.back().position();
        REPRISE_CHECK(std::isfinite(position.x() + position.y() + position.z()),
                      "prop " + std::to_string(thing->id) + " is nowhere");
    }
}

void Props::add_to(world::Hasher& hasher) const {
    for (const auto& thing : things_) {
        hasher.add(thing->id);
        hasher.add(thing->awake);
        hasher.add(thing->still);
        add_transform(hasher, thing->body->getCenterOfMassTransform());
        add_vector(hasher, thing->body->getLinearVelocity());
        add_vector(hasher, thing->body->getAngularVelocity());
    }
}

}  // namespace reprise::kernel
