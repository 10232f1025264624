#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kernel/physics/bullet/box_gap.h"
#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/collisions.h"
#include "kernel/physics/impact.h"
#include "kernel/physics/near_cars.h"
#include "kernel/physics/props.h"
#include "kernel/physics/vehicle.h"

namespace reprise::kernel {

class Ground;

using Vehicles = std::vector<std::unique_ptr<Vehicle>>;  ///< sorted by id

/// Cars without mass (SUMO's, the scenario's, parked ones) that something with mass hits, or that
/// drive into each other: they become vehicles with mass, and stay that.
///
/// MUST    let the first impulse of a crash act between the masses and the true velocities of both;
///         leave those alone that are only passed closely.
/// ASSUMES Bullet finds a contact where the gap is less than its breaking threshold of 2 cm.
/// GOES    before a substep, a car whose box comes within `reach` of a body with mass is taken out
///         of Bullet's world, and a vehicle stands in for it where it is, as fast as it is. So do
///         those that are within reach of such a one: it may be pushed against them. Two that drive
///         into each other in this tick are vehicles from its start on. At the end of
///         the tick those are wrecks that were touched (see Collisions) by what had mass before, by
///         another wreck, or by whom they drove into; for the others it is as if nothing had been.
///         Likewise a vehicle on a trajectory breaks loose where it comes within `reach` of another
///         one, and leaves the trajectory for good where they touched.
/// KEEPS   nothing from one tick to the next.
class Wrecks {
  public:
    static constexpr double reach = 0.03;  ///< [m]

    /// `ground` must outlive this; `step` [s] of a tick.
    Wrecks(btDynamicsWorld& world, const Ground& ground, double step)
        : world_(&world),
          ground_(&ground),
          step_(step) {}

    /// Start of a tick, when all know where they go.
    /// `crashes` are those of the tick.
    void begin(const NearCars& cars,
               const Vehicles& vehicles,
               const Props& props,
               CarCrashes crashes);

    /// Before a substep that goes from `before` to `after`, shares of the tick; the vehicles on
    /// trajectories are where it ends. Returns those who stand in from this substep on.
    std::vector<Vehicle*> stand_in(
        double before, double after, NearCars& cars, Vehicles& vehicles, const Props& props);

    /// Then: returns those who break loose from their trajectory in this substep.
    std::vector<Vehicle*> break_loose(double before, Vehicles& vehicles);

    /// End of the tick, before collisions are written.
    void decide(Collisions& collisions, NearCars& cars, Vehicles& vehicles);

    /// Of the last tick, sorted by id.
    std::span<const Wreck> made() const { return made_; }

    /// Who left his trajectory in the last tick, ids in order.
    std::span<const std::uint32_t> derailed() const { return derailed_; }

  private:
    /// Something with mass that may push.
    struct Pusher {
        std::uint32_t id = 0;
        PlacedBox box;
        double room = 0;  ///< [m] around its middle, with what it moves in a tick
    };

    struct Trial {
        std::uint32_t id = 0;
        double speed = 0;      ///< [m/s] before
        std::uint32_t by = 0;  ///< who hit it; 0: nobody
    };

    std::vector<Pusher> pushers(const Vehicles& vehicles, const Props& props) const;
    void find_near(const NearCars& cars, std::span<const Pusher> pushers);
    bool drives_into_one(std::uint32_t id) const;
    bool drove_into(std::uint32_t one, std::uint32_t other) const;
    void decide_loose(const Collisions& collisions, Vehicles& vehicles);
    Vehicle& replace(std::size_t index, double share, NearCars& cars, Vehicles& vehicles);
    using Touching = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

    std::uint32_t hit_by(const Trial& trial,
                         const Touching& touching,
                         const Vehicles& vehicles) const;

    btDynamicsWorld* world_;
    const Ground* ground_;
    double step_;
    std::vector<std::size_t> near_;  ///< boxes that somebody may reach; indices in NearCars
    std::vector<std::uint32_t> heavy_props_;  ///< their ids
    CarCrashes crashes_;
    std::vector<Trial> trials_;  ///< sorted by id
    std::vector<Wreck> made_;
    std::vector<std::uint32_t> loose_;  ///< who broke loose in this tick, ids in order
    std::vector<std::uint32_t> derailed_;
};

}  // namespace reprise::kernel
