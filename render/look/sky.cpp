#include "render/look/sky.h"

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include <tbb/parallel_for.h>

#include "render/look/scattering.h"
#include "render/shapes/fast_math.h"
#include "render/trace/default_float_mode.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr int table_size = 160;
constexpr float ground_albedo = 0.16F;

/// Where a direction lies in a table, between four of its entries.
struct TableSpot {
    explicit TableSpot(const Vector3f& direction) {
        const Vector3f up(direction.x(), direction.y(), std::max(direction.z(), 0.0F));
        const float sum = std::abs(up.x()) + std::abs(up.y()) + up.z();
        const float u = up.x() / std::max(sum, 1e-6F);
        const float v = up.y() / std::max(sum, 1e-6F);
        constexpr float scale = 0.5F * (table_size - 1);
        const float x = std::min(std::max((u + v + 1) * scale, 0.0F), table_size - 1.001F);
        const float y = std::min(std::max((u - v + 1) * scale, 0.0F), table_size - 1.001F);
        const int column = static_cast<int>(x);
        const int row = static_cast<int>(y);
        across = x - static_cast<float>(column);
        along = y - static_cast<float>(row);
        first = static_cast<std::size_t>(row * table_size + column);
    }

    Color of(const std::vector<Color>& table) const {
        const Color* at = &table[first];
        return (at[0] * (1 - across) + at[1] * across) * (1 - along) +
               (at[table_size] * (1 - across) + at[table_size + 1] * across) * along;
    }

    std::size_t first;
    float across;
    float along;
};

/// The lowest sun that gives single scattering its shape; below, only its strength falls. [rad]
constexpr float lowest_glow = -0.11F;

/// The upper half sphere on a square: an octahedron, unfolded.
Vector3f direction_at(float x, float y) {
    const float u = 0.5F * (x + y);
    const float v = 0.5F * (x - y);
    return Vector3f(u, v, std::max(0.0F, 1 - std::abs(u) - std::abs(v))).normalized();
}

Vector3f table_direction(int row, int column) {
    return direction_at(static_cast<float>(column) * 2 / (table_size - 1) - 1,
                        static_cast<float>(row) * 2 / (table_size - 1) - 1);
}

/// Unit vector, z up, from east counter-clockwise.
Vector3f towards(double azimuth, double altitude) {
    return Eigen::Vector3d(std::cos(altitude) * std::cos(azimuth),
                           std::cos(altitude) * std::sin(azimuth),
                           std::sin(altitude))
        .cast<float>();
}

}  // namespace

Sky::Sky(const world::Weather& weather)
    : weather_(weather),
      veil_(weather),
      clouds_(weather),
      to_sun_(towards(static_cast<double>(weather.sun_azimuth()),
                      static_cast<double>(weather.sun_altitude()))),
      to_glow_(towards(static_cast<double>(weather.sun_azimuth()),
                       static_cast<double>(std::max(lowest_glow, weather.sun_altitude())))),
      daylight_(twilight_illuminance(weather.sun_altitude()) / twilight_illuminance(0)),
      moon_(to_sun_, weather.cloud_cover()) {
    haze_scattering_ = 4e-6F * std::max(0.3F, weather.turbidity() - 1);
    const float cover = weather.cloud_cover();
    // Kasten and Czeplak, 1980: global radiation under N oktas of cloud.
    const float squared = cover * cover;
    overcast_ = 1 - 0.75F * squared * cover * std::sqrt(std::sqrt(std::sqrt(cover)));
    const Color arriving = sunlight_at_sea_level(std::max(to_sun_.z(), 0.0F), haze_scattering_);
    sun_above_clouds_ = arriving * daylight_;
    // Clouds redden with the last sun; deep in twilight none reaches them.
    sun_tint_ = mix(Color(0.9F, 0.95F, 1.15F),
                    Color(arriving / arriving.mean()),
                    smooth_step(-0.13F, -0.02F, to_sun_.z()));
    // The disc sinks; refraction holds it up a little.
    sun_ = arriving * ((1 - squared) * smooth_step(-0.016F, 0.002F, to_sun_.z()));
    sun_radius_ = mix(0.006F, 0.06F, squared);
    const Color sun_above_fog = sun_;
    fill_table();
    std::vector<Color> without_fog = table_;
    add_fog();
    project_ambient();
    choose_exposure();
    is_night_ = lamplight_ > 0 || moon_.light.maxCoeff() > 0;
    if (!is_night_)
        return;
    // Exposure goes by daylight alone; what else lights the sky shines through the same fog.
    sun_ = sun_above_fog;
    table_ = std::move(without_fog);
    add_night();
    add_fog();
    project_ambient();
}

