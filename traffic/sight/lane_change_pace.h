#pragma once

#include <cstdint>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/sight/obstructions.h"
#include "world/town.h"

namespace reprise::traffic {

/// How fast cars change lanes: no faster than they can steer. SUMO's change takes its time whether
/// the car drives or not; here one that stands in a queue in the middle of a change stands, in SUMO
/// as well, so that SUMO's others see it where it is shown. And nobody begins a change whose way
/// leads over somebody or something that SUMO does not know, such as who stands on the line
/// between.
class LaneChangePace {
  public:
    /// `town` must outlive this.
    explicit LaneChangePace(const world::TownT& town);

    /// Before SUMO's step. O(cars on roads with several lanes x cars that wait).
    /// `obstructions` as of the last tick.
    void follow(Cars& cars, const Obstructions& obstructions, std::uint64_t tick) const;

    /// Is nobody and nothing in the way of a change that begins now? `obstructions` likewise.
    bool is_clear(const Car& car, const Obstructions& obstructions) const;

  private:
    /// A car that stands or crawls.
    struct Waiting {
        std::uint32_t lane = 0;
        double lane_position = 0;  ///< [m] as Car's
        double length = 0;
    };

    static std::vector<Waiting> waiting(const Cars& cars);
    double wanted_way(const Car& car) const;
    bool has_way(const Car& car, const std::vector<Waiting>& waiting) const;

    const world::TownT* town_;
    std::vector<bool> has_neighbour_;  ///< [lane]
};

}  // namespace reprise::traffic
