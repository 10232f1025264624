#pragma once

#include <cstdint>
#include <vector>

#include "traffic/cars/cars.h"
#include "world/town.h"

namespace reprise::traffic {

/// How fast cars take bends. SUMO drives every lane as fast as its sign allows, however narrow its
/// curve; here nobody is pushed sideways by more than a driver likes. Lanes through junctions and
/// short ones are slowed as a whole, once, in SUMO, which brakes for the lanes ahead; the sign
/// (Lane.speed_limit) stays. On longer lanes the cars are told before each bend.
class Bends {
  public:
    /// SUMO must run. `town` must outlive this.
    explicit Bends(const world::TownT& town);

    /// Before SUMO's step.
    void follow(Cars& cars) const;

  private:
    /// A stretch of a lane, in SUMO's measure of it.
    struct Bend {
        double from = 0;   ///< [m]
        double to = 0;     ///< [m]
        double speed = 0;  ///< [m/s]
    };

    double add_lane(const world::LaneT& lane,
                    const std::vector<Eigen::Vector2d>& before,
                    const std::vector<Eigen::Vector2d>& behind);
    void slow_before_bends(const world::LaneT& lane, double limit) const;
    void keep_slow_behind(const world::LaneT& lane, double limit);
    double limit_at(const Car& car) const;

    const world::TownT* town_;
    std::vector<std::vector<Bend>> bends_;  ///< [lane], along it; empty: as fast as the sign says
};

}  // namespace reprise::traffic