Color Sky::cloud_radiance(const Vector3f& direction) const {
    // Moon and Spencer's overcast dome, lit by what comes from above, with a warm glow where the
    // sun stands behind it.
    const float sine = std::max(to_sun_.z(), 0.0F);
    const float light =
        sun_above_clouds_.mean() * std::max(sine, 0.02F) + (0.12F * sine + .02F) * daylight_;
    const float dome = (1 + 2 * std::max(direction.z(), 0.0F)) / 3;
    const Color grey(0.93F, 0.98F, 1.06F);
    const Color tint = mix(grey, sun_tint_, 0.25F);
    const float cosine = direction.dot(to_glow_);
    // Through a closed cover nobody sees where the sun stands.
    const float squared = weather_.cloud_cover() * weather_.cloud_cover();
    const Color glow = sun_above_clouds_ * mix(1.0F, 0.2F, squared * squared) *
                       (0.30F * forward_phase(cosine, 0.72F) * (1 - 0.8F * weather_.cloud_cover()) +
                        0.05F * forward_phase(cosine, 0.4F));
    return tint * (light * overcast_ * dome * 9 / (7 * pi) * 1.15F) + glow;
}

/// A cloud that hides as much, before a clear sky.
Color Sky::cloud_body(const Vector3f& direction, const Color& clear, float cover) const {
    Color cloud = cloud_radiance(direction);
    if (is_night_)
        cloud += 1.7F * night_glow(direction, moon_, weather_.cloud_cover(), lamplight_);
    const float light = sun_above_clouds_.mean() * (0.10F + 0.35F * (1 - weather_.cloud_cover()));
    // Thin clouds shine white in the sun, thick ones are grey below.
    const float thickness = smooth_step(0.2F, 1.0F, cover);
    const Color white = clear * 0.5F + light * 0.55F * Color(1, 0.985F, 0.965F) * sun_tint_;
    return mix(white,
               Color(cloud * mix(1.25F, 0.72F, thickness)),
               std::max(thickness * 0.6F, weather_.cloud_cover()));
}

Color Sky::radiance(const Vector3f& direction, bool detailed) const {
    const TableSpot spot(direction);
    const Color plain = spot.of(table_);
    if (!detailed || direction.z() < 0)
        return plain;
    const float cover = clouds_.cover(direction);
    Color seen = spot.of(clear_table_);
    if (cover > 0)
        seen = mix(seen, cloud_body(direction, seen, cover), cover * 0.94F);
    // Far clouds drown in the haze.
    seen = mix(seen, plain, smooth_step(0.16F, 0.01F, direction.z()));
    seen = mix(plain, seen, veil_.passes_upwards(direction.z()));
    constexpr float sun_edge = 0.999965F;
    constexpr float moon_edge = 0.999985F;
    const float at_sun = direction.dot(to_sun_);
    const float at_moon = direction.dot(moon_.to_moon);
    if (at_sun <= sun_edge && at_moon <= moon_edge)
        return seen;
    const float disc = smooth_step(sun_edge, 0.99998F, at_sun);
    const float moon = smooth_step(moon_edge, 0.999991F, at_moon) *
                       smooth_step(0, 0.03F, moon_.to_moon.z()) * moon_.through_clouds *
                       lamp(2500, 1.6F);
    return seen + (sun_ * disc * 400 + Color(moon, moon, 0.94F * moon)) * (1 - cover);
}

Color Sky::stored(const Vector3f& direction) const {
    return TableSpot(direction).of(table_);
}

void Sky::fill_table() {
    const std::size_t size = static_cast<std::size_t>(table_size) * table_size;
    clear_table_.resize(size);
    // Over far places a low sun stands higher or lower: only twilight shows it.
    const float low = smooth_step(0.05F, -0.03F, to_glow_.z());
    std::unique_ptr<const ScatteredByAltitude> by_altitude;
    if (low <= 0)
        by_altitude = std::make_unique<ScatteredByAltitude>(to_glow_.z(), haze_scattering_);
    tbb::parallel_for(0, table_size, [&](int row) {
        // By night no light arrives at most of the air.
        const FlushingFloatMode quick;
        for (int column = 0; column < table_size; ++column) {
            const Vector3f direction = table_direction(row, column);
            const float up = std::max(direction.z(), 0.0F);
            const float bend = low * direction.head<2>().dot(to_glow_.head<2>()) / earth_radius;
            const Scattered light = by_altitude
                                        ? by_altitude->of(up)
                                        : scattered(up, bend, to_glow_.z(), haze_scattering_);
            clear_table_[static_cast<std::size_t>(row * table_size + column)] =
                light.seen(direction, to_glow_);
        }
    });
    if (to_sun_.z() < 0)
        darken_twilight();
    table_.resize(size);
    tbb::parallel_for(0, table_size, [&](int row) {
        const DefaultFloatMode plain;
        for (int column = 0; column < table_size; ++column) {
            const auto index = static_cast<std::size_t>(row * table_size + column);
            table_[index] = mix(clear_table_[index],
                                cloud_radiance(table_direction(row, column)),
                                weather_.cloud_cover());
        }
    });
}

