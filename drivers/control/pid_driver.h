#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/control/ego.h"
#include "drivers/control/pedals.h"
#include "drivers/way/path.h"
#include "world/digest.h"

namespace reprise::drivers {

/// Proportional, integral and differential terms of an error, the integral over the last ten.
class Pid {
  public:
    struct Gains {
        double proportional = 0;
        double integral = 0;      ///< [1/s]
        double differential = 0;  ///< [s]
    };

    explicit Pid(const Gains& gains) : gains_(gains) {}

    double answer(double error, double step);

    void add_to(world::Hasher& hasher) const;

  private:
    Gains gains_;
    std::array<double, 10> errors_ = {};  ///< a ring
    std::size_t count_ = 0;               ///< taken in so far
};

/// Hands and feet of the modular pipeline's local planner in the paper on CARLA (Dosovitskiy et
/// al., CoRL 2017): a PID on the speed, another on the direction of a waypoint ahead, 20 km/h, and
/// a full stop for whatever is in the way. It sees with the eyes of the built-in driver and takes
/// its way. Gains, waypoints and limits as CARLA's own agents have them (local_planner.py,
/// controller.py, MIT), the steering as a share of the lock.
class PidDriver {
  public:
    static constexpr double cruise = 20 / 3.6;  ///< [m/s]

    struct Answer {
        Pedals::Position pedals;
        double steer = 0;
    };

    /// `allowed`: [m/s^2] what those in the way, lights and right of way allow; `most`: [m/s] what
    /// the road and the scenario allow; `share` as in DrivingStyle.
    Answer drive(
        const Ego& ego, const Path& path, double allowed, double most, double share, double step);

    void add_to(world::Hasher& hasher) const;

  private:
    Pid speed_{{1.0, 0.05, 0}};
    Pid steering_{{1.95, 0.05, 0.2}};
    bool stops_ = false;  ///< for a hazard
};

}  // namespace reprise::drivers
