#pragma once

#include "traffic/cars/cars.h"
#include "traffic/insertion.h"
#include "traffic/insertion_points.h"
#include "traffic/placements.h"
#include "traffic/roads/road_graph.h"
#include "world/episode_generated.h"
#include "world/models/catalogue.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// Cars that a scenario spawns and traffic owns: driven by SUMO, or parked.
class ScriptedSpawns {
  public:
    /// All of them must outlive this.
    ScriptedSpawns(const world::EpisodeT& episode,
                   const world::TownT& town,
                   const RoadGraph& graph,
                   const InsertionPoints& points,
                   const Insertion& insertion,
                   const Placements& placements)
        : episode_(&episode),
          town_(&town),
          graph_(&graph),
          points_(&points),
          insertion_(&insertion),
          placements_(&placements) {}

    /// Carries out a spawn command; background cars that stand there are taken out. Throws
    /// world::Error, with the script's line, where the car cannot stand.
    void spawn(const world::CommandT& command,
               Cars& cars,
               const world::TickView& last,
               world::TickDraft& next) const;

    /// For a vehicle with mass, which a command spawns on a lane: takes out background cars that
    /// stand there.
    void make_room_for(const world::CommandT& command, Cars& cars, world::TickDraft& next) const;

  private:
    InsertionPoint point_of(const world::CommandT& command,
                            const Cars& cars,
                            const world::TickView& last,
                            const world::TickDraft& next) const;
    bool is_on_road(std::uint32_t lane) const;
    void make_room(const InsertionPoint& point,
                   double car_length,
                   Cars& cars,
                   world::TickDraft& next) const;
    void spawn_at_pose(const world::CommandT& command,
                       Car car,
                       Cars& cars,
                       world::TickDraft& next) const;
    void make_room_at(const world::CommandT& command, Cars& cars, world::TickDraft& next) const;
    void park(Car& car, const InsertionPoint& point, double offset) const;

    const world::EpisodeT* episode_;
    const world::TownT* town_;
    const RoadGraph* graph_;
    const InsertionPoints* points_;
    const Insertion* insertion_;
    const Placements* placements_;
};

}  // namespace reprise::traffic
