#pragma once

#include <cstdint>

#include "world/external/sensor.h"
#include "world/external/sensor_noise.h"

namespace reprise::render {

/// What a sensor's pixels measure instead of light, by the linear model of EMVA 1288 (release 4.0,
/// part linear): photons arrive one by one, reading adds noise, pixels differ, a converter rounds.
///   variance = K^2 (electrons + read_noise^2) + 1/12 of a step^2, K steps an electron
class PixelNoise {
  public:
    /// `most`: the light that fills a pixel, where 1 is white.
    PixelNoise(const world::SensorSpec& spec, std::uint64_t tick, double most);

    /// Of light, 1 is white. `pixel`: a number for each pixel and channel.
    float measured(float light, std::uint64_t pixel) const;

  private:
    double arrived(double mean, std::uint64_t pixel) const;

    double most_;
    double full_;  ///< [electrons] of the most light
    double read_;
    double prnu_, dsnu_;
    double steps_;                ///< of the converter
    world::SensorNoise moment_;   ///< is another one in each tick
    world::SensorNoise forever_;  ///< is always the same
};

}  // namespace reprise::render
