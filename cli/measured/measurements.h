#pragma once

#include <cstddef>
#include <functional>

#include "cli/measured/measured_rig.h"
#include "cli/options/render_options.h"
#include "cli/pictures/written_files.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// What the sensors of a vehicle that are no cameras measured, on its way into files.
class Measurements {
  public:
    /// Of the recorded rig, of a rig file, or as options name them. Throws world::Error.
    Measurements(const RenderOptions& options, replay::TraceReader& trace, const Ticks& ticks);

    bool empty() const { return rig_.sensors().empty(); }

    /// For people.
    std::string names() const { return rig_.names(); }

    /// Goes through the ticks and writes what they measured. `sensors` is asked for when rays are
    /// needed. Returns how many frames and readings there are.
    std::size_t write(const std::function<render::Sensors&()>& sensors, WrittenFiles& written);

    const world::SensorRig& sensors() const { return rig_.sensors(); }

    /// Whose frame its place is in, for people: "ego", "world".
    std::string carrier(std::size_t sensor) const { return rig_.mounted_on(sensor); }

  private:
    const RenderOptions& options_;
    replay::TraceReader& trace_;
    Ticks ticks_;
    MeasuredRig rig_;
};

}  // namespace reprise::cli
