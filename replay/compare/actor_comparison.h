#pragma once

#include <cstdint>
#include <optional>

#include "replay/compare/divergence.h"

namespace reprise::replay {

/// What a tick says of one actor, as a tick of its own: without digests, weather, signals and
/// everybody else. Its n-th event is the n-th of this actor.
class ActorTick {
  public:
    ActorTick(const RecordedTick& tick, std::uint32_t actor);

    /// Borrowed from this.
    RecordedTick view() const;

  private:
    world::SealedTick sealed_;
    bool has_traffic_;
};

/// The first difference of two traces in what is recorded of one actor; of reals by more than is
/// tolerated. How the runs end counts only where the actor is in one of them for longer. Reads both
/// traces up to there, about 20 us a tick behind the first difference of anybody.
std::optional<Divergence> compare(TraceReader& expected,
                                  TraceReader& found,
                                  std::uint32_t actor,
                                  Tolerance* tolerance = nullptr);

}  // namespace reprise::replay
