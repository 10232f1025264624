#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "traffic/cars/car.h"
#include "traffic/roads/lane_lines.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/way_ahead.h"
#include "world/geometry2d.h"
#include "world/tick.h"

namespace reprise::traffic {

/// Whose way through a junction a vehicle with mass comes to. SUMO knows of such a one only where
/// it is: of two in a junction it lets go who came in first, and who is put there never did.
///
/// MUST    let no slow car drive before a vehicle with mass that comes, where it can still stop.
/// ASSUMES that the vehicle goes on as it moves and turns now, unless it brakes by itself; and that
///         who drives in the same direction follows, which is looked at elsewhere.
/// GOES    by the boxes of its next seconds: where the car's body would come into one of them,
///         before it is past and not well before it comes, the car stops. Who lies there already,
///         or cannot stop any more, drives on. Costs nothing while no such vehicle moves nearby.
class GivingWay {
  public:
    /// All must outlive this. `step` [s] of a tick.
    GivingWay(const LaneLines& lines, const RoadGraph& graph, double step)
        : lines_(&lines),
          graph_(&graph),
          step_(step) {}

    /// At the vehicles as of the last tick: before anything is asked.
    void look(const world::TickView& last);

    /// [m/s] in the next tick; infinite where nobody comes.
    double allowed_speed(const Car& car) const;

  private:
    static constexpr std::size_t moments = 31;
    static constexpr double moment = 0.13;  ///< [s] between two of them
    static constexpr std::size_t in_stretch = 8;
    static constexpr std::size_t stretches = (moments + in_stretch - 1) / in_stretch;

    /// One that comes, and where its body will be.
    struct Comer {
        std::array<BodyBox, moments> bodies;
        std::array<world::Box, stretches> areas;  ///< around each eight of them,
        world::Box area;                          ///< and around all
        double z = 0;
        double speed = 0;    ///< [m/s]
        double braking = 0;  ///< [m/s^2] that it does now
    };

    /// Where a car's body would be in a comer's way.
    struct Conflict {
        double begin = 0;  ///< [m] that the car drives until then,
        double end = 0;    ///< and until it is past
        double comes = 0;  ///< [s] until the comer is there,
        double goes = 0;   ///< and until it is past
        bool is_any = false;
    };

    static Comer comer_of(const world::VehicleState& vehicle);
    static Conflict conflict_of(const WayAhead& way, const Comer& comer);
    bool has_to_wait(const Car& car, const Comer& comer, const Conflict& conflict) const;
    bool is_in_junction(const Car& car, const WayAhead& way) const;

    const LaneLines* lines_;
    const RoadGraph* graph_;
    double step_;  ///< [s]
    std::vector<Comer> comers_;
};

}  // namespace reprise::traffic
