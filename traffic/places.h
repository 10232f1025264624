#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "traffic/road_graph.h"
#include "world/models/vehicle_classes.h"
#include "world/random.h"
#include "world/town.h"

namespace reprise::traffic {

/// A place for a car's front bumper.
struct Place {
    std::uint32_t lane = world::none;
    double s = 0;  ///< [m] along the lane
};

/// Ground that a car stands on.
struct Taken {
    Eigen::Vector2d centre;
    double yaw = 0;
    double length = 0;
    bool seen_from = false;  ///< a physics vehicle: cars should not appear in front of its eyes
};

/// Finds room for new cars on the driving lanes, every metre as likely as the next.
class Places {
  public:
    Places(const world::TownT& town, const RoadGraph& graph);

    /// The place that this number in [0, 1) falls on, for a car of this length and class. None
    /// where the car does not fit between the ends of the lane or may not drive.
    std::optional<Place> at(double drawn, double car_length, world::ClassSet car) const;

    /// The classes that may use at least half of the driving lanes' length.
    world::ClassSet common_classes() const;

    /// Is there nothing within `margin` metres before and behind a car of this length there, and no
    /// eye within `sight`?
    bool is_free(const Place& place,
                 double car_length,
                 std::span<const Taken> taken,
                 double margin,
                 double sight) const;

    /// The ground that a car with its front there would take.
    Taken ground(const Place& place, double car_length) const;

  private:
    const world::TownT* town_;
    const RoadGraph* graph_;
    std::vector<std::uint32_t> lanes_;
    std::vector<double> ends_;  ///< [m] running sum of the lanes' lengths
};

}  // namespace reprise::traffic
