#include <algorithm>
#include <cmath>

#include "render/shade/frame.h"
#include "world/random.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;
using world::draw;
using world::Purpose;

constexpr double exposure_time = 1.0 / 60;  // [s]
constexpr double nearest = 0.7;             // [m]
constexpr double farthest = 14;             // [m]

struct Streak {
    Vector3d from;  ///< on the picture [px], with the depth [m] as z
    Vector3d to;
    float half_width;  ///< [px]
    float strength;    ///< share of the light behind that the drop replaces
};

/// Adds a line with soft edges wherever nothing is nearer.
void draw_streak(const Streak& streak,
                 const Color& light,
                 const std::vector<Hit>& hits,
                 Frame& frame) {
    const Eigen::Vector2f from = streak.from.head<2>().cast<float>();
    const Eigen::Vector2f along = (streak.to - streak.from).head<2>().cast<float>();
    const float squared = std::max(along.squaredNorm(), 1e-4F);
    const float reach = streak.half_width + 1;
    const int left = std::max(0, floor_int(std::min(from.x(), from.x() + along.x()) - reach));
    const int right =
        std::min(frame.width - 1, floor_int(std::max(from.x(), from.x() + along.x()) + reach));
    const int top = std::max(0, floor_int(std::min(from.y(), from.y() + along.y()) - reach));
    const int bottom =
        std::min(frame.height - 1, floor_int(std::max(from.y(), from.y() + along.y()) + reach));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const std::size_t index = frame.index(x, y);
            const Hit& hit = hits[index];
            if (hit.instance != no_instance && hit.distance < static_cast<float>(streak.from.z()))
                continue;
            const Eigen::Vector2f pixel(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            const float share = clamp01((pixel - from).dot(along) / squared);
            const float away = (pixel - from - share * along).norm();
            const float cover =
                clamp01(streak.half_width + 0.5F - away) * std::min(1.0F, 2 * streak.half_width);
            // Drops fade in and out of the exposure at the ends.
            const float fade = 4 * share * (1 - share) * 0.6F + 0.4F;
            frame.colors[index] = mix(frame.colors[index], light, cover * fade * streak.strength);
        }
    }
}

}  // namespace

void draw_rain(const ShadingInput& input,
               const Camera& camera,
               const std::vector<Hit>& hits,
               Frame& frame) {
    const world::Weather& weather = input.sky.weather();
    if (weather.rain() <= 0)
        return;
    // Marshall and Palmer, 1948: drops of more than 1 mm in a cubic metre. Of the smaller ones, and
    // of the far ones, only the veil is left, see Sky::extinction().
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
    const Color light =
        input.sky.ambient(Eigen::Vector3f::UnitZ()) * (1.15F * input.sky.exposure());
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
        const double size = 1.0 - std::log(1 - 0.97 * number(3)) / slope;  // [mm]
        const double fall = 9.65 - 10.3 * std::exp(-0.6 * size);           // Atlas et al., 1973
        const Vector3d end = start + exposure_time * (wind - Vector3d(0, 0, fall));
        const Vector3d from = camera.project(start);
        const Vector3d to = camera.project(end);
        if (from.z() < nearest / 2 || to.z() < nearest / 2)
            continue;
        const double width = size * 1e-3 / depth / camera.pixel();
        draw_streak({from,
                     to,
                     static_cast<float>(std::max(0.35, width / 2)),
                     static_cast<float>(std::min(0.42, 0.16 + 0.10 * width))},
                    light,
                    hits,
                    frame);
    }
}

}  // namespace reprise::render
