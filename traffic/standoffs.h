#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/roads/right_of_way.h"
#include "traffic/roads/road_graph.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Who waits at a junction for somebody who stands as well goes first in the end. By SUMO's rules
/// each waits for the one on his right, or for whom he sees in the junction, and for ever. And who
/// finds no gap among those who come is let in by them: to SUMO a gap must hold all of his way over
/// the junction, from a standstill, before the next one is at his line.
///
/// MUST    let one go on, of those who wait for each other.
/// ASSUMES that Lookout keeps him from driving into anybody.
/// GOES    once a second: of those who have stood at a junction for longer than anybody waits there
///         for a gap the longest, one in each place, is told not to mind those who stand near it;
///         the next one when that was of no use. Not at lights, before which one has to wait. Who
///         has stood there for longer yet pushes past those who come and can stop, too.
/// KEEPS   with each car, whether it was told, and past whom it pushes.
class Standoffs {
  public:
    /// All of them must outlive this. `step` [s] of a tick.
    Standoffs(const world::TownT& town,
              const RoadGraph& graph,
              const RightOfWay& right_of_way,
              double step)
        : town_(&town),
          graph_(&graph),
          right_of_way_(&right_of_way),
          step_(step) {}

    /// Who lets another one in stops at his line. Behind RescueLane and before Lookout.
    void hold(Cars& cars, std::uint64_t tick) const;

    /// Before SUMO's step.
    void advance(const world::TickView& last, Cars& cars, std::uint64_t tick) const;

    /// One who comes, `left` [m] before he would meet who goes that `way` through a junction. True:
    /// he stops before it from now on.
    static bool ask(Car& other, double left, std::uint32_t way, std::uint64_t tick);

    /// On its `way` through a junction past those who were asked in this tick, no longer past those
    /// asked before; and past whom it is pushing already because he stands in its way (meetings.h):
    /// half past him it would stop, its body in his.
    static void push_past(Car& car,
                          const std::vector<std::uint32_t>& asked,
                          std::uint32_t way,
                          const Cars& cars,
                          std::uint64_t tick);

  private:
    bool waits(const Car& car) const;
    bool is_through(const Car& car) const;
    bool is_ahead(const Car& other, const Car& car) const;
    std::string standing_near(const Car& car, const world::TickView& last, const Cars& cars) const;
    double way_to_meeting(const Car& other, std::uint32_t way) const;
    bool has_room_behind(const Car& car, std::uint32_t way, const Cars& cars) const;
    static bool somebody_comes(const Car& car, const world::TickView& last);
    void ask_to_let_in(Car& car, const world::TickView& last, Cars& cars, std::uint64_t tick) const;
    static void stop_pushing_past(const Car& inside, Cars& cars);

    const world::TownT* town_;
    const RoadGraph* graph_;
    const RightOfWay* right_of_way_;
    double step_;  ///< [s]
};

}  // namespace reprise::traffic
