#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "cli/options/render_options.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/written_files.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// The sensors of a vehicle that are no cameras, and when each of them looks.
class Measurements {
  public:
    /// Of the recorded rig, or as options name them. Throws world::Error.
    Measurements(const RenderOptions& options, replay::TraceReader& trace, const Ticks& ticks);

    bool empty() const { return rig_.sensors.empty(); }

    /// For people.
    std::string names() const;

    /// Goes through the ticks and writes what they measured. `sensors` is asked for when rays are
    /// needed. Returns how many frames and readings there are.
    std::size_t write(const std::function<render::Sensors&()>& sensors, WrittenFiles& written);

    const world::SensorRig& sensors() const { return rig_.sensors; }

  private:
    std::optional<std::uint32_t> carrier(const world::TickView& tick) const;

    const RenderOptions& options_;
    replay::TraceReader& trace_;
    Ticks ticks_;
    world::Rig rig_;
    std::optional<std::uint32_t> named_;
};

}  // namespace reprise::cli
