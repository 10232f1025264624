#include "kernel/physics/tyres.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "world/models/car_model.h"

namespace reprise::kernel {

namespace {

/// Sweeps over the rows end when no wheel's force changes by more than this share of its limit: two
/// or three while the car rolls, because there the brush model decides; more when it is held still.
constexpr double settled = 1e-4;
constexpr int most_sweeps = 24;

/// [m/s] Slip angles are measured against at least this speed: below it, a tyre's side force would
/// be too stiff for the substep.
constexpr double slow = 0.3;

/// [m/s] ABS rests below it, where wheels may lock.
constexpr double abs_speed = 1.5;

/// One direction in which a wheel's contact can push the body.
struct Row {
    btVector3 direction;
    btVector3 torque;  ///< arm x direction
    btVector3 turn;    ///< change of angular velocity for a unit impulse
    double mass = 0;   ///< effective mass at the contact [kg]
};

Row row(const btRigidBody& body, const btVector3& direction, const btVector3& arm) {
    Row result;
    result.direction = direction;
    result.torque = arm.cross(direction);
    result.turn = body.getInvInertiaTensorWorld() * result.torque;
    result.mass = 1 / (body.getInvMass() + result.torque.dot(result.turn));
    return result;
}

struct Motion {
    btVector3 linear;
    btVector3 angular;
    double inverse_mass;

    double along(const Row& r) const { return r.direction.dot(linear) + r.torque.dot(angular); }

    void push(const Row& r, double impulse) {
        linear += r.direction * (impulse * inverse_mass);
        angular += r.turn * impulse;
    }
};

}  // namespace

/// A wheel on the ground in this substep; impulses in N s.
struct RaycastCar::Contact {
    int wheel = 0;
    Row ahead;
    Row left;
    double load = 0;        ///< impulse of the suspension
    double limit = 0;       ///< radius of the friction circle
    double side_limit = 0;  ///< by the brush model
    double engine = 0;
    double ahead_speed = 0;  ///< [m/s] of the contact, along the wheel
    double left_speed = 0;
    double brake_limit = 0;
    double impulse_ahead = 0;
    double impulse_left = 0;
    double allowed = 1;  ///< share of what brakes and engine want along the wheel
    double skid = 1;

    /// Locked.
    void slide();

    /// Rolling, with the slip held by the brakes' and the engine's electronics.
    void hold_slip(double most_ahead);

