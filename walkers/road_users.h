#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "world/digest.h"
#include "world/tick.h"

namespace reprise::walkers {

/// Who drives or stands on a road.
struct RoadUser {
    Eigen::Vector2d rear_axle{0, 0};
    double yaw = 0;                  ///< [rad]
    double yaw_rate = 0;             ///< [rad/s]
    double course = 0;               ///< [rad] that the rear axle goes: long cars of traffic crab
    double speed = 0;                ///< [m/s] along yaw; negative: reverses
    Eigen::Vector2d velocity{0, 0};  ///< [m/s]
    double acceleration = 0;         ///< [m/s^2] along yaw
    std::uint32_t lane = world::none;
    double front_s = 0;  ///< [m] of its front, along that lane
    double stood = 0;    ///< [s] that it has got nowhere; who creeps by a step has not got on
    std::uint16_t model = 0;
    std::uint32_t id = 0;
};

/// Everybody on the roads, where he will be when the next tick is over: one tick of going on as he
/// did. Keeps how long each has stood. Nobody on foot waits for traffic to have made its own step
/// of that tick, so both are made at the same time; what a driver does differently within it is
/// centimetres.
class RoadUsers {
  public:
    /// Called for tick after tick: how fast somebody turns is seen from one to the next. `step`:
    /// [s] between them.
    void look(const world::TickView& last, double step);

    /// SUMO's cars, then vehicles with mass, each by id.
    std::span<const RoadUser> all() const { return all_; }

    /// Nothing where nobody has stood for long.
    void add_to(world::Hasher& hasher) const;

  private:
    /// Somebody who gets nowhere, since when, and from where.
    struct Halt {
        std::uint32_t id = 0;
        Eigen::Vector2d place{0, 0};
        std::uint32_t ticks = 0;
    };

    struct Seen {
        std::uint32_t id = 0;
        Eigen::Vector2d place{0, 0};
        double yaw = 0;
    };

    void add_cars(const world::TickView& last, double step);
    void add_vehicles(const world::TickView& last, double step);
    void count_halts(double step);

    std::vector<RoadUser> all_;
    std::vector<Seen> before_;  ///< cars in the tick before, by id
    std::vector<Halt> halts_;   ///< by id
};

}  // namespace reprise::walkers
