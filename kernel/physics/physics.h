#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include <Eigen/Geometry>

#include "kernel/physics/impact.h"
#include "kernel/physics/solid_ground.h"
#include "world/episode_generated.h"
#include "world/obstacle.h"
#include "world/tick.h"
#include "world/town.h"
#include "world/trajectory.h"

namespace reprise::kernel {

/// Everything with mass: Bullet in double precision, one world, single-threaded, no sleeping,
/// bodies in id order. Ground, kerbs, buildings, trees are static; SUMO's and parked cars are
/// kinematic boxes near physics vehicles (kernel/physics/near_cars.h) until something hits them
/// (kernel/physics/wrecks.h); walkers are upright
/// cylinders that vehicles run into (kernel/physics/walker_hits.h); props are boxes that may be
/// pushed around (kernel/physics/props.h), and so are signs once they broke off
/// (kernel/physics/near_obstacles.h). What becomes an event:
/// kernel/physics/collisions.h. The car model is documented in kernel/physics/vehicle.h. Costs for
/// a tick of 10 substeps and one vehicle: 20 us; 28 us beside 10 near cars, 50 us beside 50.
class Physics {
  public:
    /// `ground` must outlive this; `obstacles` are sorted by x, and copied.
    Physics(const world::EpisodeT& episode,
            const SolidGround& ground,
            std::span<const world::Obstacle> obstacles);
    ~Physics();
    Physics(const Physics&) = delete;
    Physics& operator=(const Physics&) = delete;

    /// Puts a vehicle with mass into the world, at rest on its wheels at this pose (vehicle frame:
    /// ground below the rear axle), rolling ahead with `speed`.
    void add_vehicle(std::uint32_t id,
                     std::uint16_t model,
                     const Eigen::Isometry3d& pose_world_vehicle,
                     double speed);

    /// Takes it out again; returns where it was.
    world::Vec3 remove_vehicle(std::uint32_t id);

    /// Puts a prop on the ground with its foot at this pose, and takes it out again.
    void add_prop(std::uint32_t id, std::uint16_t model, const Eigen::Isometry3d& pose_world_prop);
    Eigen::Isometry3d prop_stance(std::uint16_t model,
                                  const Eigen::Vector3d& p_world,
                                  double yaw) const;
    bool has_prop(std::uint32_t id) const;
    world::Vec3 remove_prop(std::uint32_t id);
    /// A vehicle of this model at rest on the ground there; see kernel/physics/stance.h.
    Eigen::Isometry3d stance(std::uint16_t model, const Eigen::Vector3d& p_world, double yaw) const;

    /// From the next tick on the vehicle is where the trajectory says, until that ends; its time 0
    /// is tick `start`. Or moved by forces again. See kernel/physics/guide.h.
    void follow(std::uint32_t id, world::Trajectory trajectory, std::uint64_t start);
    void let_go(std::uint32_t id);

    /// Puts it elsewhere, as add_vehicle does; what it has driven stays.
    void teleport(std::uint32_t id, const Eigen::Isometry3d& pose_world_vehicle, double speed);

    /// [m/s] along its heading, at once.
    void set_speed(std::uint32_t id, double speed);

    /// Stage 5. Applies next.tick.controls, moves the kinematic bodies from `last` to `next` in
    /// equal substeps, steps Bullet, and writes next.tick.vehicles, wheels and props (sorted) and
    /// the events of collisions that begin and end.
    void advance(const world::TickView& last, world::TickDraft& next);

    /// Cars without mass that became vehicles in the last advance(); sorted by id. They are in
    /// next.tick.vehicles, no longer in next.traffic.cars, and hold until remove_vehicle. See
    /// kernel/physics/wrecks.h.
    std::span<const Wreck> wrecks() const;

    /// Ids of the vehicles that left their trajectory in the last advance(), as they crashed; in
    /// order.
    std::span<const std::uint32_t> derailed() const;

    /// What hit whom in the tick of the last advance(); sorted by (actor, other).
    std::span<const Impact> impacts() const;

    /// A drill's: moves what lies behind a recorded number of a vehicle or of its wheels by so many
    /// units in the last place.
    void nudge(std::uint32_t id, std::string_view field, std::int64_t units);

    /// Of all bodies' transforms and velocities, their order in Bullet, wheels, contacts with the
    /// impulses kept for warm starting, and collisions that go on. Bullet's trees of bounding boxes
    /// are not read: they find the same pairs in any shape, and pairs are sorted.
    std::uint64_t digest() const;

  private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace reprise::kernel
