#pragma once

#include <array>

#include <Eigen/Core>

#include "render/shapes/fast_math.h"

namespace reprise::render {

inline constexpr float earth_radius = 6360e3F;  ///< [m]

/// Of droplets and dust, which throw light forwards: `g` in [0, 1) says how much (Henyey and
/// Greenstein, 1941). [1/sr]
float forward_phase(float cosine, float g);

/// Irradiance on what faces the sun, at sea level, relative to what arrives above the air (see
/// Sky). `haze`: its scattering there [1/m].
Color sunlight_at_sea_level(float sun_sine, float haze);

/// What a line of sight through the air gets of the sun, but for the angle to it: single scattering
/// (Nishita et al., "Display of the Earth Taking into Account Atmospheric Scattering", 1993), and
/// what was scattered more often, roughly.
struct Scattered {
    Color by_air = Color::Zero();   ///< per unit of its phase function
    Color by_haze = Color::Zero();  ///< of its own
    Color twice = Color::Zero();    ///< scattered more than once: from everywhere

    /// Radiance, looking that way (unit vectors).
    Color seen(const Eigen::Vector3f& direction, const Eigen::Vector3f& to_sun) const;
};

/// `up`: sine of the line's altitude, from 0. `bend`: by how much the sine of the sun's altitude
/// grows along it [1/m]. About 1 us.
Scattered scattered(float up, float bend, float sun_sine, float haze);

/// The same under a sun that stands equally high everywhere: then the altitude alone says all.
class ScatteredByAltitude {
  public:
    ScatteredByAltitude(float sun_sine, float haze);

    Scattered of(float up) const;

  private:
    static constexpr int size = 512;
    std::array<Scattered, size> nodes_;
};

}  // namespace reprise::render
