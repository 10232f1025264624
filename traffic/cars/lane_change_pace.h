#pragma once

#include <cstdint>
#include <vector>

#include "traffic/cars/cars.h"
#include "world/town.h"

namespace reprise::traffic {

/// How fast cars change lanes: no faster than they can steer. SUMO's change takes its time whether
/// the car drives or not; here one that stands in a queue in the middle of a change stands, in SUMO
/// as well, so that SUMO's others see it where it is shown.
class LaneChangePace {
  public:
    /// `town` must outlive this.
    explicit LaneChangePace(const world::TownT& town);

    /// Before SUMO's step. O(cars on roads with several lanes x cars that wait).
    void follow(Cars& cars, std::uint64_t tick) const;

    /// [m/s] sideways of one that is free to choose: a lane in three seconds.
    static constexpr double usual = 1.1;

  private:
    /// A car that stands or crawls.
    struct Waiting {
        std::uint32_t lane = 0;
        double lane_position = 0;  ///< [m] as Car's
        double length = 0;
    };

    static std::vector<Waiting> waiting(const Cars& cars);
    bool has_way(const Car& car, const std::vector<Waiting>& waiting) const;

    const world::TownT* town_;
    std::vector<bool> has_neighbour_;  ///< [lane]
};

}  // namespace reprise::traffic
