#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "traffic/footprints.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::traffic {

/// What takes room of a lane, seen along it. [m]
struct Obstruction {
    std::uint32_t lane = world::none;
    double begin = 0;  ///< along the lane
    double end = 0;
    double right = 0;  ///< left of the centre line: from here, with what is to be left beside it,
    double left = 0;   ///< to here
    double speed = 0;  ///< [m/s] along the lane, 0 for what comes towards us
    double z = 0;
    bool lasts = false;  ///< stands or lies still, and is not somebody who waits to drive on
    double gap = 0;      ///< [m] that one who stops behind it leaves
    std::uint32_t id = 0;
};

/// Everything that lies, stands, walks or drives on lanes for cars, lane by lane.
///
/// MUST    find all whose footprint touches a lane, or will within a walker's next second.
/// ASSUMES a lane is straight over the length of a footprint (see gather_footprints).
/// GOES    the grid of lanes culls nearly all who are on sidewalks; what is left is seen from the
///         lane's direction there. About 1 us a footprint.
/// KEEPS   nothing from tick to tick but its buffers.
class Obstructions {
  public:
    /// Both must outlive this.
    Obstructions(const world::TownT& town, const world::LaneMap& lanes)
        : town_(&town),
          lanes_(&lanes) {}

    /// As the last tick has them, and `cars`, which SUMO does not drive.
    void look(const world::TickView& last, std::span<const Car> cars);

    bool empty() const { return all_.empty(); }

    /// By lane, then along it.
    std::span<const Obstruction> all() const { return all_; }

    /// Those of one lane, along it. O(log n).
    std::span<const Obstruction> on(std::uint32_t lane) const;

  private:
    void add(const Footprint& footprint);

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    std::vector<Footprint> footprints_;
    std::vector<Obstruction> all_;
};

}  // namespace reprise::traffic
