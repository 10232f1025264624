#pragma once

#include <cstdint>
#include <span>

#include "drivers/control/ego.h"
#include "drivers/control/pedals.h"
#include "drivers/hazards.h"
#include "drivers/way/way.h"
#include "world/digest.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::drivers {

/// Decides at the end of every lane whether to enter the junction behind it.
///
/// MUST    stop at red; at yellow where that is comfortable; at a stop sign, whoever comes; give
/// way
///         where the link says so; leave the junction free when there is no room behind it, and
///         who has to stop leaves room for a bus that turns in beside him.
/// ASSUMES others accelerate no harder than 2 m/s^2 and hold their lane; lamps that are on tell
///         where a car turns.
/// GOES    through the gates ahead, nearest first, until one says stop.
/// KEEPS   what was decided at yellow, and how long we have waited: after 12 s it creeps on,
///         because several who all give way would wait for ever; after 8 s for room those who
///         stand at the other lines, their noses beside its way, count no longer; and after 45 s
///         before a row of junctions it asks no more than that the first be free.
class Gatekeeper {
  public:
    explicit Gatekeeper(const world::TownT& town);

    /// [m/s^2] infinity when nothing is in the way.
    double decide(const world::TickView& last,
                  const Ego& ego,
                  const Way& way,
                  std::span<const Overlap> overlaps,
                  const DrivingStyle& style,
                  double step);

    /// Drive as if every red or yellow light were green, and stop lines none.
    void ignore_lights(bool ignore) { ignores_lights_ = ignore; }

    void reset();
    void add_to(world::Hasher& hasher) const;

  private:
    bool must_stop(const world::TickView& last,
                   const Ego& ego,
                   const Way& way,
                   const Gate& gate,
                   std::span<const Overlap> overlaps,
                   const DrivingStyle& style,
                   double step);
    bool stops_at_yellow(const Gate& gate, double needed);
    bool must_halt(const Gate& gate, world::SignalColor color, const Ego& ego, double to_line);
    bool has_room(const world::TickView& last,
                  const Ego& ego,
                  const Way& way,
                  const Gate& gate,
                  std::span<const Overlap> overlaps,
                  double step);
    bool has_gap(const world::TickView& last,
                 const Ego& ego,
                 const Way& way,
                 const Gate& gate,
                 const DrivingStyle& style) const;

    const world::TownT* town_;
    std::uint32_t yellow_gate_ = world::none;  ///< serial of the gate that the next field is about
    bool yellow_stop_ = false;
    std::uint32_t waiting_gate_ = world::none;
    std::uint32_t waited_ticks_ = 0;
    std::uint32_t full_gate_ = world::none;  ///< where another junction, close behind, was not free
    std::uint32_t full_ticks_ = 0;
    std::uint32_t stopped_gate_ = world::none;  ///< where a stop sign was obeyed
    std::uint32_t creeping_gate_ = world::none;
    bool ignores_lights_ = false;
};

}  // namespace reprise::drivers
