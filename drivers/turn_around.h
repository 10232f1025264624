#pragma once

#include <cstdint>
#include <optional>

#include <Eigen/Core>

#include "drivers/control/ego.h"
#include "world/digest.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::drivers {

/// Turns a car around between the kerbs of a street that is too narrow for its turning circle:
/// ahead with full lock until the front is at one kerb, back with the other lock until the rear is
/// at the other one, and so on (a three-point turn).
///
/// MUST    keep all corners of the car between the kerbs, of one that is nearly as long as the
///         street is wide all wheels; stop for everybody whom it comes near.
/// ASSUMES that the street is straight for a car's length.
/// GOES    to and fro between the kerbs; the other way as well where somebody stands in this one,
///         who may wait for us.
/// KEEPS   the street, the gear, how often it was changed, and since when somebody is in the way.
class TurnAround {
  public:
    /// How far back from the end of its lane the car begins. [m]
    static constexpr double before_end = 4;

    /// The street, seen along the lane that the car wants to leave on.
    struct Street {
        Eigen::Vector2d origin = {0, 0};  ///< on that lane's centre line, world
        double yaw = 0;                   ///< [rad] of that lane
        double left = 0;                  ///< [m] to the kerb on the left
        double right = 0;                 ///< [m] to the kerb on the right
        double climb = 0;                 ///< sine of its slope along `yaw`
    };

    struct Move {
        double speed = 0;  ///< [m/s] wanted; negative: backwards
        double steer = 0;  ///< as in Control
    };

    /// Of a link that turns around and is tighter than the car can turn; none: the car can follow
    /// it as any other, or is too long to turn on this street at all.
    static std::optional<Street> street_of(const world::TownT& town,
                                           std::uint32_t lane,
                                           const world::Link& link,
                                           const world::VehicleModel& model);

    void begin(const Street& street, const Ego& ego);

    /// The car points along its new lane, or gave up.
    bool done() const { return done_; }

    Move next(const world::TickView& last, const Ego& ego);

    /// Sine of the street's slope the way the car points.
    double climb(const Ego& ego) const;

    void add_to(world::Hasher& hasher) const;

  private:
    double lock(const Ego& ego, bool forward, double share) const;
    double beyond_kerbs(const Ego& ego, double distance, bool forward, double share) const;
    double room(const Ego& ego, bool forward, double share, double most) const;
    bool comes_around(const Ego& ego) const;
    bool meets_somebody(const world::TickView& last, const Ego& ego, bool forward) const;
    void change_gear();
    bool goes_the_other_way(const world::TickView& last, const Ego& ego) const;
    std::optional<double> lock_that_passes(const world::TickView& last, const Ego& ego) const;

    Street street_;
    double side_ = 1;  ///< 1: turns left, -1: right
    bool forward_ = true;
    bool done_ = true;
    std::uint32_t gear_changes_ = 0;
    std::uint32_t waiting_ticks_ = 0;  ///< for somebody, in this gear
};

}  // namespace reprise::drivers
