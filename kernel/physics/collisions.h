#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/impact.h"
#include "world/digest.h"
#include "world/tick_generated.h"

namespace reprise::kernel {

/// Sums up the contact impulses of a tick, and makes two events of a contact: `collision` in its
/// first tick, `collision_ended` when it has been over for half a second, or with the run.
///
/// One contact for each pair of an actor with mass and another actor, or the static world (`other`
/// is 0); of two with mass, `actor` is the one with the lower id. Touches with gaps of less than
/// half a second belong together. collision: value is the impulse of that tick [N s], position the
/// contact point with the largest. collision_ended: value and position are those of the worst tick,
/// duration [s] is from the first touch to the last. The impulse of a tick is the size of the sum
/// of all that the two gave each other at their points of contact, along the normals: what one
/// takes from the other's momentum. Who is wedged in pushes to both sides, which is none. Wheels
/// are rays and touch nothing.
///
/// No touch: less than 20 N s in a tick (1.5 ton at 1 cm/s); against the ground less than 200 N s
/// (a bumper that scrapes over a kerb). Ground and obstacles together are one touch, of all their
/// impulses, when either of them is one.
class Collisions {
  public:
    static constexpr double least_impulse = 20;
    static constexpr double least_ground_impulse = 200;
    static constexpr std::uint64_t longest_gap_ns = 500'000'000;

    explicit Collisions(std::uint64_t step_ns) : step_ns_(step_ns) {}

    /// A new tick.
    void clear() { pairs_.clear(); }

    /// After each substep: what Bullet's solver applied.
    void gather(const btDispatcher& dispatcher);

    /// For impulses that do not come from Bullet, and are touches whatever their size.
    void add(std::uint32_t actor, std::uint32_t other, double impulse, const btVector3& position);

    /// Who touched whom so far in this tick, (actor, other), sorted.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> touching() const;

    /// As if it had touched nobody in this tick.
    void forget(std::uint32_t actor);

    /// Ends the tick: appends the events of contacts that end, then of those that begin, each
    /// sorted by (actor, other). In the run's last tick all end.
    void write(std::uint64_t tick, bool is_last, std::vector<world::EventT>& events);

    /// The tick's touches, sorted by (actor, other); valid until the next one. After write().
    std::span<const Impact> impacts() const { return impacts_; }

    /// The contacts that go on; nothing where there is none.
    void add_to(world::Hasher& hasher) const;

  private:
    struct Pair {
        std::uint32_t actor = 0;
        std::uint32_t other = 0;
        bool ground = false;
        bool always = false;      ///< a touch even if small
        bool mirrored = false;    ///< the same as the pair of its other, whose id is lower
        btVector3 push{0, 0, 0};  ///< [N s] on the actor
        double impulse = 0;       ///< [N s] what has no direction; of a touch: all
        double strongest = 0;
        btVector3 position;  ///< of the strongest
    };

    struct Contact {
        std::uint32_t actor = 0;
        std::uint32_t other = 0;
        std::uint64_t first = 0;  ///< tick
        std::uint64_t last = 0;   ///< tick
        double worst = 0;         ///< [N s] of a tick
        world::Vec3 place;        ///< of the worst
    };

    void gather_unyielding(const btPersistentManifold& manifold);

    Pair& pair(std::uint32_t actor, std::uint32_t other, bool ground);
    std::vector<Pair> touches() const;
    void touch(const Pair& pair, std::uint64_t tick, std::vector<world::EventT>& events);
    template <typename Ends>
    void end(std::vector<world::EventT>& events, Ends ends);

    std::uint64_t step_ns_;
    std::vector<Pair> pairs_;  ///< sorted by (actor, other, ground)
    std::vector<Impact> impacts_;
    std::vector<Contact> contacts_;  ///< that go on; sorted by (actor, other)
};

}  // namespace reprise::kernel
