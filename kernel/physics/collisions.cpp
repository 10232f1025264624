#include "kernel/physics/collisions.h"

#include <algorithm>
#include <tuple>

#include "world/tick.h"

namespace reprise::kernel {

Collisions::Pair& Collisions::pair(std::uint32_t actor, std::uint32_t other, bool ground) {
    const auto key = std::make_tuple(actor, other, ground);
    const auto key_of = [](const Pair& p) { return std::make_tuple(p.actor, p.other, p.ground); };
    auto at =
        std::lower_bound(pairs_.begin(), pairs_.end(), key, [&](const Pair& p, const auto& k) {
            return key_of(p) < k;
        });
    if (at == pairs_.end() || key_of(*at) != key)
        at = pairs_.insert(
            at, {actor, other, ground, false, false, btVector3(0, 0, 0), 0, 0, btVector3(0, 0, 0)});
    return *at;
}

void Collisions::gather(const btDispatcher& dispatcher) {
    const int count = dispatcher.getNumManifolds();
    for (int i = 0; i < count; ++i) {
        const btPersistentManifold& manifold =
            *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
        double sum = 0;
        btVector3 push(0, 0, 0);  // on the first of the two
        int strongest = 0;
        for (int k = 0; k < manifold.getNumContacts(); ++k) {
            const double impulse = manifold.getContactPoint(k).m_appliedImpulse;
            sum += impulse;
            push += manifold.getContactPoint(k).m_normalWorldOnB * impulse;
            if (impulse > manifold.getContactPoint(strongest).m_appliedImpulse)
                strongest = k;
        }
        if (sum <= 0) {
            gather_unyielding(manifold);
            continue;
        }
        const btManifoldPoint& point = manifold.getContactPoint(strongest);
        const btCollisionObject* bodies[2] = {manifold.getBody0(), manifold.getBody1()};
        for (int side = 0; side < 2; ++side) {
            const btCollisionObject& self = *bodies[side];
            const btCollisionObject& other = *bodies[1 - side];
            if (self.getUserIndex() != vehicle_body)
                continue;
            Pair& both = pair(actor_of(self), actor_of(other), other.getUserIndex() == ground_body);
            both.push += side == 0 ? push : -push;
            both.mirrored =
                other.getUserIndex() == vehicle_body && actor_of(other) < actor_of(self);
            if (point.m_appliedImpulse > both.strongest) {
                both.strongest = point.m_appliedImpulse;
                both.position = side == 0 ? point.m_positionWorldOnA : point.m_positionWorldOnB;
            }
        }
    }
}

/// Two that both are where a trajectory says, or one and what stands: neither gives way, so Bullet
/// applies nothing. What a plastic hit would take: the reduced mass at the speed at which they
/// close. Once a tick.
void Collisions::gather_unyielding(const btPersistentManifold& manifold) {
    const btRigidBody* bodies[2] = {btRigidBody::upcast(manifold.getBody0()),
                                    btRigidBody::upcast(manifold.getBody1())};
    for (const btRigidBody* body : bodies)
        if (body == nullptr || body->getInvMass() != 0 || body->getUserIndex() == ground_body)
            return;
    double impulse = 0;
    const btManifoldPoint* worst = nullptr;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
        const btManifoldPoint& point = manifold.getContactPoint(k);
        if (point.getDistance() > 0)
            continue;
        const btVector3& p = point.getPositionWorldOnB();
        const btVector3 between =
            bodies[0]->getVelocityInLocalPoint(p - bodies[0]->getWorldTransform().getOrigin()) -
            bodies[1]->getVelocityInLocalPoint(p - bodies[1]->getWorldTransform().getOrigin());
        const double mass = 1 / (1 / mass_of(*bodies[0]) + 1 / mass_of(*bodies[1]));
        const double lost = -between.dot(point.m_normalWorldOnB) * mass;
        if (lost > impulse) {
            impulse = lost;
            worst = &point;
        }
    }
    if (worst == nullptr)
        return;
    for (int side = 0; side < 2; ++side) {
        if (bodies[side]->getUserIndex() != vehicle_body)
            continue;
        const btRigidBody& other = *bodies[1 - side];
        Pair& both = pair(actor_of(*bodies[side]), actor_of(other), false);
        both.mirrored =
            other.getUserIndex() == vehicle_body && actor_of(other) < actor_of(*bodies[side]);
        if (impulse > both.strongest) {
            both.push = worst->m_normalWorldOnB * (side == 0 ? impulse : -impulse);
            both.strongest = impulse;
            both.position = worst->getPositionWorldOnB();
        }
    }
}

