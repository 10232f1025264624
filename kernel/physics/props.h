#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "kernel/physics/bullet/box_gap.h"
#include "kernel/physics/bullet/bullet.h"
#include "world/models/prop_models.h"
#include "world/tick.h"

namespace reprise::kernel {

/// The things with mass that nobody drives. One that has come to rest leaves Bullet's world, and is
/// in it again as long as somebody who moves is near enough to touch it in the next tick: so
/// hundreds of standing cones cost nothing, and what stands does not creep. Nothing but positions
/// and velocities decides about it.
class Props {
  public:
    /// `world` must outlive this.
    explicit Props(btDynamicsWorld& world);
    ~Props();
    Props(const Props&) = delete;
    Props& operator=(const Props&) = delete;

    /// A little above this pose of its foot: it settles by itself.
    void add(std::uint32_t id, std::uint16_t model, const Eigen::Isometry3d& pose_world_prop);

    /// Takes it out; returns where it was.
    world::Vec3 remove(std::uint32_t id);

    bool has(std::uint32_t id) const;

    bool empty() const { return things_.empty(); }

    /// At the start of a tick: who is in Bullet's world. `movers` are the vehicles and near cars.
    struct Mover {
        btVector3 centre;
        double reach;  ///< [m] half its length, and what it drives in a tick
    };

    void wake(std::span<const Mover> movers);

    /// Is one of them in Bullet's world?
    bool any_awake() const;

    /// Those that are awake and heavy enough to wreck a car: 50 kg, a person's weight, and more.
    struct Heavy {
        std::uint32_t id = 0;
        PlacedBox box;
        btVector3 velocity;
    };

    std::vector<Heavy> heavy() const;

    /// Where those are that are awake: cars near them must be there, too.
    void add_centres(std::vector<btVector3>& centres) const;

    /// The road's grip, before the substeps of a tick.
    void set_road_friction(double factor);

    /// After the last substep: counts who rests. Appends the states, sorted by id.
    void write(std::vector<world::PropState>& states);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Thing;

    std::vector<std::unique_ptr<Thing>>::iterator place(std::uint32_t id);
    void enter(Thing& thing);
    void leave(Thing& thing);

    btDynamicsWorld* world_;
    std::vector<std::unique_ptr<Thing>> things_;  ///< sorted by id
};

}  // namespace reprise::kernel
