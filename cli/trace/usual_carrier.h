#pragma once

#include <cstdint>
#include <optional>

#include "world/episode_generated.h"
#include "world/tick.h"

namespace reprise::cli {

/// Who carries sensors, or is followed, where nobody says so: the first vehicle with mass; of an
/// imported trace, which has cars only, the one that it was recorded for.
class UsualCarrier {
  public:
    explicit UsualCarrier(const world::EpisodeT& episode);

    /// None: nobody of the kind is there.
    std::optional<std::uint32_t> in(const world::TickView& tick) const;

  private:
    bool imported_;
    std::optional<std::uint32_t> hero_;  ///< of an imported trace
};

}  // namespace reprise::cli