void Collisions::add(std::uint32_t actor,
                     std::uint32_t other,
                     double impulse,
                     const btVector3& position) {
    Pair& both = pair(actor, other, false);
    both.impulse += impulse;
    both.always = true;
    if (impulse > both.strongest) {
        both.strongest = impulse;
        both.position = position;
    }
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> Collisions::touching() const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> all;
    for (const Pair& pair : touches())
        all.emplace_back(pair.actor, pair.other);
    return all;
}

void Collisions::forget(std::uint32_t actor) {
    std::erase_if(pairs_,
                  [&](const Pair& pair) { return pair.actor == actor || pair.other == actor; });
}

/// The pairs that touch in this tick. Ground and obstacles are both the static world: they follow
/// each other in the order, and become one.
std::vector<Collisions::Pair> Collisions::touches() const {
    const auto counts = [](const Pair& pair) {
        const double impulse = pair.impulse + pair.push.length();
        return pair.always || impulse >= (pair.ground ? least_ground_impulse : least_impulse);
    };
    std::vector<Pair> touches;
    for (auto pair = pairs_.begin(); pair != pairs_.end(); ++pair) {
        Pair both = *pair;
        bool is_touch = counts(both);
        const auto next = pair + 1;
        if (next != pairs_.end() && next->actor == both.actor && next->other == both.other) {
            is_touch = is_touch || counts(*next);
            both.impulse += next->impulse;
            both.push += next->push;
            if (next->strongest > both.strongest)
                both.position = next->position;
            pair = next;
        }
        both.impulse += both.push.length();
        if (is_touch)
            touches.push_back(both);
    }
    return touches;
}

void Collisions::write(std::uint64_t tick, bool is_last, std::vector<world::EventT>& events) {
    const std::uint64_t gap = (longest_gap_ns + step_ns_ - 1) / step_ns_;
    end(events, [&](const Contact& contact) { return tick - contact.last >= gap; });
    impacts_.clear();
    for (const Pair& pair : touches()) {
        impacts_.push_back({pair.actor, pair.other, pair.impulse});
        if (!pair.mirrored)
            touch(pair, tick, events);
    }
    if (is_last)
        end(events, [](const Contact&) { return true; });
}

/// A contact begins or goes on.
void Collisions::touch(const Pair& pair, std::uint64_t tick, std::vector<world::EventT>& events) {
    const auto key_of = [](const auto& item) { return std::make_tuple(item.actor, item.other); };
    const auto at = std::lower_bound(
        contacts_.begin(), contacts_.end(), pair, [&](const Contact& contact, const Pair& wanted) {
            return key_of(contact) < key_of(wanted);
        });
    if (at != contacts_.end() && key_of(*at) == key_of(pair)) {
        at->last = tick;
        if (pair.impulse > at->worst) {
            at->worst = pair.impulse;
            at->place = to_vec3(pair.position);
        }
        return;
    }
    const world::Vec3 place = to_vec3(pair.position);
    contacts_.insert(at, {pair.actor, pair.other, tick, tick, pair.impulse, place});
    world::EventT event;
    event.kind = world::EventKind::collision;
    event.actor = pair.actor;
    event.other = pair.other;
    event.position = place;
    event.value = pair.impulse;
    events.push_back(event);
}

template <typename Ends>
void Collisions::end(std::vector<world::EventT>& events, Ends ends) {
    for (const Contact& contact : contacts_) {
        if (!ends(contact))
            continue;
        world::EventT event;
        event.kind = world::EventKind::collision_ended;
        event.actor = contact.actor;
        event.other = contact.other;
        event.position = contact.place;
        event.value = contact.worst;
        event.duration = world::seconds(contact.last - contact.first + 1, step_ns_);
        events.push_back(event);
    }
    std::erase_if(contacts_, ends);
}

void Collisions::add_to(world::Hasher& hasher) const {
    for (const Contact& contact : contacts_) {
        hasher.add(contact.actor);
        hasher.add(contact.other);
        hasher.add(contact.first);
        hasher.add(contact.last);
        hasher.add(contact.worst);
        hasher.add(contact.place);
    }
}

}  // namespace reprise::kernel
