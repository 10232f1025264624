#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "drivers/way/lane_graph.h"
#include "world/digest.h"

namespace reprise::drivers {

/// Where a driver is told to go: stops, and the lanes to the next ones as far as they are planned.
/// A plan may be dropped at any time; the stops make a new one. A stop is entered by the path long
/// before the car passes it; only then it is forgotten.
class Itinerary {
  public:
    /// Changes of lanes that are due on one street.
    struct Changes {
        int count = 0;
        std::optional<world::LanePlace> goal;  ///< the last stop, where they end on its lane
    };

    /// Looks into `graph`, which must outlive this.
    explicit Itinerary(const LaneGraph& graph) : graph_(&graph) {}

    /// Lanes to pass in this order, the last one at `last_s` [m].
    void set_stops(std::vector<std::uint32_t> stops, double last_s);

    /// Plans without changes of lanes from now on, or with them again. `lanes` of a restart may
    /// hold some.
    void keep_lane(bool keep);

    bool keeps_lane() const { return changes_ == world::LaneChanges::forbidden; }

    /// Is the next lane one of those that the restart was given?
    bool next_is_given() const { return given_ > 0; }

    /// Starts anew on a lane; `lanes` are the next ones, whatever the stops want.
    void restart(std::uint32_t lane, std::span<const std::uint32_t> lanes);

    /// The lane to go to next from `here`, a link or a neighbour ahead; planned if it is not yet.
    /// None: there is no stop to come, or it cannot be reached, then it is given up.
    std::optional<std::uint32_t> next(world::LanePlace here);

    /// The path is on this lane now.
    void enter(std::uint32_t lane);

    /// The car is on this lane now.
    void pass(std::uint32_t lane);

    void drop_plan();

    /// Drops the plan and takes the link of `lane` from where the stops are reached soonest; none:
    /// there is no stop to come, or it is given up.
    std::optional<std::uint32_t> go_another_way(std::uint32_t lane);

    /// What is planned from this lane on.
    Changes changes_on(std::uint32_t lane) const;

    /// [m] the last stop on this lane; none: it lies elsewhere, or there is a lane to go to before.
    std::optional<double> goal_on(std::uint32_t lane) const;

    const std::deque<std::uint32_t>& lanes() const { return lanes_; }

    /// Not passed by the car.
    std::span<const std::uint32_t> stops() const { return stops_; }

    /// [m] of the last stop.
    double last_s() const { return last_s_; }

    void add_to(world::Hasher& hasher) const;

  private:
    std::span<const std::uint32_t> to_come() const { return std::span(stops_).subspan(entered_); }

    void give_up();

    const LaneGraph* graph_;
    std::deque<std::uint32_t> lanes_;   ///< the plan, from the end of the path on
    std::vector<std::uint32_t> stops_;  ///< not passed by the car
    std::size_t entered_ = 0;           ///< of these, by the path
    double last_s_ = 0;
    std::size_t given_ = 0;  ///< of `lanes_`, the first ones: by the restart
    world::LaneChanges changes_ = world::LaneChanges::allowed;
};

}  // namespace reprise::drivers
