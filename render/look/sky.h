#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "render/look/clouds.h"
#include "render/look/night_sky.h"
#include "render/look/veil.h"
#include "render/shapes/fast_math.h"
#include "world/common_generated.h"

namespace reprise::render {

/// The light of a weather: sun, moon, sky, clouds, haze. Radiances are relative to the sun's
/// irradiance above the atmosphere (about 1.8, see `lux`). Everything is finite and without a jump
/// for a sun anywhere between nadir and zenith.
class Sky {
  public:
    /// 2 ms, with a sun below 3 degrees and by night 26: single scattering by air and haze for
    /// every direction (Nishita et al., "Display of the Earth Taking into Account Atmospheric
    /// Scattering", 1993), clouds after Kasten and Czeplak.
    explicit Sky(const world::Weather& weather);

    /// Before a picture is made: from where, when, and how high the town's lowest ground is. All in
    /// the scene's frame. Clouds are where they are by then.
    void look_from(const Eigen::Vector3f& eye, float ground, std::uint64_t tick) {
        veil_.stand_on(ground);
        clouds_.look_from(eye, to_sun_, tick);
    }

    /// Radiance from a direction (unit vector). `detailed` draws the clouds' shapes and the sun's
    /// disc.
    Color radiance(const Eigen::Vector3f& direction, bool detailed) const;

    /// Sky light that a surface gets, over pi: what a white surface would send back.
    Color ambient(const Eigen::Vector3f& normal) const;

    /// What distance turns everything into, in this direction.
    Color haze(const Eigen::Vector3f& direction) const;

    const Eigen::Vector3f& to_sun() const { return to_sun_; }

    const Color& sun() const { return sun_; }  ///< irradiance on a surface that faces the sun

    float sun_radius() const {
        return sun_radius_;
    }  ///< of the disc or the glow through clouds [rad]

    const Veil& veil() const { return veil_; }

    const Clouds& clouds() const { return clouds_; }

    const Moon& moon() const { return moon_; }

    float exposure() const { return exposure_; }  ///< factor from radiance to picture

    /// How far lamps of streets and windows are lit, and drivers' head lamps: 0 by day, 1 by night.
    float lamplight() const { return lamplight_; }

    float headlamps() const { return headlamps_; }

    /// Radiance of a lamp of this luminance [cd/m2]; one that outshines everything by far shows as
    /// bright as `most` in the picture, so that its colour is still seen.
    float lamp(float luminance_cd, float most) const {
        const float physical = luminance_cd * lux;
        const float limit = most / exposure_;
        return physical * limit / (physical + limit);
    }

    const world::Weather& weather() const { return weather_; }

  private:
    Color cloud_radiance(const Eigen::Vector3f& direction) const;
    Color cloud_body(const Eigen::Vector3f& direction, const Color& clear, float cover) const;
    Color stored(const Eigen::Vector3f& direction) const;
    void fill_table();
    void add_fog();
    void darken_twilight();
    static float dome_illuminance(const std::vector<Color>& table);
    void add_night();
    void project_ambient();
    void choose_exposure();

    world::Weather weather_;
    Veil veil_;
    Clouds clouds_;
    Eigen::Vector3f to_sun_;
    Eigen::Vector3f to_glow_;  // the sun, or where it would give twilight its shape
    Color sun_;
    Color sun_above_clouds_;  // what is left of it in twilight
    Color sun_tint_;          // its colour, mean 1
    float daylight_;          // share of a sun on the horizon, 1 above it
    Moon moon_;
    float sun_radius_;
    float haze_scattering_;  // [1/m] at the ground
    float overcast_;         // share of the light that comes through a closed cover
    float exposure_;
    float lamplight_ = 0;
    float headlamps_ = 0;
    bool is_night_ = false;           // does anything but the sun light the sky?
    std::vector<Color> clear_table_;  // upper half sphere without clouds
    std::vector<Color> table_;        // with their mean
    std::array<Color, 9> harmonics_;  // of the whole sphere, the ground included
    Color horizon_;                   // mean just above it
};

}  // namespace reprise::render
