#pragma once

#include <cstdint>
#include <vector>

#include "kernel/physics/bullet.h"
#include "world/tick_generated.h"

namespace reprise::kernel {

/// Sums up the contact impulses of a tick and makes events of them.
///
/// One event for each ordered pair (actor with mass, other) and tick: two vehicles with mass that
/// hit each other make two, so that everyone finds his own under `actor`. `other` is 0 for the
/// static world. value: sum over the tick's substeps of the normal impulses [N s]; position: the
/// contact point with the largest. Wheels are rays and make none.
///
/// Not events: less than 20 N s in a tick (a touch that goes on, 1.5 ton at 1 cm/s); against the
/// ground less than 200 N s (a bumper that scrapes over a kerb). Ground and obstacles together are
/// one event, of all their impulses, when either of them is one.
class Collisions {
  public:
    static constexpr double least_impulse = 20;
    static constexpr double least_ground_impulse = 200;

    /// A new tick.
    void clear() { pairs_.clear(); }

    /// After each substep: what Bullet's solver applied.
    void gather(const btDispatcher& dispatcher);

    /// For impulses that do not come from Bullet, and are events whatever their size.
    void add(std::uint32_t actor, std::uint32_t other, double impulse, const btVector3& position);

    /// Appends the events, sorted by (actor, other).
    void write(std::vector<world::EventT>& events) const;

  private:
    struct Pair {
        std::uint32_t actor = 0;
        std::uint32_t other = 0;
        bool ground = false;
        bool always = false;  ///< an event even if small
        double impulse = 0;
        double strongest = 0;
        btVector3 position;  ///< of the strongest
    };

    Pair& pair(std::uint32_t actor, std::uint32_t other, bool ground);

    std::vector<Pair> pairs_;  ///< sorted by (actor, other, ground)
};

}  // namespace reprise::kernel
