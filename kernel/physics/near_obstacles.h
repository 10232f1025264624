#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kernel/physics/bullet/bullet.h"
#include "world/digest.h"
#include "world/obstacle.h"

namespace reprise::kernel {

class Collisions;
class Props;
class Vehicle;

/// What stands beside the road. Only that near a vehicle with mass is in Bullet, which walks over
/// all its bodies several times in each substep.
class NearObstacles {
  public:
    /// [m] from a vehicle's middle to the bounding circle: half a bus, and what it drives in a
    /// tick.
    static constexpr double enter_distance = 12;
    static constexpr double leave_distance = 18;

    /// `obstacles` are sorted by x.
    NearObstacles(std::span<const world::Obstacle> obstacles, btDynamicsWorld& world);
    ~NearObstacles();
    NearObstacles(const NearObstacles&) = delete;
    NearObstacles& operator=(const NearObstacles&) = delete;

    /// Start of a tick. O(log n + obstacles within reach) for each centre.
    void choose(std::span<const btVector3> centres);

    std::size_t size() const { return near_.size(); }

    /// One of those that stand near a vehicle.
    const world::Obstacle& near(std::size_t i) const { return obstacles_[near_[i].index]; }

    /// near(i) stands no longer; those behind it move up.
    void take_out(std::size_t i);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Body {
        std::size_t index;  ///< in obstacles_
        std::unique_ptr<btCollisionShape> shape;
        std::unique_ptr<btRigidBody> body;
    };

    bool within(std::size_t index, std::span<const btVector3> centres, double distance) const;
    Body make(std::size_t index) const;

    btDynamicsWorld* world_;
    std::vector<world::Obstacle> obstacles_;  ///< sorted by x
    double largest_radius_ = 0;
    std::vector<Body> near_;         ///< sorted by index
    std::vector<std::size_t> gone_;  ///< indices of those that were taken out, sorted
};

/// Before a substep of that many seconds: thin poles that a vehicle is about to hit harder than
/// they bear break off. The foot takes `breaks_at` of the vehicle's momentum, the pole is a prop
/// from then on (world::first_broken_id), and Bullet says what becomes of it. Appends their ids.
void break_off(NearObstacles& obstacles,
               const std::vector<std::unique_ptr<Vehicle>>& vehicles,
               double substep,
               Props& props,
               Collisions& collisions,
               std::vector<std::uint32_t>& broken);

}  // namespace reprise::kernel
