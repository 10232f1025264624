#pragma once

#include <Eigen/Core>

#include "render/shapes/fast_math.h"

/// What lights the world when the sun does not, and how long cameras expose for it.
namespace reprise::render {

/// An illuminance of 1 lx in the sky's unit: the sun's 1.78 above the atmosphere are 128,000 lx
/// (Darula, Kittler and Gueymard, 2005: 133,000; less for three wavelengths only).
inline constexpr float lux = 1 / 72000.0F;

/// Illuminance of level ground under a clear sky by a sun at or below the horizon. `altitude` in
/// [rad], up to 0; in lx. 650 at 0 (400 when its rim sets), 3.4 at -6
/// degrees, 0.008 at -12, 0.0006 of stars and airglow
/// from -18 on (Seidelmann, "Explanatory Supplement to the Astronomical Almanac", 1992, ch. 9,
/// rounded). Grows with the altitude, without a jump.
float twilight_illuminance(float altitude);

/// The moon is full, and stands opposite the sun.
struct Moon {
    Moon(const Eigen::Vector3f& to_sun, float cloud_cover);

    Eigen::Vector3f to_moon;
    float through_clouds;  ///< share that is left of its disc
    Color light;           ///< irradiance on a surface that faces it; 0 while the sun is up
};

/// Radiance of a night's sky: the town's lamps in the haze, more in clouds, and moonlit air.
/// `lamplight` as Sky::lamplight().
Color night_glow(const Eigen::Vector3f& direction,
                 const Moon& moon,
                 float cloud_cover,
                 float lamplight);

/// Share of the lamps of streets and windows that are lit under a daylight of `illuminance` [lx].
float lamplight_at(float illuminance);

/// How far drivers have their head lamps on: for the dark, or for rain. [0, 1]
float headlamps_at(float illuminance, float rain);

/// Factor from radiance to picture for ground that sends `light` back where it is white. Falls
/// while `light` grows, but slower than it: noon looks brighter than dusk, and dusk than night.
float exposure_for(float light);

}  // namespace reprise::render
