#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "traffic/sight/footprints.h"
#include "world/digest.h"
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
    std::array<Eigen::Vector2d, 4>
        corners;       ///< of the body now: along the lane, left of its middle
    double speed = 0;  ///< [m/s] along the lane, 0 for what comes towards us
    double z = 0;
    bool lasts = false;  ///< stands or lies still, and is not somebody who waits to drive on
    double gap = 0;      ///< [m] that one who stops behind it leaves
    double spare =
        0;  ///< [m] on both sides, of what is left beside it, that one who creeps needs not
    bool drives = false;    ///< SUMO has a copy of it
    bool boxed_in = false;  ///< a car of SUMO's
    std::uint32_t id = 0;

    /// [m] along the lane where the body begins that lies between two lines along it, each left of
    /// the centre line; infinity where it does not reach between them. A body that stands askew
    /// begins there later than its foremost corner says. Who walks is taken for what he will take.
    double begin_between(double from, double to) const;
};

/// Everything that lies, stands, walks or drives on lanes for cars, lane by lane.
///
/// MUST    find all whose footprint touches a lane, or will within a walker's next second.
/// ASSUMES a lane is straight over the length of a footprint (see gather_footprints).
/// GOES    who was off every lane is not looked at again before he could be on one; the others are
///         seen from the direction of each lane around. About 1 us a look.
///         Lanes around a place are looked for once for all that is a step away.
/// KEEPS   since when each vehicle with mass has stood: after a while it is taken for one that will
///         not drive on.
class Obstructions {
  public:
    /// Both must outlive this. `step` [s] of a tick.
    Obstructions(const world::TownT& town, const world::LaneMap& lanes, double step)
        : town_(&town),
          lanes_(&lanes),
          step_(step),
          is_obstructed_(town.lanes.size()) {}

    /// As the last tick has them, and `cars`, which SUMO does not drive.
    void look(const world::TickView& last, std::span<const Car> cars);

    /// What was looked at: everything that SUMO does not know, on lanes or beside them.
    std::span<const Footprint> footprints() const { return footprints_; }

    bool empty() const { return all_.empty(); }

    /// Does any of them begin within `reach` of there? Costs nothing beside a look at their lanes.
    bool any_near(const Eigen::Vector2d& p_world, double reach) const;

    /// By lane, then along it.
    std::span<const Obstruction> all() const { return all_; }

    /// Those of one lane, along it. O(log n); where there is none, O(1).
    std::span<const Obstruction> on(std::uint32_t lane) const;

    bool any_on(std::uint32_t lane) const { return is_obstructed_[lane]; }

    /// Nothing where nobody has stood for long.
    void add_to(world::Hasher& hasher) const;

  private:
    /// Somebody off every lane, and how far he may go before he could be on one.
    struct Off {
        std::uint32_t id = 0;
        Eigen::Vector2d place;
        Eigen::Vector2d tip;  ///< of his next second's way
        double clear = 0;     ///< [m]
    };

    /// A vehicle with mass that stands, and for how long.
    struct Halt {
        std::uint32_t id = 0;
        std::uint32_t ticks = 0;
    };

    /// A lane for cars, and how far its centre line is from where it was looked for.
    struct Beside {
        std::uint32_t lane = 0;
        double distance = 0;  ///< [m]
    };

    /// Lanes for cars, as they were found around a place.
    struct Around {
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        double reach = -1;  ///< [m] each side of it
        std::vector<Beside> lanes;
    };

    const Around& lanes_around(const Eigen::Vector3d& place, std::uint32_t id, double reach);
    void count_halts(std::span<const world::VehicleState> vehicles);
    void add_needed_road(std::span<const Car> cars);
    double stood(std::uint32_t id) const;
    double gap_behind(const Footprint& footprint, bool lasts) const;
    void add(const Footprint& footprint);
    const Off* still_off(const Footprint& footprint, const Eigen::Vector2d& tip) const;

    const world::TownT* town_;
    const world::LaneMap* lanes_;
    double step_;              ///< [s]
    std::vector<Halt> halts_;  ///< sorted by id
    std::vector<Footprint> footprints_;
    std::vector<Obstruction> all_;
    std::vector<bool> is_obstructed_;      ///< [lane] is any of them on it?
    std::vector<Eigen::Vector2d> places_;  ///< of the footprints on lanes, by x
    std::vector<Off> off_;                 ///< sorted by id; decides nothing but the cost
    std::vector<Off> next_off_;
    std::array<Around, 256> around_;  ///< [id % size] likewise
};

}  // namespace reprise::traffic
