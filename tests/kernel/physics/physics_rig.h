#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "ground/mesh/ground.h"
#include "kernel/physics/physics.h"
#include "world/tick.h"

/// A proving ground: physics alone, stepped tick by tick with given controls, cars and walkers.
namespace reprise::test {

/// Level square of 4 km at z = 0 around the origin, as road.
ground::GroundMesh flat_ground();

/// As above, rising by `slope` (tangent) towards +x.
ground::GroundMesh inclined_ground(double slope);

/// Road up to x, and a sidewalk of `height` behind its upright kerb.
ground::GroundMesh kerb_ground(double x, double height);

/// All hands off.
world::Control coasting(std::uint32_t actor = 1);

/// Pedals and wheel for actor 1.
world::Control drive(double throttle, double brake, double steer = 0);

class ProvingGround {
  public:
    explicit ProvingGround(const ground::GroundMesh& ground = flat_ground(),
                           const world::TownT& town = {});

    /// Vehicle 1.
    void add_vehicle(const char* model, double speed, double x = 0, double y = 0, double yaw = 0);

    /// One tick under this control; returns vehicle 1.
    const world::VehicleState& step(const world::Control& control);

    const world::VehicleState& vehicle() const { return next_.tick.vehicles.front(); }

    const world::TickDraft& tick() const { return next_; }

    /// For further vehicles; `step` steers only the one that the control names.
    kernel::Physics& physics() { return physics_; }

    /// What the traffic stage would write in the coming ticks.
    std::vector<world::CarState> cars;
    std::vector<world::WalkerState> walkers;
    double road_friction = 1;

  private:
    world::EpisodeT episode_;
    kernel::SolidGround ground_;
    kernel::Physics physics_;
    world::TickDraft next_;
    std::optional<world::SealedTick> last_;
};

/// Along the vehicle's own x axis. [m/s]
double speed_of(const world::VehicleState& vehicle);

/// Steps until the vehicle's speed falls below 1 cm/s; returns the distance driven. [m]
double distance_to_stop(ProvingGround& ground, const world::Control& control);

inline constexpr double tick_seconds = 0.05;

}  // namespace reprise::test
