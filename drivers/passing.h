#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/control/ego.h"
#include "drivers/control/pedals.h"
#include "drivers/hazards.h"
#include "drivers/passing_plan.h"
#include "drivers/road_map.h"
#include "drivers/way/way.h"
#include "world/digest.h"
#include "world/tick.h"

namespace reprise::drivers {

/// Around what stands or crawls in the way, and back to the lane.
///
/// MUST    keep half a metre from things and cars, a metre from people and two-wheelers; take the
///         lanes of the other direction only where they are free until it is back; leave alone who
///         waits himself, or drives at all like a car.
/// ASSUMES that the others go on as they do; that those of the other direction may speed up to the
///         limit.
/// GOES    watches the first one ahead for as long as it takes to know that it stays there; plans a
///         line past it, and takes that when it is free; stops before it with room to turn out.
/// KEEPS   the line, whom it watches, and how long.
class Passing {
  public:
    /// `map` must outlive this. `step`: [s] of a tick.
    Passing(const RoadMap& map, double step) : map_(&map), step_(step) {}

    /// Goes on with the line, if there is one: comes back when those who were passed are behind, or
    /// when somebody comes and it is hardly out.
    void follow(const world::TickView& last,
                const Ego& ego,
                const Way& way,
                const DrivingStyle& style);

    /// Is the first of `overlaps` to be passed, and can it be? True: there is a line now. `beside`:
    /// the car's place, left of the path. [m]
    bool consider(const world::TickView& last,
                  const Ego& ego,
                  const Way& way,
                  std::span<const Overlap> overlaps,
                  double beside,
                  const DrivingStyle& style);

    /// [m/s^2] that the line allows, or the wish for room before what is to be passed.
    double acceleration(const Ego& ego, const DrivingStyle& style) const;

    const std::optional<PassingPlan>& plan() const { return plan_; }

    /// [m] to go back, to have the room to turn out; 0: none needed.
    double missing_room() const { return missing_room_; }

    /// A line past who stands ahead, through a lane that is free, but for want of room to turn out.
    const std::optional<PassingPlan>& cramped() const { return cramped_; }

    /// It got out of its gap some other way, and is on that line from here on.
    void begin_beside(double s);

    /// 1: to the left now, -1 to the right, 0: straight on. For the indicators.
    int side(const Ego& ego) const;

    void drop() { plan_.reset(); }

    /// The line led to where somebody stands: watch anew, then look for another one.
    void give_up() {
        plan_.reset();
        watched_ticks_ = 0;
    }

    /// The line leads from where the car is, `beside` metres left of the path, back to it.
    void come_back(const Ego& ego, double beside, const DrivingStyle& style);

    /// The path is counted from elsewhere.
    void shift(double distance);

    void add_to(world::Hasher& hasher) const;

  private:
    /// Does the line only lead back to the path?
    bool comes_back() const { return plan_ && plan_->row.empty(); }

    void watch(const Neighbour& one);
    double patience(const Neighbour& one, const PassingScene& scene) const;
    bool has_no_reason(const Neighbour& one, const PassingScene& scene) const;
    bool has_driven_on(const Ego& ego) const;

    const RoadMap* map_;
    double step_;
    std::optional<PassingPlan> plan_;
    std::uint32_t watched_ = 0;           ///< the first one ahead, that stands or crawls
    std::uint32_t watched_ticks_ = 0;     ///< for so long, looking the same
    bool watched_abandoned_ = false;      ///< it stands, and nobody seems to be at the wheel
    double stop_s_ = world::infinity;     ///< where to stop, to have room; follows from the tick
    double missing_room_ = 0;             ///< likewise
    std::optional<PassingPlan> cramped_;  ///< likewise; kept while it gets out
    std::vector<Neighbour> neighbours_;   ///< of this tick
};

}  // namespace reprise::drivers
