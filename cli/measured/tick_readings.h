#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exchange/geo_origin.h"
#include "world/external/point_fields.h"
#include "world/tick.h"
#include "world/town.h"

namespace reprise::cli {

/// What sensors without rays read at a tick, of a trace or while a run goes on.
class TickReadings {
  public:
    /// `network`: the town's, for who asks where that lies; `town` must outlive this.
    TickReadings(const world::TownT& town, const std::string& network)
        : town_(town),
          origin_(exchange::GeoOrigin::of(network)) {}

    /// `last`: the tick before, null where there is none. `due`: by the sensor's period, which what
    /// happens does not wait for. Throws world::Error when its actor is not there.
    std::vector<world::Reading> read(const world::TickView* last,
                                     const world::TickView& tick,
                                     const world::SensorSpec& spec,
                                     bool due = true);

  private:
    world::Reading gnss(const world::TickView& tick, const world::SensorSpec& spec) const;

    const world::TownT& town_;
    std::optional<exchange::GeoOrigin> origin_;
    std::optional<world::LaneMap> lanes_;  ///< made when it is first asked for
};

}  // namespace reprise::cli
