#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/render_options.h"
#include "cli/trace/usual_carrier.h"
#include "render/views/preset_camera.h"
#include "replay/trace_reader.h"
#include "world/external/rig.h"

namespace reprise::cli {

/// The ticks that are looked at.
struct Ticks {
    std::uint64_t from = 1;
    std::uint64_t to = 1;
    std::uint64_t every = 1;
};

/// Who looks, and from where: what a vehicle carried in the run, cameras mounted on it as the
/// options say, or a preset that follows it.
class Cameras {
  public:
    /// Looks for actor and rig in the trace. Throws world::Error.
    Cameras(const RenderOptions& options, replay::TraceReader& trace, const Ticks& ticks);

    /// Whether it is what somebody carried in the run, or a rig file's.
    bool has_folders() const { return recorded_.has_value() || sensors_.size() > 1; }

    /// As they are in all ticks but for their places.
    const world::SensorRig& sensors() const { return sensors_; }

    const std::optional<world::Rig>& recorded() const { return recorded_; }

    /// Those that look in a tick, by their index in sensors(): of a recorded rig where they looked
    /// in the run, unless every so many ticks were asked for.
    std::vector<std::size_t> due(std::uint64_t tick) const;

    /// Who carries them in this tick, or is followed; nobody before it is there, and behind its
    /// end nobody can carry anything.
    std::optional<std::uint32_t> actor(const world::TickView& tick) const;

    /// Whether one of them says how things move, and so needs the ticks beside its own.
    bool see_motion() const;

    /// Whether who carries it is there, for those of a rig file, which have carriers of their own.
    bool is_there(std::size_t sensor, const world::TickView& tick) const;

    /// Whose frame its place is in, for people: "ego", "world".
    std::string carrier(std::size_t sensor) const;

    /// One in its place.
    world::SensorSpec placed(std::size_t sensor,
                             std::uint32_t actor,
                             const world::TickView& tick) const;

  private:
    std::uint32_t followed(replay::TraceReader& trace, const Ticks& ticks) const;
    void read_rig(replay::TraceReader& trace);
    void follow(replay::TraceReader& trace, const Ticks& ticks);

    const RenderOptions& options_;
    std::optional<std::uint32_t> named_;
    UsualCarrier usual_;
    world::SensorRig sensors_;
    std::optional<world::Rig> recorded_;
    std::vector<std::string> carriers_;  ///< of a rig file's sensors, by name; else empty
    std::vector<std::optional<std::uint32_t>> carrier_ids_;  ///< none: as usual
    std::optional<render::PresetCamera> preset_;
    std::uint64_t preset_first_ = 0;  ///< the followed actor's first tick
    std::uint64_t preset_last_ = 0;
};

}  // namespace reprise::cli
