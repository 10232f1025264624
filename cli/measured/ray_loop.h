#pragma once

#include <cstddef>
#include <cstdint>

#include "cli/measured/measured_rig.h"
#include "cli/pictures/chosen_weather.h"
#include "render/sensors.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// Where frames go of sensors that measure by rays.
class RayOutput {
  public:
    RayOutput() = default;
    virtual ~RayOutput() = default;
    RayOutput(const RayOutput&) = delete;
    RayOutput& operator=(const RayOutput&) = delete;

    /// Whether it is asked what this sensor measured in that tick.
    virtual bool wants(std::size_t /*sensor*/, std::uint64_t /*tick*/) const { return true; }

    /// From any thread. `placed`: the sensor, and who carries it in this tick.
    virtual void take(std::size_t sensor,
                      const world::TickView& tick,
                      const world::SensorSpec& placed,
                      world::SensorFrame frame) = 0;
};

/// Looks by rays at all ticks in which a sensor is due, several at a time.
void look_by_rays(const MeasuredRig& rig,
                  replay::TraceReader& trace,
                  const Ticks& ticks,
                  const ChosenWeather& weather,
                  render::Sensors& sensors,
                  RayOutput& output);

}  // namespace reprise::cli
