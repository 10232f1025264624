#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cli/dataset/dataset_layout.h"
#include "cli/measured/ray_loop.h"
#include "render/labels/boxes.h"

namespace reprise::cli {

/// Points of one trace under one weather on their way into a data set: in the sensor's frame at the
/// tick. What is there already is not asked for again.
class DatasetPoints : public RayOutput {
  public:
    /// `moments` of the trace's ticks. `sensors`: how many there are; one more than the layout's is
    /// the twin of the first LiDAR. `town`: of the trace. `labels`: what is the same under all
    /// weathers is made as well.
    DatasetPoints(const DatasetLayout& layout,
                  std::string weather,
                  std::map<std::uint64_t, Moment> moments,
                  std::size_t sensors,
                  const world::TownT& town,
                  bool labels);

    bool wants(std::size_t sensor, std::uint64_t tick) const override;

    /// Whether anything is.
    bool wants_any() const;

    void take(std::size_t sensor,
              const world::TickView& tick,
              const world::SensorSpec& placed,
              world::SensorFrame frame) override;

    std::size_t sweeps() const { return sweeps_; }

  private:
    bool is_twin(std::size_t sensor) const;
    std::filesystem::path path_of(std::size_t sensor, const Moment& moment) const;

    const DatasetLayout& layout_;
    std::string weather_;
    std::map<std::uint64_t, Moment> moments_;
    std::size_t sensors_;
    std::vector<render::ParkedVehicle> parked_;  ///< where there is a twin
    bool labels_;
    std::atomic<std::size_t> sweeps_ = 0;
};

}  // namespace reprise::cli
