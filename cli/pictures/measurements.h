#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "cli/options/render_options.h"
#include "cli/pictures/cameras.h"
#include "cli/pictures/written_files.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// The sensors of a vehicle that are no cameras, and when each of them looks.
class Measurements {
  public:
    /// Of the recorded rig, of a rig file, or as options name them. Throws world::Error.
    Measurements(const RenderOptions& options, replay::TraceReader& trace, const Ticks& ticks);

    bool empty() const { return rig_.sensors.empty(); }

    /// For people.
    std::string names() const;

    /// Goes through the ticks and writes what they measured. `sensors` is asked for when rays are
    /// needed. Returns how many frames and readings there are.
    std::size_t write(const std::function<render::Sensors&()>& sensors, WrittenFiles& written);

    const world::SensorRig& sensors() const { return rig_.sensors; }

  private:
    void look_up_rig();
    std::optional<std::uint32_t> carrier(std::size_t sensor, const world::TickView& tick) const;

    /// Of those that are there, by their sensors' index in the rig.
    std::map<std::size_t, std::uint32_t> carriers(const world::TickView& tick) const;

    const RenderOptions& options_;
    replay::TraceReader& trace_;
    Ticks ticks_;
    world::Rig rig_;
    std::vector<std::optional<std::uint32_t>> carrier_ids_;  ///< of a rig file's; else empty
    std::optional<std::uint32_t> named_;
};

}  // namespace reprise::cli
