#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/vehicle.h"
#include "world/tick.h"

namespace reprise::kernel {

/// Open doors as kinematic boxes: nobody's weight moves them. They touch all but the vehicle that
/// they hang on. Those of cars far from every vehicle with mass are not there.
class DoorBoxes {
  public:
    explicit DoorBoxes(btDynamicsWorld& world);  ///< must outlive this
    ~DoorBoxes();
    DoorBoxes(const DoorBoxes&) = delete;
    DoorBoxes& operator=(const DoorBoxes&) = delete;

    /// At the start of a tick, from the doors and cars of `next`.
    void choose(const world::TickDraft& next,
                std::span<const std::unique_ptr<Vehicle>> vehicles,
                std::span<const btVector3> centres);

    /// Before a substep: those on vehicles with mass go where these are.
    void move(std::span<const std::unique_ptr<Vehicle>> vehicles);

    /// Those of a car that becomes a vehicle with mass: they hang on that from the next tick on.
    void drop(std::uint32_t actor);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Box;

    void enter(const world::Door& door, const world::VehicleModel& model);

    btDynamicsWorld* world_;
    std::vector<std::unique_ptr<Box>> boxes_;  ///< sorted by (actor, door)
};

}  // namespace reprise::kernel
