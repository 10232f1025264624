#include <algorithm>
#include <cmath>

#include "render/look/lamp_colors.h"
#include "render/shade/frame.h"
#include "render/shade/streak.h"
#include "world/random.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;
using world::draw;
using world::Purpose;

constexpr double nearest = 0.7;  // [m]
constexpr double farthest = 14;  // [m]

}  // namespace

void draw_rain(const ShadingInput& input,
               const Camera& camera,
               const std::vector<Hit>& hits,
               Frame& frame) {
    const world::Weather& weather = input.sky.weather();
    if (weather.rain() <= 0)
        return;
    // Marshall and Palmer, 1948: drops of more than 1 mm in a cubic metre. Of the smaller ones, and
    // of the far ones, only the veil is left, see world/weather/air.h.
    const auto rain = static_cast<double>(weather.rain());
    const double slope = 4.1 * std::pow(rain, -0.21);  // [1/mm]
    const double dense = 8000 * std::exp(-slope * 1.0) / slope;
    const double half_x = camera.width() / 2.0 * camera.pixel();
    const double half_y = camera.height() / 2.0 * camera.pixel();
    const double volume = 4 * half_x * half_y * (std::pow(farthest, 3) - std::pow(nearest, 3)) / 3;
    const auto count = static_cast<std::uint64_t>(std::min(7000.0, 0.35 * dense * volume));
    const auto azimuth = static_cast<double>(weather.wind_azimuth());
    const Vector3d wind = 0.45 * static_cast<double>(weather.wind_speed()) *
                          Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
    // A drop shows most of the sphere around it, upside down: the mean of the sky.
    const Color light = (input.sky.ambient(Eigen::Vector3f::UnitZ()) * 1.15F +
                         street_lamp_color * (0.25F * lux * input.sky.lamplight())) *
                        input.sky.exposure();
    const Shelter& shelter = input.scene.town().shelter();
    const std::uint64_t tick = input.tick;
    for (std::uint64_t drop = 0; drop < count; ++drop) {
        const auto number = [&](std::uint64_t k) {
            return draw(0, tick, Purpose::rain_drop, 4 * drop + k);
        };
        // Evenly in the volume that the camera sees: the cube of the depth is even.
        const double depth = std::cbrt(mix(std::pow(static_cast<float>(nearest), 3.0F),
                                           std::pow(static_cast<float>(farthest), 3.0F),
                                           static_cast<float>(number(0))));
        const Vector3d ray =
            camera.ray(number(1) * camera.width(), (number(2) * 1.3 - 0.15) * camera.height());
        const Vector3d start = camera.position() + depth * ray;
        // Below roofs and bridges nothing falls.
        if (shelter.openness(start.cast<float>()) < 0.5F)
            continue;
        const double size = 1.0 - std::log(1 - 0.97 * number(3)) / slope;  // [mm]
        const double fall = 9.65 - 10.3 * std::exp(-0.6 * size);           // Atlas et al., 1973
        const Vector3d end = start + exposure_time * (wind - Vector3d(0, 0, fall));
        const Vector3d from = camera.project(start);
        const Vector3d to = camera.project(end);
        if (from.z() < nearest / 2 || to.z() < nearest / 2)
            continue;
        // What is finer than a pixel hides less of it.
        const double width = size * 1e-3 / depth / camera.pixel();
        draw_streak({from,
                     to,
                     static_cast<float>(std::max(0.35, width / 2)),
                     static_cast<float>(std::min({0.42, 0.16 + 0.10 * width, 2.5 * width}))},
                    light,
                    hits,
                    frame);
    }
}

}  // namespace reprise::render
