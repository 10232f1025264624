// Private to the room: what the frames of a CARLA log tell, as a trace's events.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "exchange/carla/carla_bodies.h"
#include "world/tick_generated.h"

namespace reprise::exchange {

/// The record's grid for lengths, see world/traffic.fbs.
inline constexpr double per_metre = 1024;

/// A place on that grid. [m]
world::Vec3 on_grid(const Eigen::Vector3d& p_world);

/// Gathers spawned, despawned and collision events. CARLA repeats a collision in every frame of a
/// contact; here it is one event until the two were apart for half a second. Its impulse is not
/// recorded: value is 0.
class CarlaEvents {
  public:
    /// Looks into `survey`. `offset` [m] takes CARLA's origin to the town's.
    CarlaEvents(const CarlaSurvey& survey, const Eigen::Vector3d& offset)
        : survey_(&survey),
          offset_(offset) {}

    /// `last`: where everybody was one frame before, sorted by id.
    void read(const CarlaFrame& frame, const std::vector<Body>& last);

    /// All since the last call, in the order of the log.
    std::vector<world::EventT> take() { return std::exchange(events_, {}); }

  private:
    void add_collision(const CarlaCollision& collision, const CarlaFrame& frame);
    void tell(world::EventKind kind,
              std::uint32_t actor,
              const Eigen::Vector3d& at,
              std::string text);

    const CarlaSurvey* survey_;
    Eigen::Vector3d offset_;
    std::vector<world::EventT> events_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, double>
        contacts_;  ///< [s] of the last packet that said so
};

}  // namespace reprise::exchange
