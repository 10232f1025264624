#pragma once

#include <cstdint>
#include <string_view>

namespace reprise::world {

/// Random numbers of a sensor's frame as functions of (seed, sensor, tick, item, which): there is
/// no generator, so a frame does not depend on those before it, nor a ray on its neighbours.
class SensorNoise {
  public:
    SensorNoise(std::uint64_t seed, std::string_view sensor, std::uint64_t tick);

    /// In [0, 1). `item` is a ray or a reading, `which` tells its draws apart.
    double uniform(std::uint64_t item, std::uint32_t which) const;

    /// Of the standard normal distribution.
    double normal(std::uint64_t item, std::uint32_t which) const;

  private:
    std::uint64_t key_;
};

/// Below which a share `probability` of the standard normal distribution lies; in (0, 1). Relative
/// error below 1.2e-9: P. J. Acklam's rational approximation (2003).
double normal_quantile(double probability);

}  // namespace reprise::world
