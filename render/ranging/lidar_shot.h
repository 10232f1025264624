#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/ranging/fog_return.h"
#include "render/ranging/precipitation.h"
#include "render/ranging/reflectance.h"
#include "world/common_generated.h"
#include "world/external/sensor.h"

namespace reprise::render {

/// What a LiDAR's attributes say, and what is in the air before it.
struct LidarOptics {
    LidarOptics(const world::SensorSpec& spec, const world::Weather& weather);

    double range;            ///< [m]
    double attenuation;      ///< [1/m] of intensity alone
    double dropoff_general;  ///< shares, as CARLA's dropoff_*
    double dropoff_limit;
    double dropoff_zero;
    double noise;           ///< [m]
    double accuracy;        ///< [m] at the limit of what is noticed
    double divergence;      ///< [rad]
    bool has_reflectivity;  ///< else all surfaces are white
    std::size_t returns;
    float wetness;
    double least_power;  ///< that the receiver notices, as Pulse counts
    double extinction;   ///< [1/m] of all that is in the air
    FogReturn fog;
    Precipitation rain;
    Precipitation snow;
    bool clear;  ///< nothing is in the air
};

/// Of one shot.
struct LidarReturn {
    double range = 0;  ///< [m] as measured
    float intensity = 0;
};

inline constexpr std::size_t most_returns = 3;

/// The rays of a shot: its middle, and where more than one return is wanted four around it.
inline constexpr std::size_t rays_of_wide_beam = 5;

struct LidarReturns {
    std::array<LidarReturn, most_returns> found;
    std::size_t count = 0;
};

/// Which returns a receiver reports, the strongest first, from what the rays of a shot met.
LidarReturns returns_of(const LidarOptics& optics,
                        const Scene& scene,
                        std::span<const Echo> rays,
                        const world::SensorNoise& noise,
                        std::uint64_t shot);

}  // namespace reprise::render
