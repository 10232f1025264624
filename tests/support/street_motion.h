#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "world/tick.h"
#include "world/town.h"

namespace reprise::test {

/// How the cars of a street's traffic move, tick by tick, told from the ticks alone: shown them in
/// order, whether a trace holds them or a run makes them, it finds what no real car does. Cars of
/// the demand only: a scenario may tell its own to do anything.
class StreetMotion {
  public:
    /// Where a limit was passed, to look at.
    struct Place {
        std::uint64_t tick = 0;
        std::uint32_t car = 0;
        double value = 0;  ///< in the unit of its figure
    };

    /// Of one limit: how often it was passed, and the worst.
    struct Count {
        std::uint64_t times = 0;
        Place worst;
        std::vector<Place> first;  ///< at most 20
    };

    /// `town` must outlive this. `step` [s] of a tick.
    StreetMotion(const world::TownT& town, double step);

    void see(const world::TickView& tick);

    std::uint64_t car_ticks = 0;  ///< with a tick before
    double driven = 0;            ///< [m] by all of them
    Count slides;  ///< [m] moved by a corner of a car that stands (below 0.1 m/s), beyond its way
    Count sidesteps;      ///< [m] moved sideways by the origin, beyond 0.6 of the way driven
    Count spins;          ///< [rad] turned, beyond 0.45 rad for each metre driven
    Count heading_steps;  ///< [deg] beyond 10 in a tick
    Count jumps;          ///< [m] moved beyond speed times step + 0.3
    Count backward;       ///< [m] moved back, beyond 0.02
    Count overlaps;       ///< [m] deep, of two boxes; once for each pair and tick
    Count hard_bends;     ///< [m/s^2] sideways, beyond 4
    Count dark_brakes;    ///< [m/s^2] of slowing down by more than 1, with the brake lamp off
    Count false_brakes;   ///< [m/s^2] of speeding up by more than 0.3, with the brake lamp on
    Count dark_turns;     ///< [rad] turned in a junction by more than 0.7 without the indicator on
    Count late_lamps;     ///< [rad] turned likewise, with the indicator off half a second before
    std::uint64_t turns = 0;          ///< of more than 0.7 rad; not who goes on around a roundabout
    double slid = 0;                  ///< [m] by all that stand, their corners
    std::set<std::uint32_t> sliders;  ///< who moved by more than 0.1 m in all while standing

    /// A table of them all, for people.
    std::string text() const;

  private:
    void compare(const world::CarState& was, const world::CarState& is);
    void find_overlaps(std::span<const world::CarState> cars);
    void follow_turn(const world::CarState& is);
    void add(Count& count, std::uint32_t car, double value) const;

    struct Turn {
        std::uint32_t junction = world::none;
        std::uint32_t from = world::none;  ///< the lane before it
        double yaw = 0;                    ///< [rad] of the way in
        bool left = false;                 ///< that indicator was on
        bool right = false;
        bool early_left = false;  ///< likewise, half a second before the junction
        bool early_right = false;
    };

    /// For how many ticks somebody is on a lane, and each indicator on.
    struct Lit {
        std::uint32_t lane = world::none;
        int ticks = 0;
        int left = 0;
        int right = 0;
    };

    bool goes_straight_on(std::uint32_t from, std::uint32_t to) const;

    const world::TownT* town_;
    double step_;
    std::uint64_t tick_ = 0;
    std::vector<world::CarState> last_;
    std::map<std::uint32_t, double> slid_by_;
    std::map<std::uint32_t, Turn> turns_;
    std::map<std::uint32_t, Lit> lit_;
};

}  // namespace reprise::test
