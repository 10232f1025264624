#include "render/look/scattering.h"

#include "render/trace/default_float_mode.h"

namespace reprise::render {

namespace {

constexpr float rayleigh_height = 8000;
constexpr float haze_height = 1200;

// At 630, 540 and 450 nm, where a screen's red, green and blue have their weight: farther apart the
// sky would be teal and a low sun pink. Scattering by air: Bruneton and Neyret, "Precomputed
// Atmospheric Scattering", 2008, by the fourth power of the wavelength; 300 Dobson units of ozone
// as in Hillaire, "A Scalable and Production Ready Sky and Atmosphere Rendering", 2020.
const Color rayleigh(7.88e-6F, 14.6e-6F, 30.3e-6F);
const Color ozone_depth(0.030F, 0.024F, 0.0014F);  // vertical optical depth
/// White is a white card in the sun of a clear noon, sky and all, as a camera set to daylight has
/// it.
const Color solar(1.726F, 1.777F, 1.894F);

/// Air mass relative to the zenith for a sine of the altitude (Kasten and Young, 1989, with the
/// angle in radians); flattens below the horizon.
float air_mass(float sine) {
    const float altitude_deg = std::max(-1.0F, 57.29578F * sine * (1 + 0.1667F * sine * sine));
    const float base = altitude_deg + 6.07995F;
    return 1 / (std::max(sine, 0.0F) + 0.50572F / (base * std::sqrt(base) * 1.18F));
}

/// Shares of the ground's air and haze that are left at a height.
struct Thinned {
    explicit Thinned(float height) {
        const Color shares = fast_exp(Color(-height / rayleigh_height, -height / haze_height, 0));
        air = shares.x();
        haze = shares.y();
    }

    float air;
    float haze;
};

/// Vertical optical depth of what is above. `haze`: scattering at the ground. [1/m]
Color column(const Thinned& thinned, float haze) {
    return rayleigh * rayleigh_height * thinned.air + haze * 1.1F * haze_height * thinned.haze;
}

/// Where the sun stands over a place.
struct Standing {
    explicit Standing(float sine_of_altitude)
        : sine(sine_of_altitude),
          mass(air_mass(std::abs(sine_of_altitude))) {}

    float sine;
    float mass;  ///< of the air on the way to it, or to the lowest place of that
};

/// Optical depth of a ray that comes from below the horizon: past the lowest place of its way, and
/// up again.
Color grazing_depth(const Standing& sun, float height, const Thinned& thinned, float haze) {
    const float lowest =
        (earth_radius + height) * std::sqrt(1 - sun.sine * sun.sine) - earth_radius;
    static const float level = air_mass(0);
    return (2 * level * column(Thinned(lowest), haze) - sun.mass * column(thinned, haze))
               .max(0.0F) +
           ozone_depth * level;
}

/// How much of the sunlight arrives at a height.
Color sunlight(const Standing& sun, float height, const Thinned& thinned, float haze) {
    if (sun.sine < 0)
        return solar * fast_exp(Color(-grazing_depth(sun, height, thinned, haze)));
    return solar * fast_exp(Color(-(column(thinned, haze) + ozone_depth) * sun.mass));
}

float rayleigh_phase(float cosine) {
    return 3 / (16 * pi) * (1 + cosine * cosine);
}

}  // namespace

float forward_phase(float cosine, float g) {
    const float base = std::max(1e-4F, 1 + g * g - 2 * g * cosine);
    return (1 - g * g) / (4 * pi * base * std::sqrt(base));
}

Color sunlight_at_sea_level(float sun_sine, float haze) {
    return sunlight(Standing(sun_sine), 0, Thinned(0), haze);
}

Color Scattered::seen(const Eigen::Vector3f& direction, const Eigen::Vector3f& to_sun) const {
    const float cosine = direction.dot(to_sun);
    return by_air * rayleigh_phase(cosine) + by_haze * forward_phase(cosine, 0.76F) + twice;
}

Scattered scattered(float up, float bend, float sun_sine, float haze) {
    Standing sun(sun_sine);
    // To the top of the air, at most as far as the earth's curve lets one see into it.
    const float top = 60e3F;
    const float far = -earth_radius * up +
                      std::sqrt(earth_radius * earth_radius * up * up + 2 * earth_radius * top);
    Scattered sum;
    Color depth = Color::Zero();
    constexpr int steps = 20;
    float last = 0;
    for (int i = 0; i < steps; ++i) {
        // Steps grow with the distance, since the air is densest here.
        const float share = static_cast<float>(i + 1) / steps;
        const float next = far * share * share;
        const float middle = 0.5F * (last + next);
        const float height = middle * up + middle * middle * (1 - up * up) / (2 * earth_radius);
        const Thinned thinned(height);
        const Color air = rayleigh * thinned.air;
        const float dust = haze * thinned.haze;
        const Color step_depth = (air + 1.1F * dust) * (next - last);
        if (bend != 0)
            sun = Standing(sun_sine + bend * middle);
        const Color light = sunlight(sun, height, thinned, haze);
        const Color through = fast_exp(Color(-(depth + 0.5F * step_depth))) * (next - last);
        // Light scattered more than once is about as strong again.
        const Color twice = 0.16F * light.mean() * Color(1.0F, 1.02F, 1.06F) * (0.35F + up);
        sum.by_air += through * light * air;
        sum.by_haze += through * light * dust;
        sum.twice += through * twice * (air + dust) * 0.6F;
        depth += step_depth;
        last = next;
    }
    return sum;
}

ScatteredByAltitude::ScatteredByAltitude(float sun_sine, float haze) {
    const FlushingFloatMode quick;
    for (int i = 0; i < size; ++i) {
        const float share = static_cast<float>(i) / (size - 1);
        // Close together at the horizon, where the sky changes most.
        nodes_[static_cast<std::size_t>(i)] = scattered(share * share, 0, sun_sine, haze);
    }
}

Scattered ScatteredByAltitude::of(float up) const {
    const float place = std::sqrt(std::min(up, 1.0F)) * (size - 1);
    const int first = std::min(static_cast<int>(place), size - 2);
    const float share = place - static_cast<float>(first);
    const Scattered& low = nodes_[static_cast<std::size_t>(first)];
    const Scattered& high = nodes_[static_cast<std::size_t>(first) + 1];
    return {mix(low.by_air, high.by_air, share),
            mix(low.by_haze, high.by_haze, share),
            mix(low.twice, high.twice, share)};
}

}  // namespace reprise::render
