#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <string>

#include "cli/dataset/dataset_layout.h"
#include "cli/pictures/picture_output.h"

namespace reprise::cli {

/// Pictures of one trace under one weather on their way into a data set. What is there already is
/// not asked for again.
class DatasetOutput : public PictureOutput {
  public:
    /// `moments` of the trace's ticks. `labels`: those are made as well.
    DatasetOutput(const DatasetLayout& layout,
                  std::string weather,
                  std::map<std::uint64_t, Moment> moments,
                  bool labels);

    bool in_order() const override { return false; }

    bool shows(std::size_t sensor) const override { return layout_.is_rgb(sensor); }

    bool wants(std::size_t sensor, std::uint64_t tick) const override;

    /// Whether anything is.
    bool wants_any() const;

    void take(std::size_t sensor,
              const world::SensorFrame& frame,
              const world::SensorFrame& shown) override;
    void take_boxes(std::size_t sensor,
                    std::uint64_t tick,
                    const std::string& text,
                    const world::SensorFrame& instances) override;

    std::size_t pictures() const { return pictures_; }

  private:
    const DatasetLayout& layout_;
    std::string weather_;
    std::map<std::uint64_t, Moment> moments_;
    bool labels_;
    std::atomic<std::size_t> pictures_ = 0;
};

}  // namespace reprise::cli
