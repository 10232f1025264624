#pragma once

#include <cstdint>
#include <vector>

#include "render/shade/frame.h"

namespace reprise::render {

/// The logarithm of each pixel's light at an instant.
struct LogPicture {
    std::int64_t time_ns = 0;
    std::vector<float> logs;
};

LogPicture log_picture(const Frame& frame, double log_eps, std::int64_t time_ns);

/// Fills `frame` with what an event camera notices between the first of these pictures and the
/// last. Between two pictures light changes evenly in its logarithm.
void find_events(const world::SensorSpec& spec,
                 const std::vector<LogPicture>& pictures,
                 world::SensorFrame& frame);

}  // namespace reprise::render
