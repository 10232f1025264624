#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "render/views/clear_sight.h"
#include "render/views/track.h"
#include "world/external/sensor.h"

namespace reprise::render {

enum class Preset : std::uint8_t {
    chase,   ///< behind and above, turning gently with the actor
    top,     ///< straight above, looking down
    driver,  ///< from the actor's eye
    orbit    ///< around the actor, once in 24 s
};

/// How a preset is wished.
struct PresetWish {
    Preset preset = Preset::chase;
    std::optional<double> fov{};       ///< [rad] horizontal; none: the preset's own
    std::optional<double> distance{};  ///< [m] from the actor; none: the preset's own
    bool heading_up = false;           ///< top: the actor's heading is up in the picture, not north
};

/// A camera that follows an actor. What it sees at a tick depends on the actor's whole track, and
/// on nothing that was rendered before.
class PresetCamera {
  public:
    /// Looks at `town` here only.
    PresetCamera(const PresetWish& wish, Track track, const world::TownT& town);

    const Track& track() const { return track_.track(); }

    /// A camera of size, kind and name of `sensor`, put in its place for this tick: in the world,
    /// at the wheel on the actor.
    world::SensorSpec at(std::uint64_t tick, world::SensorSpec sensor) const;

  private:
    /// From where to where.
    struct Look {
        Eigen::Vector3d from;
        Eigen::Vector3d to;
    };

    Look chase(const Heading& heading, double share) const;
    Look orbit(const Heading& heading, std::uint64_t tick, double share) const;
    Look look(std::uint64_t tick, double share) const;

    Eigen::Vector3d focus(const Heading& heading) const;

    /// How near the camera is taken to the actor, so that it sees it: changes gently.
    double gentle_share(std::uint64_t tick) const;
    double clear_share(std::size_t index) const;

    PresetWish wish_;
    SmoothTrack track_;
    std::optional<ClearSight> sight_;           ///< where the preset needs it
    mutable std::vector<double> clear_shares_;  ///< of each index of the track; negative: not known
};

}  // namespace reprise::render