/// Single scattering says how twilight looks; how bright it is has been measured.
void Sky::darken_twilight() {
    // The model's horizon is not quite the measured one: both meet within six degrees.
    const float trust = smooth_step(0, -0.115F, weather_.sun_altitude());
    // What was scattered more often comes from everywhere, and is blue.
    const float once = dome_illuminance(clear_table_);
    for (Color& light : clear_table_)
        light += Color(0.55F, 0.95F, 1.7F) * (once * trust * 0.2F / pi);
    const float measured = twilight_illuminance(weather_.sun_altitude()) * lux;
    const double share = static_cast<double>(measured / dome_illuminance(clear_table_));
    const auto factor = static_cast<float>(std::pow(share, static_cast<double>(trust)));
    for (Color& light : clear_table_)
        light *= factor;
}

/// Of level ground, by a sky alone.
float Sky::dome_illuminance(const std::vector<Color>& table) {
    float sum = 0;
    constexpr int rows = 12;
    constexpr int columns = 24;
    for (int i = 0; i < rows * columns; ++i) {
        const int row = i / columns;
        const float z = (static_cast<float>(row) + 0.5F) / rows;
        const double altitude = std::asin(static_cast<double>(z));
        const Vector3f way = towards(2 * std::numbers::pi * (i % columns) / columns, altitude);
        sum += luminance(TableSpot(way).of(table)) * (z * 2 * pi / (rows * columns));
    }
    return sum;
}

void Sky::add_night() {
    tbb::parallel_for(0, table_size, [&](int row) {
        const DefaultFloatMode plain;
        for (int column = 0; column < table_size; ++column) {
            const auto index = static_cast<std::size_t>(row * table_size + column);
            const Color night =
                night_glow(table_direction(row, column), moon_, weather_.cloud_cover(), lamplight_);
            clear_table_[index] += night;
            table_[index] += night * mix(1.0F, 1.7F, weather_.cloud_cover());
        }
    });
}

/// What hides the sky is lit from above as evenly as by a white card, and by the sun around itself.
/// The sun loses what the sky gains.
void Sky::add_fog() {
    Color above = Color::Zero();
    constexpr int rows = 12;
    constexpr int columns = 24;
    for (int i = 0; i < rows * columns; ++i) {
        const int row = i / columns;
        const float z = (static_cast<float>(row) + 0.5F) / rows;
        const double angle = 2 * std::numbers::pi * (i % columns) / columns;
        const float wide = std::sqrt(1 - z * z);
        above += stored({wide * static_cast<float>(std::cos(angle)),
                         wide * static_cast<float>(std::sin(angle)),
                         z}) *
                 (z * 2 * pi / (rows * columns));
    }
    const float sine = std::max(to_sun_.z(), 0.0F);
    const float sunny = veil_.passes_upwards(sine);
    const Color even = (above + sun_ * (0.7F * sine)) * veil_.tint() / pi;
    for (int row = 0; row < table_size; ++row) {
        for (int column = 0; column < table_size; ++column) {
            const Vector3f direction =
                direction_at(static_cast<float>(column) * 2 / (table_size - 1) - 1,
                             static_cast<float>(row) * 2 / (table_size - 1) - 1);
            const float cosine = direction.dot(to_sun_);
            // Droplets throw light forwards (Henyey and Greenstein): once, and wider when often.
            const Color glow = sun_ * veil_.tint() *
                               (0.35F * sunny * forward_phase(cosine, 0.88F) +
                                0.20F * std::sqrt(sunny) * forward_phase(cosine, 0.6F));
            const float passes = veil_.passes_upwards(direction.z());
            Color& light = table_[static_cast<std::size_t>(row * table_size + column)];
            light = mix(Color(even + glow), light, passes);
        }
    }
    sun_ *= std::sqrt(sunny);
}

