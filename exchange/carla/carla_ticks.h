#pragma once

#include <cstdint>
#include <memory>

#include "exchange/carla/carla_survey.h"
#include "world/tick.h"
#include "world/town_generated.h"

namespace reprise::exchange {

/// How frames become ticks.
struct CarlaTiming {
    std::uint64_t step_ns = 50'000'000;
    /// [m] that a walker of this height [m] covers in one walk cycle at this speed [m/s].
    double (*walk_cycle)(double speed, double height) = nullptr;
};

/// A log's frames, which come at odd times, as ticks of a fixed step: places on the straight line
/// between the frames before and after a tick, angles the short way round; an actor
/// that jumps (see `jumps`) stays at the old place until the later frame. Speeds are those
/// recorded, or else follow from the places.
class CarlaTicks {
  public:
    /// Begins with `log`'s first frame. All must outlive this; `offset` [m] takes CARLA's origin to
    /// the town's; `lights` [i] is the traffic light that town.signals[i] shows, 0: none.
    CarlaTicks(CarlaLog& log,
               const CarlaSurvey& survey,
               const world::TownT& town,
               std::vector<std::uint32_t> lights,
               const Eigen::Vector3d& offset,
               const CarlaTiming& timing);
    ~CarlaTicks();

    /// The next tick: its time is index * step after the first frame.
    world::TickDraft next();

    /// How often an actor went farther from one frame to the next than anything drives.
    std::uint64_t jumps() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace reprise::exchange