    /// Returns the change as a share of the limit.
    double solve(Motion& motion);
};

void RaycastCar::Contact::slide() {
    brake_limit = limit;
    side_limit = limit;
    const double speed = std::sqrt(ahead_speed * ahead_speed + left_speed * left_speed);
    if (speed < slow)
        return;
    limit *= world::sliding_share;
    brake_limit = limit * std::abs(ahead_speed) / speed;
    side_limit = limit * std::abs(left_speed) / speed;
    allowed = 0;
}

void RaycastCar::Contact::hold_slip(double most_ahead) {
    const double wanted = std::max(brake_limit, std::abs(engine));
    if (wanted <= most_ahead)
        return;
    allowed = most_ahead / wanted;
    // What resists at the wheel itself the road need not carry.
    const double most_engine = most_ahead + brake_limit;
    engine = std::clamp(engine, -most_engine, most_engine);
    brake_limit = std::min(brake_limit, most_ahead);
}

double RaycastCar::Contact::solve(Motion& motion) {
    // What would stop the contact, within what brakes and side-slip allow.
    const double brake = std::clamp(
        impulse_ahead - engine - motion.along(ahead) * ahead.mass, -brake_limit, brake_limit);
    double wanted_ahead = engine + brake;
    double wanted_left =
        std::clamp(impulse_left - motion.along(left) * left.mass, -side_limit, side_limit);
    // Never outside the friction circle.
    const double size = std::sqrt(wanted_ahead * wanted_ahead + wanted_left * wanted_left);
    skid = allowed;
    if (size > limit) {
        wanted_ahead *= limit / size;
        wanted_left *= limit / size;
        skid = allowed * limit / size;
    }
    const double change_ahead = wanted_ahead - impulse_ahead;
    const double change_left = wanted_left - impulse_left;
    motion.push(ahead, change_ahead);
    motion.push(left, change_left);
    impulse_ahead = wanted_ahead;
    impulse_left = wanted_left;
    return std::max(std::abs(change_ahead), std::abs(change_left)) / std::max(limit, 1e-9);
}

RaycastCar::RaycastCar(btRigidBody* chassis, WheelRays& rays)
    : btRaycastVehicle(btVehicleTuning(), chassis, &rays),
      rays_(&rays) {
    // Axes x ahead, y left, z up. Bullet uses the first index only in the friction that we replace.
    setCoordinateSystem(1, 2, 0);
}

void RaycastCar::updateVehicle(btScalar step) {
    rays_->begin();
    btRaycastVehicle::updateVehicle(step);
}

/// A bar across an axle carries load from the wheel that is extended to the one that is compressed.
void RaycastCar::twist_anti_roll_bars(double step) {
    btRigidBody& body = *getRigidBody();
    for (int axle = 0; axle < 2; ++axle) {
        btWheelInfo& left = m_wheelInfo[2 * axle];
        btWheelInfo& right = m_wheelInfo[2 * axle + 1];
        if (!left.m_raycastInfo.m_isInContact || !right.m_raycastInfo.m_isInContact)
            continue;
        double moved =
            anti_roll[static_cast<std::size_t>(axle)] *
            (right.m_raycastInfo.m_suspensionLength - left.m_raycastInfo.m_suspensionLength);
        moved = std::clamp(moved, -left.m_wheelsSuspensionForce, right.m_wheelsSuspensionForce);
        for (btWheelInfo* wheel : {&left, &right}) {
            const double force = wheel == &left ? moved : -moved;
            wheel->m_wheelsSuspensionForce += force;
            const btVector3 arm =
                wheel->m_raycastInfo.m_contactPointWS - body.getCenterOfMassPosition();
            body.applyImpulse(wheel->m_raycastInfo.m_contactNormalWS * (force * step), arm);
        }
    }
}

int RaycastCar::find_contacts(double step, std::array<Contact, 4>& contacts) {
    const btRigidBody& body = *getRigidBody();
    const btMatrix3x3& basis = body.getCenterOfMassTransform().getBasis();
    const btVector3 x_ahead = basis.getColumn(0);
    const btVector3 y_left = basis.getColumn(1);
    int count = 0;
    double total_load = 0;
    abs = {};
    for (int i = 0; i < 4; ++i) {
        const btWheelInfo& info = m_wheelInfo[i];
        if (!info.m_raycastInfo.m_isInContact)
            continue;
        Contact& contact = contacts[static_cast<std::size_t>(count++)];
        const Wheel& wheel = wheels[static_cast<std::size_t>(i)];
        contact.wheel = i;
        const btVector3& up = info.m_raycastInfo.m_contactNormalWS;
        btVector3 heading = x_ahead;
        if (info.m_steering != 0)
            heading = x_ahead * std::cos(info.m_steering) + y_left * std::sin(info.m_steering);
        const btVector3 ahead = (heading - up * up.dot(heading)).normalized();
        const btVector3 arm = info.m_raycastInfo.m_contactPointWS - body.getCenterOfMassPosition();
        contact.ahead = row(body, ahead, arm);
        contact.left = row(body, up.cross(ahead), arm);
        contact.load = info.m_wheelsSuspensionForce * step;
        total_load += contact.load;
        contact.limit = grip * contact.load;
        contact.engine = wheel.engine * step;
        contact.brake_limit = rolling_resistance * contact.load;
        const btVector3 velocity = body.getVelocityInLocalPoint(arm);
        contact.ahead_speed = velocity.dot(ahead);
        contact.left_speed = velocity.dot(contact.left.direction);
    }
    for (Contact& contact : std::span(contacts).first(static_cast<std::size_t>(count)))
        bound(contact, total_load > 0 ? total_brake * step / total_load : 0);
    return count;
}

/// What the tyre can give, of what is asked of it. `brake_share` is impulse by load.
void RaycastCar::bound(Contact& contact, double brake_share) {
    const auto index = static_cast<std::size_t>(contact.wheel);
    const Wheel& wheel = wheels[index];
    if (wheel.locked) {
        contact.slide();
        return;
    }
    const double slip = contact.left_speed / std::max(std::abs(contact.ahead_speed), slow);
    contact.side_limit = contact.limit * world::brush_share(slip, wheel.cornering_stiffness, grip);
    contact.brake_limit += brake_share * contact.load;
    contact.hold_slip(contact.limit * world::held_share(slip, wheel.cornering_stiffness, grip));
    abs[index] = total_brake > 0 && contact.allowed < 1 && contact.engine == 0 &&
                 std::abs(contact.ahead_speed) > abs_speed;
}

void RaycastCar::updateFriction(btScalar step) {
    btRigidBody& body = *getRigidBody();
    twist_anti_roll_bars(step);
    body.setLinearVelocity(body.getLinearVelocity() - btVector3(0, 0, world::gravity * step));
    std::array<Contact, 4> all;
    const int count = find_contacts(step, all);
    const std::span<Contact> contacts(all.data(), static_cast<std::size_t>(count));

    Motion motion{body.getLinearVelocity(), body.getAngularVelocity(), body.getInvMass()};
    double change = 1;
    for (int sweep = 0; sweep < most_sweeps && change > settled; ++sweep) {
        change = 0;
        for (Contact& contact : contacts)
            change = std::max(change, contact.solve(motion));
    }
    body.setLinearVelocity(motion.linear);
    body.setAngularVelocity(motion.angular);

    for (int i = 0; i < 4; ++i)
        m_wheelInfo[i].m_skidInfo = 1;
    for (const Contact& contact : contacts)
        m_wheelInfo[contact.wheel].m_skidInfo = contact.skid;
}

}  // namespace reprise::kernel