void Sky::project_ambient() {
    // Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps",
    // 2001: nine coefficients, already multiplied by the cosine lobe's. Over pi: a white surface's
    // light.
    harmonics_.fill(Color::Zero());
    horizon_ = Color::Zero();
    Color down = Color::Zero();
    constexpr int rows = 24;
    constexpr int columns = 48;
    for (int half = 0; half < 2; ++half) {
        for (int i = 0; i < rows * columns; ++i) {
            const int row = i / columns;
            const float z = (static_cast<float>(row) + 0.5F) / rows;
            const double angle = 2 * std::numbers::pi * (i % columns) / columns;
            const float wide = std::sqrt(1 - z * z);
            const Vector3f d(wide * static_cast<float>(std::cos(angle)),
                             wide * static_cast<float>(std::sin(angle)),
                             half == 0 ? z : -z);
            const float solid = 2 * pi / (rows * columns);
            // The lower half is ground, lit by sun and sky.
            const Color light = half == 0 ? stored(d) : down;
            const std::array<float, 9> basis{0.282095F,
                                             0.488603F * d.y(),
                                             0.488603F * d.z(),
                                             0.488603F * d.x(),
                                             1.092548F * d.x() * d.y(),
                                             1.092548F * d.y() * d.z(),
                                             0.315392F * (3 * d.z() * d.z() - 1),
                                             1.092548F * d.x() * d.z(),
                                             0.546274F * (d.x() * d.x() - d.y() * d.y())};
            for (std::size_t k = 0; k < 9; ++k)
                harmonics_[k] += light * (basis[k] * solid);
            if (half == 0 && z < 0.1F)
                horizon_ += light / (2 * columns);  // two rows lie below 0.1
        }
        if (half == 0) {
            Color sum = Color::Zero();
            for (int i = 0; i < rows * columns; ++i) {
                const int row = i / columns;
                const float z = (static_cast<float>(row) + 0.5F) / rows;
                const double angle = 2 * std::numbers::pi * (i % columns) / columns;
                const float wide = std::sqrt(1 - z * z);
                sum += stored({wide * static_cast<float>(std::cos(angle)),
                               wide * static_cast<float>(std::sin(angle)),
                               z}) *
                       (z * 2 * pi / (rows * columns));
            }
            const Color arriving = sum + sun_ * std::max(to_sun_.z(), 0.0F) +
                                   moon_.light * std::max(moon_.to_moon.z(), 0.0F);
            // Snow throws most of it back.
            const float albedo = mix(ground_albedo, 0.75F, weather_.snow_cover());
            down = arriving * (albedo / pi) * Color(1.0F, 0.98F, 0.9F);
        }
    }
    const std::array<float, 9> lobe{1, .666667F, .666667F, .666667F, .25F, .25F, .25F, .25F, .25F};
    for (std::size_t k = 0; k < 9; ++k)
        // Cameras balance white between sun and shade; ours has no other place to do it.
        harmonics_[k] =
            mix(harmonics_[k], Color(luminance(harmonics_[k]) * Color(1.03F, 1.0F, 0.96F)), 0.45F) *
            lobe[k];
}

Color Sky::ambient(const Vector3f& n) const {
    const Color sum = harmonics_[0] * 0.282095F + harmonics_[1] * (0.488603F * n.y()) +
                      harmonics_[2] * (0.488603F * n.z()) + harmonics_[3] * (0.488603F * n.x()) +
                      harmonics_[4] * (1.092548F * n.x() * n.y()) +
                      harmonics_[5] * (1.092548F * n.y() * n.z()) +
                      harmonics_[6] * (0.315392F * (3 * n.z() * n.z() - 1)) +
                      harmonics_[7] * (1.092548F * n.x() * n.z()) +
                      harmonics_[8] * (0.546274F * (n.x() * n.x() - n.y() * n.y()));
    return sum.max(0.0F);
}

Color Sky::haze(const Vector3f& direction) const {
    const Vector3f level = Vector3f(direction.x(), direction.y(), 0.04F).normalized();
    return 0.55F * stored(level) + 0.45F * horizon_;
}

/// By what the sun gives, before the night's own light is added: the lower it stands, the longer.
void Sky::choose_exposure() {
    // A fixed exposure for each weather - no adaptation to what a picture shows, so that every
    // frame stands alone. By night it is made for a street between two lamps.
    constexpr float street = 3.5F * lux / pi;
    const Color ground = sun_ * std::max(to_sun_.z(), 0.0F) / pi + ambient(Vector3f::UnitZ());
    const float light = luminance(ground);
    lamplight_ = lamplight_at(light * pi / lux);
    headlamps_ = headlamps_at(light * pi / lux, weather_.rain());
    exposure_ = exposure_for(light + street * lamplight_);
}

}  // namespace reprise::render
