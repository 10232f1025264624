#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "traffic/cars/car.h"
#include "traffic/roads/road_graph.h"
#include "world/models/vehicle_classes.h"
#include "world/random.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Where a car's front bumper is put.
struct InsertionPoint {
    std::uint32_t lane = world::none;
    double s = 0;  ///< [m] along the lane
};

/// Ground that a vehicle stands on.
struct OccupiedBox {
    Eigen::Vector2d centre;
    double yaw = 0;
    double length = 0;
    bool is_observer = false;  ///< a physics vehicle: no car should appear in its sight
};

/// The box of a car that traffic owns.
OccupiedBox box_of(const Car& car);

/// What is wished of an insertion point, and the random draws that look for one.
struct InsertionSearch {
    double car_length = 0;    ///< [m]
    world::ClassSet car = 0;  ///< what it may drive on
    std::uint64_t seed = 0;
    std::uint64_t tick = 0;
    world::Purpose purpose = world::Purpose::demand_place;
    std::uint64_t item = 0;  ///< of the first draw; advanced
    int tries = 0;
    double margin = 0;  ///< [m] wished before and behind
    double sight = 0;   ///< [m] wished from every observer
    /// When no draw hits: look at every place, from `scanned` on. [m] of all lanes one behind the
    /// other; advanced, so that many cars one after the other look at each place once or twice.
    bool everywhere = false;
    double scanned = 0;
};

/// Finds room for new cars on the driving lanes, every metre as likely as the next.
class InsertionPoints {
  public:
    InsertionPoints(const world::TownT& town, const RoadGraph& graph);

    /// Draws points until one is free, at most `tries` times; the longer it takes, the less room is
    /// asked for. Then, if it is wished, tries every place.
    std::optional<InsertionPoint> find(std::span<const OccupiedBox> occupied,
                                       InsertionSearch& search) const;

    /// The classes that may use at least half of the driving lanes' length.
    world::ClassSet common_classes() const;

    /// Is there nothing within `margin` metres before and behind a car of this length there, and no
    /// observer within `sight`?
    bool is_free(const InsertionPoint& point,
                 double car_length,
                 std::span<const OccupiedBox> occupied,
                 double margin,
                 double sight) const;

    /// All that stands or is about to stand on the road: `cars`, the physics vehicles, walkers and
    /// props of the last tick, and those that a scenario spawns in this one.
    std::vector<OccupiedBox> occupied(std::span<const Car> cars,
                                      const world::TickView& last,
                                      const world::TickDraft& next) const;

  private:
    /// Where somebody or something comes in this very tick, with the way that a driver needs to see
    /// it and stop; nothing for commands that bring nobody.
    std::optional<OccupiedBox> coming(const world::CommandT& command) const;
    std::optional<InsertionPoint> scan(std::span<const OccupiedBox> occupied,
                                       InsertionSearch& search) const;
    std::optional<InsertionPoint> at(double drawn, double car_length, world::ClassSet car) const;
    OccupiedBox box_at(const InsertionPoint& point, double car_length) const;

    const world::TownT* town_;
    const RoadGraph* graph_;
    std::vector<std::uint32_t> lanes_;
    std::vector<double> ends_;  ///< [m] running sum of the lanes' lengths
};

}  // namespace reprise::traffic
