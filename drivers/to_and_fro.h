#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "drivers/control/ego.h"
#include "world/digest.h"
#include "world/tick.h"

namespace reprise::drivers {

/// Out of a gap that is hardly longer than the car, as from between two who are parked: ahead with
/// the wheels turned to the free side, back with the other lock, and so on, until the way out leads
/// past who stands ahead.
///
/// MUST    come near nobody; keep its tail in its lane; end.
/// ASSUMES that the road is straight for some metres, and the place beside it free.
/// KEEPS   where it goes, the gear, how often that was changed, and since when it stands.
class ToAndFro {
  public:
    struct Move {
        double speed = 0;  ///< [m/s] wanted; negative: backwards
        double steer = 0;  ///< as in Control
    };

    /// `step`: [s] of a tick.
    explicit ToAndFro(double step) : step_(step) {}

    /// To a line `aside` [m] left of one through `origin`, which goes `direction`.
    void begin(const Eigen::Vector2d& origin, const Eigen::Vector2d& direction, double aside);

    bool is_on() const { return on_; }

    /// Of the last time: it is where it wanted to be.
    bool has_come_out() const { return out_; }

    void end() { on_ = false; }

    /// While it is on; ends when it is out, or finds no way.
    Move next(const world::TickView& last, const Ego& ego);

    void add_to(world::Hasher& hasher) const;

  private:
    double steer_to_line(double beside, double heading, const Ego& ego) const;
    bool is_shut(const world::TickView& last, const Ego& ego, double steer) const;
    bool tail_leaves_lane(double beside, double heading, const Ego& ego) const;
    void change_gear();

    double step_;
    bool on_ = false;
    bool out_ = false;
    Eigen::Vector2d origin_{0, 0};
    Eigen::Vector2d direction_{1, 0};
    double aside_ = 0;  ///< [m]
    bool forward_ = true;
    std::uint32_t gear_changes_ = 0;
    std::uint32_t standing_ticks_ = 0;
};

}  // namespace reprise::drivers
