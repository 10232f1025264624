#include "kernel/physics/collisions.h"

#include <algorithm>
#include <tuple>

namespace reprise::kernel {

Collisions::Pair& Collisions::pair(std::uint32_t actor, std::uint32_t other, bool ground) {
    const auto key = std::make_tuple(actor, other, ground);
    const auto key_of = [](const Pair& p) { return std::make_tuple(p.actor, p.other, p.ground); };
    auto at =
        std::lower_bound(pairs_.begin(), pairs_.end(), key, [&](const Pair& p, const auto& k) {
            return key_of(p) < k;
        });
    if (at == pairs_.end() || key_of(*at) != key)
        at = pairs_.insert(at, {actor, other, ground, false, 0, 0, btVector3(0, 0, 0)});
    return *at;
}

void Collisions::gather(const btDispatcher& dispatcher) {
    const int count = dispatcher.getNumManifolds();
    for (int i = 0; i < count; ++i) {
        const btPersistentManifold& manifold =
            *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
        double sum = 0;
        int strongest = 0;
        for (int k = 0; k < manifold.getNumContacts(); ++k) {
            const double impulse = manifold.getContactPoint(k).m_appliedImpulse;
            sum += impulse;
            if (impulse > manifold.getContactPoint(strongest).m_appliedImpulse)
                strongest = k;
        }
        if (sum <= 0)
            continue;
        const btManifoldPoint& point = manifold.getContactPoint(strongest);
        const btCollisionObject* bodies[2] = {manifold.getBody0(), manifold.getBody1()};
        for (int side = 0; side < 2; ++side) {
            const btCollisionObject& self = *bodies[side];
            const btCollisionObject& other = *bodies[1 - side];
            if (self.getUserIndex() != vehicle_body)
                continue;
            Pair& both = pair(actor_of(self), actor_of(other), other.getUserIndex() == ground_body);
            both.impulse += sum;
            if (point.m_appliedImpulse > both.strongest) {
                both.strongest = point.m_appliedImpulse;
                both.position = side == 0 ? point.m_positionWorldOnA : point.m_positionWorldOnB;
            }
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

void Collisions::write(std::vector<world::EventT>& events) const {
    const auto counts = [](const Pair& pair) {
        return pair.always || pair.impulse >= (pair.ground ? least_ground_impulse : least_impulse);
    };
    for (auto pair = pairs_.begin(); pair != pairs_.end(); ++pair) {
        Pair both = *pair;
        bool is_event = counts(both);
        // Ground and obstacles are both the static world: they follow each other in the order.
        const auto next = pair + 1;
        if (next != pairs_.end() && next->actor == both.actor && next->other == both.other) {
            is_event = is_event || counts(*next);
            both.impulse += next->impulse;
            if (next->strongest > both.strongest)
                both.position = next->position;
            pair = next;
        }
        if (!is_event)
            continue;
        world::EventT event;
        event.kind = world::EventKind::collision;
        event.actor = both.actor;
        event.other = both.other;
        event.position = to_vec3(both.position);
        event.value = both.impulse;
        events.push_back(event);
    }
}

}  // namespace reprise::kernel
