#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "traffic/cars/car.h"
#include "traffic/roads/road_graph.h"
#include "traffic/roads/short_predecessors.h"
#include "world/digest.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// The physics vehicles as SUMO sees them: vehicles that it never drives, put where they will be at
/// the end of the coming step, so that its cars brake for them, follow them and yield to them.
/// Every vehicle is given the likeliest way ahead (by its indicators), because cars at a junction
/// look at the ways of those who approach it.
class Mirrors {
  public:
    /// `town`, `lanes` and `graph` must outlive this. `step` [s] of a tick.
    Mirrors(const world::TownT& town,
            const world::LaneMap& lanes,
            const RoadGraph& graph,
            double step);

    /// Brings SUMO's copies in line with the last tick: new ones, moved ones, gone ones. About 10
    /// us a vehicle on a road; 40 us in a junction or off the way that was expected. `cars` are
    /// those of traffic, sorted by id.
    /// `beside_sumo`, sorted by id: cars of traffic's that SUMO does not drive now. `wrecks`: ids
    /// of vehicles that were SUMO's cars in the last tick.
    void advance(const world::TickView& last,
                 std::span<const Car> cars,
                 std::span<const world::VehicleState> beside_sumo = {},
                 std::span<const std::uint32_t> wrecks = {});

    /// Edges that a vehicle with mass will likely drive along, the one that it is on first; empty
    /// off the road. As of the last advance.
    std::span<const std::uint32_t> way_of(std::uint32_t id) const;

    /// SUMO took this vehicle out of the simulation; it is put back at the next advance.
    void forget(const std::string& sumo);

    void add_to(world::Hasher& hasher) const;

  private:
    struct Mirror {
        std::uint32_t id = 0;
        std::string sumo;
        std::uint32_t edge = world::none;   ///< where SUMO has it; none: off every road
        std::uint32_t after = world::none;  ///< inside a junction: the edge behind it
        std::uint16_t lamps = 0;
        std::vector<std::uint32_t> route;
    };

    struct Target {
        double x = 0;
        double y = 0;
        double angle_deg = 0;
        std::uint32_t lane = world::none;
        double lane_position = 0;  ///< [m] in SUMO's measure
        bool on_lane = false;      ///< else SUMO has it off the road
    };

    Mirror& find_or_add(const world::VehicleState& vehicle,
                        const std::string& sumo,
                        const Target& target);
    Target target_of(const world::VehicleState& vehicle) const;
    void set_route(const Mirror& mirror, const std::vector<std::uint32_t>& way);
    void move(Mirror& mirror, const world::VehicleState& vehicle, const Target& target);
    bool start_where_sumo_has_it(const Mirror& mirror, std::vector<std::uint32_t>& way) const;
    std::uint32_t lane_named(const std::string& name) const;
    void bring_back(const Mirror& mirror, const Target& target) const;
    bool lists_go_stale(const std::string& lane,
                        const Mirror& mirror,
                        const world::VehicleState& vehicle,
                        const Target& target) const;
    void enter_again(const Mirror& mirror,
                     const world::VehicleState& vehicle,
                     const Target& target) const;
    void keep_order(const Mirror& mirror, const Target& target, std::span<const Car> cars) const;
    std::vector<std::uint32_t> likely_way(std::uint32_t lane, std::uint16_t lamps) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    const RoadGraph* graph_;
    double step_;
    std::map<std::string, ShortPredecessors> short_predecessors_;  ///< by SUMO's name of the lane
    std::vector<Mirror> mirrors_;                                  ///< sorted by id
    std::uint32_t added_ = 0;  ///< names of routes are never used again
};

}  // namespace reprise::traffic
