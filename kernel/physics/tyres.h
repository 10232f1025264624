#pragma once

#include <array>

#include "kernel/physics/bullet/bullet.h"
#include "kernel/physics/ground.h"

namespace reprise::kernel {

/// btRaycastVehicle with the tyres replaced: Bullet's own weigh longitudinal force half, do not
/// limit it when the car goes straight, and creep on slopes.
///
/// MUST    bound every wheel's force by grip * load, as a circle; hold a braked car still, also on
///         a slope; be a pure function of the body's state and the wheels' settings.
/// ASSUMES four wheels (front left, front right, rear left, rear right); a Bullet world without
///         gravity. The weight is applied here, between springs and tyres: before the springs, the
///         dampers would take it for a movement; after the tyres, as Bullet does it, a braked car
///         creeps down every slope.
/// GOES    each wheel in contact gives a longitudinal row (engine as a given impulse; brakes and
///         rolling resistance as friction that can stop, not push back; both at most what a tyre
///         gives with the slip that ABS and traction control hold) and a lateral row (bounded by
///         the brush model's force; stops side-slip at low speed). A locked wheel that slides
///         pushes against its way, with `sliding_share` of its grip. A few sweeps of projected
///         Gauss-Seidel over the rows, as in Bullet's contact solver, then one velocity update.
/// KEEPS   nothing from one substep to the next.
class RaycastCar : public btRaycastVehicle {
  public:
    RaycastCar(btRigidBody* chassis, WheelRays& rays);

    /// For the coming substep. All [N] except the shares; index as the wheels'.
    struct Wheel {
        double engine = 0;
        double cornering_stiffness = 0;  ///< [1/rad] force per load
        bool locked = false;             ///< by the hand brake
    };

    std::array<Wheel, 4> wheels;
    double total_brake = 0;             ///< [N] shared out by the wheels' loads
    double gravity = 0;                 ///< [m/s^2]
    double grip = 1;                    ///< largest force / load
    double rolling_resistance = 0;      ///< force / load
    std::array<double, 2> anti_roll{};  ///< [N/m] of the front and the rear bar

    /// Whose brakes were let off in the last substep, so that they do not lock.
    std::array<bool, 4> abs{};

    void updateVehicle(btScalar step) override;
    void updateFriction(btScalar step) override;

  private:
    struct Contact;

    void twist_anti_roll_bars(double step);
    int find_contacts(double step, std::array<Contact, 4>& contacts);
    void bound(Contact& contact, double brake_share);

    WheelRays* rays_;
};

}  // namespace reprise::kernel
