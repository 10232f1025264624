// What it must do: an exposure in absolute light, with the noise of a real sensor, as a function of
//   (seed, sensor, tick, pixel, channel).
// How it goes: frame.colors are radiance times the weather's exposure; by hand they are taken to
//   luminance over what the exposure makes white. Noise is added before the tone curve, in
//   electrons.
// What it keeps: nothing.
#include "render/optics/develop.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <tbb/parallel_for.h>

#include "render/optics/pixel_noise.h"
#include "render/trace/default_float_mode.h"
#include "world/external/sensor_attributes.h"
#include "world/random.h"

namespace reprise::render {

namespace {

constexpr int table_size = 4096;

/// Light behind the tone curve over its root, in [0, 1], to values in [0, 255].
std::vector<float> value_table(double gamma) {
    std::vector<float> values(table_size);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double root = static_cast<double>(i) / (table_size - 1);
        const double light = root * root;
        double value =
            light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
        if (gamma > 0)
            value = std::pow(light, 1 / gamma);
        values[i] = static_cast<float>(255 * value);
    }
    return values;
}

/// Lagarde and de Rousiers, "Moving Frostbite to PBR", 2014: what exposes a sensor fully.
double brightest_luminance(const world::SensorSpec& spec) {
    const double aperture = world::attribute(spec, "fstop");
    const double shutter = world::attribute(spec, "shutter_speed");
    // 2^EV100
    const double exposure = aperture * aperture * shutter * 100 / world::attribute(spec, "iso");
    return 1.2 * exposure;  // [cd/m2]
}

/// From frame.colors to light of which 1 is white.
float gain_of(const world::SensorSpec& spec, const Sky& sky) {
    double gain = std::pow(2.0, world::attribute(spec, "exposure_compensation"));
    if (world::attribute(spec, "exposure_mode") > 0)
        gain /= brightest_luminance(spec) * static_cast<double>(lux) *
                static_cast<double>(sky.exposure());
    return static_cast<float>(gain);
}

bool is_usual(const world::SensorSpec& spec) {
    for (const char* name :
         {"exposure_mode", "exposure_compensation", "gamma", "tone", "noise", "vignette"})
        if (world::attribute(spec, name) != 0)
            return false;
    return true;
}

/// By the square of the distance from the middle; 1 there.
void darken_corners(Frame& frame, float share) {
    const Eigen::Vector2f half(static_cast<float>(frame.width) / 2,
                               static_cast<float>(frame.height) / 2);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x) {
            const Eigen::Vector2f at(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            frame.colors[frame.index(x, y)] *=
                1 - share * (at - half).squaredNorm() / half.squaredNorm();
        }
}

}  // namespace

std::vector<std::uint8_t> develop(const world::SensorSpec& spec,
                                  const Sky& sky,
                                  std::uint64_t tick,
                                  Frame& frame) {
    if (is_usual(spec))
        return tone_map(frame, tick);
    if (const double share = world::attribute(spec, "vignette"); share > 0)
        darken_corners(frame, static_cast<float>(share));
    const float gain = gain_of(spec, sky);
    const bool linear = world::attribute(spec, "tone") > 0;
    const bool noisy = world::attribute(spec, "noise") > 0;
    const PixelNoise noise(spec, tick, linear ? 1.0 : 4.0);
    const double gamma = world::attribute(spec, "gamma");
    const std::vector<float> values = value_table(gamma);
    std::vector<std::uint8_t> bytes(frame.colors.size() * 3);
    tbb::parallel_for(0, frame.height, [&](int y) {
        const DefaultFloatMode plain;
        for (int x = 0; x < frame.width; ++x) {
            const std::size_t index = frame.index(x, y);
            Color light = (frame.colors[index] * gain).max(0.0F).min(1e6F);
            if (noisy)
                light = {noise.measured(light.x(), 3 * index),
                         noise.measured(light.y(), 3 * index + 1),
                         noise.measured(light.z(), 3 * index + 2)};
            light = linear ? Color(light.min(1.0F)) : film(light);
            const auto grain = static_cast<float>(world::draw(
                0, tick, world::Purpose::camera_noise, static_cast<std::uint64_t>(index)));
            for (int channel = 0; channel < 3; ++channel) {
                // Straight light needs no table, whose steps would be seen in what is measured.
                const float value = gamma == 1
                                        ? 255 * light[channel]
                                        : values[static_cast<std::size_t>(
                                              std::sqrt(light[channel]) * (table_size - 1) + 0.5F)];
                bytes[3 * index + static_cast<std::size_t>(channel)] =
                    static_cast<std::uint8_t>(std::min(255.0F, value + grain));
            }
        }
    });
    return bytes;
}

void blank_unseen(const Camera& camera, world::SensorFrame& frame) {
    if (camera.lens().is_plain() || frame.width <= 0)
        return;
    const std::size_t pixel =
        world::bytes_of(frame.type) * static_cast<std::size_t>(frame.channels);
    // Depth, normals, flow and numbers are those of nothing there already.
    if (frame.kind != world::SensorKind::rgb && frame.kind != world::SensorKind::semantic)
        return;
    tbb::parallel_for(0, frame.height, [&](int y) {
        const DefaultFloatMode plain;
        for (int x = 0; x < frame.width; ++x)
            if (camera.ray(x + 0.5, y + 0.5).isZero(0))
                std::fill_n(
                    frame.data.begin() + static_cast<std::ptrdiff_t>(
                                             static_cast<std::size_t>(y * frame.width + x) * pixel),
                    pixel,
                    std::uint8_t{0});
    });
}

}  // namespace reprise::render
