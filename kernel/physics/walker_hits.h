#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/collisions.h"
#include "kernel/physics/near_cars.h"
#include "kernel/physics/vehicle.h"
#include "world/tick.h"

namespace reprise::kernel {

/// Walkers against vehicles with mass. A walker is an upright cylinder; the test against a
/// vehicle's box is exact in the plane and needs no bodies in Bullet.
///
/// On the first touch the walker takes on the vehicle's speed (a plastic hit;
/// Mitschke/Wallentowitz, accidents with pedestrians: restitution is small): impulse = walker mass
/// * closing speed, and the same against the vehicle. The stage of the pedestrians finds the event
/// in the last tick and lays the walker down; who lies is not hit again. A walker who bumps into a
/// vehicle that stands (its surface comes closer by less than 0.5 m/s) is no event. Cars without
/// mass do not hit walkers.
class WalkerHits {
  public:
    static constexpr double least_vehicle_speed = 0.5;

    /// Start of a tick: the walkers within reach of a vehicle, and where they go.
    void choose(std::span<const world::WalkerState> last,
                std::span<const world::WalkerState> next,
                std::span<const btVector3> centres,
                double step,
                const Displaced& displaced = {});

    /// Once for each substep, with the walkers where they are after `share` of the tick.
    void test(double share,
              std::span<const std::unique_ptr<Vehicle>> vehicles,
              Collisions& collisions);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Near {
        std::uint32_t id;
        double radius;
        double height;
        double mass;
        btVector3 from;
        btVector3 way;  ///< in this tick
        btVector3 velocity;
    };

    void hit(const Near& walker,
             const btVector3& p_walker,
             Vehicle& vehicle,
             Collisions& collisions);

    std::vector<Near> near_;
    /// (vehicle, walker) that touch since their hit: one hit is one event. Sorted.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> touching_;
};

}  // namespace reprise::kernel
