#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include <Eigen/Geometry>

#include "kernel/physics/guide.h"
#include "world/digest.h"
#include "world/models/car_model.h"
#include "world/models/driveline.h"
#include "world/tick_generated.h"

class btDynamicsWorld;
class btRigidBody;
class btVector3;

namespace reprise::kernel {

class Ground;
struct PlacedBox;

/// Does somebody keep a two-wheeler upright? Cars need nobody.
enum class Balance : std::uint8_t { kept, lost };

/// The car model. A rigid body on four massless wheels, each a ray downwards with spring and damper
/// (Bullet's btRaycastVehicle), on tyres of our own (kernel/physics/tyres.h); its numbers are in
/// world/models/car_model.h. In a substep of h seconds:
///
///  steering     the wheel angle follows the control at most at `steering_rate`; the two front
///               wheels stand at Ackermann angles, so that all axles meet in the turning centre.
///  engine       its full-load curve, through gears that change by themselves
///               (world/models/driveline.h, powertrain.h), on the driven axle; the
///               pedal asks for a share of what the best gear gives. Backwards in the first gear,
///               fading out towards `reverse_speed`. A throttle at zero rolls freely: no engine
///               brake.
///  brakes       up to `brake_deceleration * mass`, shared out by the loads that the wheels carry
///               just then (electronic brake-force distribution); ABS holds a wheel's slip at
///               `held_slip` when they would lock it, and traction control likewise, so that it
///               can be steered. The hand brake locks the rear wheels, and those slide.
///  resistance   air 0.5 rho cdA v^2 against the velocity; rolling `rolling_resistance` * load.
///  suspension   spring and damper for each wheel from a natural frequency and damping ratios, in
///               proportion to the load that the wheel carries at rest, so that the body stands
///               level; an anti-roll bar on each axle.
///  tyres        lateral force by the brush model (Pacejka, "Tire and Vehicle Dynamics", 3rd ed.,
///               ch. 3), all force within a friction circle of grip * road_friction * load.
///
/// Left out: the wheels' own spin (ABS and traction control hold their slip at once), inertia of
/// engine and gears, suspension kinematics, aerodynamic lift, tyre relaxation length.
/// Sources: T. D. Gillespie, "Fundamentals of Vehicle Dynamics", SAE 1992, ch. 2 (power-limited
/// acceleration), 3 (braking), 4 (road loads), 5 (ride), 6 (cornering);
/// M. Mitschke and H. Wallentowitz, "Dynamik der Kraftfahrzeuge", 5th ed., parts I and III.
///
/// A vehicle with mass in a Bullet world. Costs about 2 us for each substep.
class Vehicle {
  public:
    /// At rest on its wheels at this pose (ground below the rear axle), rolling ahead with `speed`.
    /// `world` and `ground` must outlive the vehicle.
    Vehicle(std::uint32_t id,
            std::uint16_t model,
            btDynamicsWorld& world,
            const Ground& ground,
            const Eigen::Isometry3d& pose_world_vehicle,
            double speed,
            Balance balance = Balance::kept);
    ~Vehicle();
    Vehicle(const Vehicle&) = delete;
    Vehicle& operator=(const Vehicle&) = delete;

    std::uint32_t id() const { return id_; }

    const world::CarModel& model() const { return model_; }

    std::uint16_t model_index() const { return model_index_; }

    btRigidBody& body() const;

    /// Its collision box, where it is.
    PlacedBox box() const;

    /// World, of the origin, after the last tick.
    const world::Vec3& position() const { return last_position_; }

    /// Holds until the next one.
    void set_control(const world::Control& control);

    /// From the next tick on it is where the trajectory says, and nothing moves it until it is let
    /// go. Its time 0 is tick `start`.
    void follow(world::Trajectory trajectory, std::uint64_t start);

    /// Moved by forces again.
    void let_go();

    /// Somewhere else, on the ground there, at rest on its wheels, rolling ahead with `speed`. What
    /// it has driven stays.
    void teleport(const Eigen::Isometry3d& pose_world_vehicle, double speed);

    /// How often it was put down somewhere: each time it has another body in Bullet, whose address
    /// may be the old one's or not.
    std::uint32_t times_put_down() const { return times_put_down_; }

    /// [m/s] along its heading, at once; turning as its wheels stand.
    void set_speed(double speed);

    /// As a car without mass moves whose `middle` (world) has this velocity.
    void move_as(const btVector3& velocity, const btVector3& spin, const btVector3& middle);

    /// A two-wheeler that nobody balances begins to fall, to the side to which it leans already.
    void tip_over();

    /// Before the substeps of the tick that ends at `tick`: does it follow, and where to?
    void aim(std::uint64_t tick, double step);

    /// Does it follow in this tick?
    bool is_guided() const { return guided_; }

    /// Follows for one substep, to where it is after `share` of the tick.
    void be_guided(double share);

    /// Behind the substeps: motion and wheels as they are on the trajectory.
    void settle(double step);

    /// One that follows is moved by forces for the rest of the tick, from where it is after `share`
    /// of it: somebody is so near that they may hit each other.
    void break_loose(double share);

    /// They did not: behind the substeps it is where the trajectory says.
    void fall_in(double step);

    /// Changes the body's velocity by all that acts within `step` seconds: weight, engine, brakes,
    /// air, suspension, tyres. Called before each Bullet substep.
    void drive(double road_friction, double step);

    /// Called once a tick of `step` seconds, after the last substep.
    world::VehicleState state_after(double step);

    /// The wheel with this index: front left, front right, rear left, rear right.
    world::WheelState wheel(int index) const;

    /// See Physics::nudge.
    void nudge(std::string_view field, std::int64_t units);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Chassis;

    void put_down(btDynamicsWorld& bullet,
                  const Eigen::Isometry3d& pose_world_vehicle,
                  double speed);
    Eigen::Isometry3d pose() const;
    void hold(bool guided);
    void move_as_guided();
    void roll_wheels(double step);
    void nudge_wheel(int index, std::string_view field, std::int64_t units);

    void stay_where_it_lies(double step);
    void steer(double step);
    void press_pedals(double road_friction, double step);

    std::uint32_t id_;
    std::uint16_t model_index_;
    world::CarModel model_;
    const Ground* ground_;
    std::unique_ptr<Chassis> chassis_;
    std::uint32_t times_put_down_ = 0;
    world::Driveline driveline_;
    world::Control control_;
    double steering_angle_ = 0;
    double odometer_ = 0;
    double lies_still_ = 0;  ///< [s] off its wheels
    world::Vec3 last_position_;
    world::Vec3 last_velocity_;
    std::optional<Guide> guide_;  ///< what it follows, or is about to
    bool guided_ = false;
};

}  // namespace reprise::kernel
