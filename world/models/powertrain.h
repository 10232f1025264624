#pragma once

#include <array>

#include "world/models/catalogue.h"

namespace reprise::world {

/// An engine and the gears between it and the wheels. SI; without a gear (a bicycle) the rider's
/// legs are always in the right one.
///
/// Full-load curve: P(w) = P_max (a x + b x^2 - x^3), x = w / w_peak: R. N. Jazar, "Vehicle
/// Dynamics: Theory and Application", 2008, ch. 4.1: a = b = 1 for petrol engines, 0.87 and 1.13
/// for diesels with direct injection. Its P_max is the catalogue's, at the wheels: the losses of
/// the gears are in it.
/// Gears: ZF 8HP (cars), ZF EcoLife 6 AP (buses), Allison 3000 (lorries), Yamaha MT-07 (motor-
/// cycles), as their makers publish them. The final drive lets the engine reach its peak power at
/// the top speed that this power allows, in the `direct` gear (Gillespie, ch. 2; Mitschke/
/// Wallentowitz, part II); higher gears save fuel.
struct Powertrain {
    static constexpr int most_gears = 8;

    int gears = 0;
    std::array<double, most_gears> ratios{};  ///< engine speed / speed along the road [rad/m]
    double power = 0;                         ///< largest, at the wheels [W]
    double most_force = 0;                    ///< what the low gears may pass on to the wheels [N]
    double peak_speed = 0;                    ///< of the engine at its largest power [rad/s]
    double idle_speed = 0;
    double launch_speed = 0;  ///< down to it the clutch or converter slips with full torque
    double limit_speed = 0;   ///< above it there is no fuel
    double linear = 1;        ///< a
    double square = 1;        ///< b
    double shift_time = 0;    ///< [s]

    /// Of the engine's shaft in this gear at `speed` [m/s] along the road, were it not for the
    /// clutch. [rad/s]; gears count from 1.
    double engine_speed(int gear, double speed) const {
        return ratios[static_cast<std::size_t>(gear - 1)] * speed;
    }

    /// What the wheels get in that gear with the throttle open. [N]; `speed` at least 0
    double force(int gear, double speed) const;

    /// The same in the gear that gives most.
    double largest_force(double speed) const;
};

/// `top_speed` is where air and rolling take all of its power. [m/s]
Powertrain powertrain(const VehicleModel& model, double top_speed);

}  // namespace reprise::world
