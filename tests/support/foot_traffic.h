#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "world/geometry2d.h"
#include "world/obstacle.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::test {

/// How the people of a street go, tick by tick, told from the ticks alone: shown them in order, it
/// finds who is inside of a car or of what stands there, and how everybody comes onto the road.
class FootTraffic {
  public:
    /// Where a limit was passed, to look at.
    struct Place {
        std::uint64_t tick = 0;
        std::uint32_t walker = 0;
        std::uint32_t other = 0;  ///< a vehicle's id, a prop's, or an obstacle's number
        double value = 0;         ///< [m] deep, or in the unit of its figure
        double x = 0;
        double y = 0;
    };

    struct Count {
        std::uint64_t times = 0;
        Place worst;
        std::vector<Place> first;  ///< at most 20
    };

    /// Both must outlive this. `step` [s] of a tick.
    FootTraffic(const world::TownT& town, const world::LaneMap& lanes, double step);

    void see(const world::TickView& tick);

    std::uint64_t walker_ticks = 0;
    Count in_cars;  ///< [m] deep in the box of SUMO's car or of a vehicle with mass, on his feet
    Count hit;      ///< likewise, of who lies since, or falls within a quarter of a second
    Count in_obstacles;  ///< [m] of his middle in what stands there
    Count in_props;      ///< [m] deep
    Count in_others;     ///< [m] deep in somebody else
    Count jumps;         ///< [m] beyond speed times step + 0.05

    std::uint64_t at_green =
        0;  ///< stepped onto a crossing whose light was green in the last second
    std::uint64_t on_unlit = 0;   ///< onto one without lights
    std::uint64_t elsewhere = 0;  ///< onto the road beside crossings
    Count at_red;                 ///< [s] since it was green
    Count without_gap;  ///< [s] until a car that drives on as it does would be where he steps,
                        ///< below 1.5
    std::uint64_t removed = 0;   ///< gone, and not from lying
    std::uint64_t standing = 0;  ///< walker-ticks below 0.1 m/s, on their feet
    double way = 0;              ///< [m] by all of them
    Count stood;          ///< [s] within a metre, from one minute on; once for each such stay
    Count stood_on_road;  ///< likewise, of who is on the road, from 10 s on
    Count dithers;  ///< [1] turns to the other side by more than 20 deg within a second, from 4 on
    std::set<std::uint32_t> who_crossed;
    std::set<std::uint32_t> who_crossed_elsewhere;

    /// A table of them all, for people.
    std::string text() const;

    /// Every place that was kept, a line each.
    std::string places() const;

  private:
    struct Walker {
        Eigen::Vector3d place{0, 0, 0};
        bool on_road = false;
        bool down = false;
        std::uint64_t seen = 0;
        std::vector<Place> inside;   ///< of cars, lately
        Eigen::Vector2d stay{0, 0};  ///< where he has been since
        std::uint64_t stay_since = 0;
        double yaw = 0;
        double turn = 0;  ///< [rad] that he turns to one side
        std::uint64_t turned_at = 0;
        unsigned swings = 0;
    };

    void look_at(const world::WalkerState& walker, const world::TickView& tick);
    void see_stay(const world::WalkerState& walker, bool on_road, Walker& known);
    void see_swings(const world::WalkerState& walker, Walker& known);
    void find_in_boxes(const world::WalkerState& walker,
                       const world::TickView& tick,
                       Walker& known);
    void enter(const world::WalkerState& walker, const world::TickView& tick);
    bool is_on_road(const Eigen::Vector3d& p, std::vector<std::uint32_t>& crossings) const;
    void add(Count& count, Place place) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    double step_;
    std::vector<world::Obstacle> obstacles_;
    world::BoxGrid obstacles_by_place_;
    std::map<std::uint32_t, Walker> walkers_;
    std::map<std::uint32_t, std::uint64_t> green_at_;  ///< [signal] last tick
    std::uint64_t tick_ = 0;
};

}  // namespace reprise::test
