#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "kernel/physics/bullet/box_gap.h"
#include "kernel/physics/bullet/bullet.h"
#include "world/digest.h"
#include "world/tick.h"

namespace reprise::kernel {

/// Who was put elsewhere in a tick, sorted: from there to here nobody has moved.
using Displaced = std::vector<std::uint32_t>;

inline Displaced displaced_by(std::span<const world::CommandT> commands) {
    Displaced actors;
    for (const world::CommandT& command : commands)
        if (command.kind == world::CommandKind::teleport)
            actors.push_back(command.actor);
    std::sort(actors.begin(), actors.end());
    return actors;
}

inline bool holds(const Displaced& displaced, std::uint32_t actor) {
    return std::binary_search(displaced.begin(), displaced.end(), actor);
}

/// The box of a car without mass, where it is.
PlacedBox box_of(const world::CarState& car);

/// After a share of the way.
btTransform between(const btTransform& from, const btTransform& to, double share);

/// The cars without mass (SUMO's, the scenario's, parked ones) as kinematic boxes: they move as
/// told and push like walls. Boxes far from every vehicle with mass cannot be hit in this tick and
/// are not in Bullet: 400 boxes would cost more than everything else together.
///
/// A box enters below 35 m and leaves above 45 m from the nearest vehicle (the gap keeps boxes from
/// going in and out): of two buses no part is further than 9 m from where each is said to be, and
/// nobody drives 5 m in a tick. Who is in is state: it depends on the past, so the digest covers
/// it.
class NearCars {
  public:
    static constexpr double enter_distance = 35;
    static constexpr double leave_distance = 45;
    /// [m] A car that moves further in one tick was put elsewhere (SUMO teleports): no velocity.
    static constexpr double longest_move = 5;
    static constexpr double clearance = 0.2;  ///< [m] under a box: it never rubs on the road

    explicit NearCars(btDynamicsWorld& world);
    ~NearCars();
    NearCars(const NearCars&) = delete;
    NearCars& operator=(const NearCars&) = delete;

    /// Start of a tick: who is in, and from where to where they go. All in id order.
    void choose(std::span<const world::CarState> last,
                std::span<const world::CarState> next,
                std::span<const btVector3> centres,
                const Displaced& displaced = {});

    /// Puts every box where it is after `share` of the tick. Bullet takes the velocities, linear
    /// and angular, from the difference to the pose before.
    void move(double share);

    std::size_t size() const { return boxes_.size(); }

    /// A box in this tick, and the car that it stands for.
    struct Way {
        std::uint32_t id = 0;
        std::uint16_t model = 0;
        btVector3 half;     ///< of the box
        double length = 0;  ///< [m] that its middle moves in the tick
    };

    /// Of a box that is in Bullet's world; null for one that is out. By index, in id order.
    std::optional<Way> way(std::size_t index) const;

    /// Where its middle is after `share` of the tick.
    btTransform pose_at(std::size_t index, double share) const;

    /// The car's own frame (ground below the rear axle) there.
    Eigen::Isometry3d car_at(std::size_t index, double share) const;

    /// How it moves in the tick of `step` seconds.
    struct Motion {
        btVector3 velocity;  ///< [m/s] of the box's middle
        btVector3 spin;      ///< [rad/s]
    };

    Motion motion(std::size_t index, double step) const;

    /// For the rest of the tick the box is not there: a body with mass stands for the car.
    void take_out(std::size_t index);

    /// End of the tick: who was taken out is a box again, where the tick ends, or is forgotten.
    void put_back(std::uint32_t id);
    void forget(std::uint32_t id);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Box;

    void enter(const world::CarState& car);
    void aim(Box& box, const world::CarState* last, const world::CarState& next);
    std::vector<std::unique_ptr<Box>>::iterator place(std::uint32_t id);

    btDynamicsWorld* world_;
    std::vector<std::unique_ptr<btBoxShape>> shapes_;  ///< [i] of vehicle_models()[i]
    std::vector<std::unique_ptr<Box>> boxes_;          ///< sorted by id
};

/// Cars without mass of which one drives into the other in a tick; the lower id first, sorted.
using CarCrashes = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Whom the scenario sends into another car: one that holds its speed or follows a trajectory
/// reacts to nothing, and nothing else would stop the two from going through each other.
///
/// MUST    find each pair of which one is the scenario's, one moves, and whose boxes are more than
///         `deepest_scrape` in each other on their way through the tick.
/// ASSUMES that cars of the demand's keep clear of each other: SUMO sees to that.
/// GOES    by x, so that each of the scenario's cars looks at the few around it.
/// KEEPS   nothing; a pure function of two ticks. About 0.2 us a car.
CarCrashes crashes_among(std::span<const world::CarState> last,
                         std::span<const world::CarState> next,
                         const Displaced& displaced);

/// [m] Less is none: SUMO rounds places, and its cars cut bends.
constexpr double deepest_scrape = 0.1;

}  // namespace reprise::kernel
