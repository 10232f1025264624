#pragma once

#include <cstdint>

#include "traffic/cars/cars.h"
#include "traffic/orders.h"
#include "traffic/roads/right_of_way.h"
#include "traffic/roads/road_graph.h"
#include "traffic/sight/giving_way.h"
#include "traffic/sight/meetings.h"
#include "traffic/sight/obstructions.h"
#include "traffic/sight/passing.h"
#include "traffic/sight/pulling_out.h"
#include "traffic/sight/stand_ins.h"
#include "traffic/sight/sweeping.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// SUMO's cars look where they drive: they brake for what SUMO does not know, and for bodies that
/// SUMO takes for lines.
///
/// MUST    stop before everything that is in the way of a car's body, as well as its brakes allow;
///         change nothing where nothing is in the way.
/// ASSUMES that a car follows its lane, comes back to its middle within a few metres, and changes
///         lanes as slowly as SUMO moves it aside.
/// GOES    from the lane of each car along the lanes of its route, as far as it needs to stop; of
///         what is there each allows a speed (Krauss: to stop behind it with a second's reaction),
///         and the least is told to SUMO when it is less than the car would drive.
/// KEEPS   with each car, whether it is held back.
class Lookout {
  public:
    /// All of them must outlive this.
    Lookout(const world::EpisodeT& episode,
            const world::TownT& town,
            const world::LaneMap& lanes,
            const RoadGraph& graph,
            const RightOfWay& right_of_way,
            const Orders& orders)
        : town_(&town),
          graph_(&graph),
          orders_(&orders),
          step_(world::seconds(1, episode.step_ns)),
          obstructions_(town, lanes, step_),
          stand_ins_(town, graph, step_),
          passing_(town, obstructions_, step_),
          pulling_out_(town, graph, obstructions_, step_),
          meetings_(town, graph, right_of_way, step_),
          sweeping_(obstructions_, meetings_.lines(), graph, step_),
          giving_way_(meetings_.lines(), graph, step_) {}

    Lookout(const Lookout&) = delete;
    Lookout& operator=(const Lookout&) = delete;

    /// At what is there, as of the last tick, and `cars`: first.
    void look(const world::TickView& last, const Cars& cars);

    const Obstructions& obstructions() const { return obstructions_; }

    /// Before SUMO's step, behind the orders.
    void advance(const world::TickView& last, Cars& cars, std::uint64_t tick);

    /// Behind all of that, also while SUMO makes its step, in another thread: who meets whom from
    /// where they are now, for the ticks to come.
    void meet(Cars& cars, std::uint64_t tick) {
        if (Meetings::looks_in(tick))
            meetings_.look(cars, tick);
    }

    /// Behind SUMO's step: what can be told of the next tick already. Changes nothing that can be
    /// asked here, as Meetings::look_ahead.
    void look_ahead(const Cars& cars, std::uint64_t tick) {
        if (Meetings::looks_in(tick))
            meetings_.look_ahead(cars.all(), tick);
    }

    /// Beside what the cars keep; nothing where nothing is in the way.
    void add_to(world::Hasher& hasher) const {
        obstructions_.add_to(hasher);
        stand_ins_.add_to(hasher);
        meetings_.add_to(hasher);
    }

  private:
    struct Corridor;

    double allowed_speed(const Car& car, const Cars& cars) const;
    void look_at_cars(const Cars& cars, double s, const Car& car, Corridor& corridor) const;
    template <typename Visit>
    void visit_way(
        std::uint32_t lane, double start, double reach, const Car& car, const Visit& visit) const;
    bool is_clear(const Car& car, double reach) const;
    void follow_lane_change(const Car& car, Corridor& corridor) const;
    void look_on(std::uint32_t lane, double start, double aside, Corridor& corridor) const;
    void hold_back(Car& car, double speed, std::uint64_t tick) const;

    const world::TownT* town_;
    const RoadGraph* graph_;
    const Orders* orders_;
    double step_;  ///< [s]
    Obstructions obstructions_;
    StandIns stand_ins_;
    Passing passing_;
    PullingOut pulling_out_;
    Meetings meetings_;
    Sweeping sweeping_;
    GivingWay giving_way_;
};

}  // namespace reprise::traffic
