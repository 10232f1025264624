#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "world/lanes/route_progress.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::kernel {

/// Stage 6. How far each vehicle with mass has to go along the way that it was told last, from its
/// front bumper: 0 from where it arrives, -1 without a goal. Planned from where the scenario saw it
/// when it said so, as `ego:route_completion()` and `reprise score` plan it; who has left its way
/// has as far to go as where it left it. Depends on ticks and commands alone.
class Goals {
  public:
    /// `town` must outlive this.
    explicit Goals(const world::TownT& town) : town_(&town) {}

    /// After measure().
    void note(const world::TickView& last, world::TickDraft& next);

  private:
    struct Sent {
        std::optional<world::RouteProgress> progress;
        double length = 0;  ///< [m] of the way
        bool keeps_lane = false;
    };

    void hear(const world::CommandT& command,
              const world::TickView& last,
              const world::TickDraft& next);
    std::optional<world::LanePlace> place_of(const world::Measurement* measured) const;

    const world::TownT* town_;
    std::map<std::uint32_t, Sent> sent_;
};

}  // namespace reprise::kernel
