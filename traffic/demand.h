#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "traffic/cars/cars.h"
#include "traffic/insertion.h"
#include "traffic/insertion_points.h"
#include "traffic/roads/right_of_way.h"
#include "traffic/roads/road_graph.h"
#include "world/digest.h"
#include "world/episode_generated.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// As many background cars as the episode asks for: new ones for those that leave at a dead end or
/// have stood for minutes where no physics vehicle sees them, or not from near. Wrecks see nobody.
class Demand {
  public:
    /// All of them must outlive this.
    Demand(const world::EpisodeT& episode,
           const world::TownT& town,
           const RoadGraph& graph,
           const RightOfWay& right_of_way,
           const InsertionPoints& points,
           const Insertion& insertion);

    /// Takes out the cars that leave.
    void remove_leaving(Cars& cars, const world::TickView& last, world::TickDraft& next);

    /// Fills up the number. Says so in an event when in the first tick there is no room for all.
    void fill_up(Cars& cars, const world::TickView& last, world::TickDraft& next);

    void add_to(world::Hasher& hasher) const;

  private:
    void hear_of_wrecks(const world::TickView& last);
    bool is_seen(const Eigen::Vector3d& p, const world::TickView& last, double sight) const;

    /// For so long that it counts for more than who sees it go.
    bool is_stuck(const Car& car, const Cars& cars, const world::TickView& last) const;

    /// Does it wait for one who waits for another one, and so on, and one of them for it? Of such a
    /// ring who has stood there the longest is taken out whoever sees it: the others are free then.
    bool is_longest_in_a_ring(const Car& car, const Cars& cars) const;

    bool add_car(Cars& cars,
                 std::span<const OccupiedBox> occupied,
                 double& scanned,
                 world::TickDraft& next);

    const world::EpisodeT* episode_;
    const world::TownT* town_;
    const RoadGraph* graph_;
    const RightOfWay* right_of_way_;
    const InsertionPoints* points_;
    const Insertion* insertion_;
    double step_;              ///< [s]
    world::ClassSet at_home_;  ///< classes that most roads are open to
    std::uint32_t next_id_ = world::first_background_id;
    std::uint64_t draws_ = 0;            ///< of insertion points so far
    std::vector<std::uint32_t> wrecks_;  ///< ids, sorted: nobody looks out of them
};

}  // namespace reprise::traffic
