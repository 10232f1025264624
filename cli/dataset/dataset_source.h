#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/dataset/frame_list.h"
#include "cli/measured/measured_rig.h"
#include "cli/options/dataset_options.h"
#include "cli/pictures/cameras.h"
#include "replay/trace_reader.h"

namespace reprise::cli {

/// A trace that a data set is made of, and the sensors that look into it.
class DatasetSource {
  public:
    /// Throws world::Error.
    DatasetSource(const DatasetOptions& dataset, const std::string& path);

    /// Cameras refer to the options beside them.
    DatasetSource(const DatasetSource&) = delete;
    DatasetSource& operator=(const DatasetSource&) = delete;

    const std::string& path() const { return options_.trace; }

    /// A weather, and whether boxes are made of what is seen.
    RenderOptions& options() { return options_; }

    replay::TraceReader& trace() const { return *trace_; }

    const Ticks& ticks() const { return ticks_; }

    /// [ticks] from sweep to sweep; 0: there are none.
    std::uint64_t sweep() const { return sweep_; }

    const Cameras& cameras() const { return *cameras_; }

    /// What measures by rays; for nuScenes the first LiDAR has a semantic twin behind them.
    const MeasuredRig& rays() const { return *rays_; }

    /// Those of the rig.
    world::SensorRig own_rays() const;

    /// Who carries the sensors in a tick of a frame.
    std::uint32_t ego(const world::TickView& tick) const;

    /// [s] of a tick.
    double step() const { return static_cast<double>(trace_->episode().step_ns) * 1e-9; }

    /// Adds the ticks in which all sensors are there. Throws world::Error where there are none.
    void add_frames(std::size_t number, std::vector<DatasetFrame>& frames) const;

    /// The sweeps by their ticks: between two frames of this trace and of one part, where all
    /// sensors are there. `number`: of the trace.
    std::map<std::uint64_t, Moment> sweeps(std::size_t number,
                                           const std::vector<DatasetFrame>& frames) const;

  private:
    void check_rig(bool nuscenes) const;
    void read_sweeps(const DatasetOptions& dataset);
    bool are_all_there(const world::TickView& tick) const;

    RenderOptions options_;
    std::unique_ptr<replay::TraceReader> trace_;
    Ticks ticks_;
    std::uint64_t sweep_ = 0;
    std::unique_ptr<Cameras> cameras_;
    std::unique_ptr<MeasuredRig> rays_;
    bool has_twin_ = false;
};

}  // namespace reprise::cli
