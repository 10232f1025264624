#pragma once

#include "world/digest.h"
#include "world/models/powertrain.h"

namespace reprise::world {

/// The gears of one vehicle and the engine's speed.
///
/// MUST    give the wheels what the pedal asks for as far as the gear that is in allows; change
///         gears by itself, without hunting between two of them.
/// GOES    the pedal asks for a force, a share of what the best gear would give (as cars with an
///         electronic throttle do). A gear that gives less is changed for the highest one that
///         gives it (kick-down); one that gives more for the highest that still does with
///         `reserve`, at `calm` engine speed. While gears change the higher of both carries the
///         force: automatic gearboxes and double clutches do not interrupt it.
/// KEEPS   gear, the change that is going on, the engine's speed.
/// Left out: engine brake (a throttle at zero rolls freely, as cars that "sail"), and the inertia
/// of what turns, of which the first gears feel most (Gillespie, eq. 2-9).
class Driveline {
  public:
    /// `train` must outlive it. In the gear for this speed.
    Driveline(const Powertrain& train, double speed);

    /// Changes gears, and turns the engine. `wanted` [N] of drive_force (world/models/car_model.h);
    /// returns the force at the wheels along x. [N]; `speed` along x.
    double drive(double wanted, double throttle, bool reverse, double speed, double step);

    /// Whoever is moved by others: in the gear for this speed, along x.
    void settle(double speed);

    /// 1 is the first; -1 backwards; 0 without gears.
    int gear() const;

    /// [rad/s]
    double engine_speed() const { return engine_speed_; }

    void set_engine_speed(double speed) { engine_speed_ = speed; }

    void add_to(Hasher& hasher) const;

  private:
    int wanted_gear(double force, double speed) const;
    int highest_with(double force, double engine_speed, double speed) const;
    void shift(double force, double speed, double step);
    void turn_engine(double throttle, double speed, double step);

    const Powertrain* train_;
    int gear_ = 0;
    int last_gear_ = 0;        ///< the one before, while they change
    double changing_ = 0;      ///< [s] until the change is done
    double since_change_ = 0;  ///< [s]
    double engine_speed_ = 0;
    bool reverse_ = false;
};

}  // namespace reprise::world
