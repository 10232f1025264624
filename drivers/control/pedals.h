#pragma once

#include <cmath>
#include <cstdint>

#include "world/digest.h"
#include "world/models/car_model.h"
#include "world/tick_generated.h"

namespace reprise::drivers {

/// How hard the driver works the car. [m/s^2], [m], [s]
struct DrivingStyle {
    double acceleration = 2;
    double comfortable_braking = 2;
    double hardest_braking = 8;
    double time_gap = 1.5;
    double standing_gap = 2.5;

    /// Of what it does on a dry road, the share of every acceleration that this road allows. Speeds
    /// are the root of it smaller, so that every distance stays as it is.
    double share = 1;

    double speed_share() const { return std::sqrt(share); }
};

/// On a road of that friction (Tick.road_friction), which falls by `descent` (sine): as ever where
/// the tyres hold well enough for it, slower on snow and ice.
DrivingStyle style_on(double road_friction, double descent, const world::CarModel& car);

/// The acceleration that brings the car to a stop after `distance` metres. Large when there is far
/// to go; brakes harder than `comfort` only where it must. On the curve
/// distance = v^2 / (2 comfort) + v / 2 braking is even and ends without a jerk.
double stop_acceleration(double distance, double speed, double comfort, const DrivingStyle& style);

/// The acceleration that follows a leader `gap` metres ahead, bumper to bumper, who drives our way
/// with `leader_speed` (negative: towards us). Intelligent Driver Model: Treiber, Hennecke and
/// Helbing, Phys. Rev. E 62 (2000), 1805. It panics when somebody cuts in, though he may be faster
/// than we are; therefore braking beyond 3 m/s^2 needs a collision ahead (as in Kesting, Treiber
/// and Helbing, Phil. Trans. R. Soc. A 368 (2010), 4585).
double follow_acceleration(double gap,
                           double speed,
                           double leader_speed,
                           const DrivingStyle& style);

/// The control of one who is to go on as fast as it is, of whom nothing is known but its speed and
/// the road's climb (see Pedals::press).
world::Control rolling_control(
    std::uint32_t actor, const world::CarModel& car, double speed, double climb, double step);

/// Time to cover `distance` from `speed` with a constant acceleration up to `top_speed`. [s]
double travel_time(double distance, double speed, double acceleration, double top_speed);

/// Throttle and brake for a wanted acceleration. Feed-forward from the car's mass, forces and drag,
/// from the slope of the lane, and an integral over what the car made of the last wish (tyres,
/// loads).
class Pedals {
  public:
    /// [m/s^2] Who stands goes on standing while less than that is wanted.
    static constexpr double least_to_start = 0.3;

    struct Position {
        double throttle = 0;
        double brake = 0;
    };

    /// How soon a wish is followed.
    enum class Manner : std::uint8_t {
        gentle,  ///< jerk limited
        exact    ///< at once
    };

    /// `climb` is the sine of the road's slope the way the car drives, or wants to.
    Position press(double wanted,
                   double speed,
                   double climb,
                   const world::CarModel& car,
                   double step,
                   Manner manner = Manner::gentle);

    void add_to(world::Hasher& hasher) const;

  private:
    double asked_ = 0;       ///< [m/s^2] the last wish, jerk limited
    double correction_ = 0;  ///< [m/s^2] what the car lacks
    double last_speed_ = 0;
    bool started_ = false;
    bool holding_ = false;    ///< standing on the brake
    bool saturated_ = false;  ///< a pedal was at its end: nothing to learn from the answer
};

}  // namespace reprise::drivers
