#include <algorithm>
#include <cmath>

#include "render/look/lamp_colors.h"
#include "render/shade/frame.h"
#include "render/shade/streak.h"
#include "world/hash.h"

namespace reprise::render {

namespace {

using Eigen::Vector3d;

// Flakes fill a cube that is repeated over the world: each comes back where it left, so that they
// stand in the world while the camera moves through them.
constexpr double cube_side = 14;                  // [m] of the cube
constexpr double nearest_flake = 0.5;             // [m]
constexpr double farthest_flake = cube_side / 2;  // [m] as far as the cube reaches to all sides
constexpr double flakes_per_mm_h = 26'000;        // in the cube: 9 in a cubic metre, the large ones
constexpr double most_flakes = 70'000;
constexpr double flake_seconds_a_tick = 0.05;

/// In [0, 1), of a flake.
double flake_number(std::uint32_t flake, std::uint32_t k) {
    return static_cast<double>(world::unit(world::hash(flake * 8 + k + 0x51ed270bU)));
}

/// Into [-cube_side / 2, cube_side / 2).
double wrapped_in_cube(double x) {
    return x - cube_side * std::floor(x / cube_side + 0.5);
}

}  // namespace

void draw_snow(const ShadingInput& input,
               const Camera& camera,
               const std::vector<Hit>& hits,
               Frame& frame) {
    const world::Weather& weather = input.sky.weather();
    const auto count = static_cast<std::uint32_t>(
        std::min(most_flakes, flakes_per_mm_h * static_cast<double>(weather.snow())));
    if (count == 0)
        return;
    const auto azimuth = static_cast<double>(weather.wind_azimuth());
    const Vector3d wind = static_cast<double>(weather.wind_speed()) *
                          Vector3d(std::cos(azimuth), std::sin(azimuth), 0);
    const double time = static_cast<double>(input.tick) * flake_seconds_a_tick;
    const Shelter& shelter = input.scene.town().shelter();
    // White, lit by the sky from above and by what lies below; by night by 2 lx of a street's
    // lamps.
    const Color light =
        (0.75F * input.sky.ambient(Eigen::Vector3f::UnitZ()) +
         0.25F * input.sky.ambient(-Eigen::Vector3f::UnitZ()) + 0.10F * input.sky.sun() +
         street_lamp_color * (0.5F * lux * input.sky.lamplight())) *
        input.sky.exposure();
    // By night lamps light what is behind a flake, and the flake, which faces them.
    const float lit = 1.25F * input.sky.lamplight();
    for (std::uint32_t flake = 0; flake < count; ++flake) {
        const double fall = 0.9 + 0.7 * flake_number(flake, 3);  // [m/s] Gunn and Marshall, 1958
        const Vector3d speed = wind - Vector3d(0, 0, fall);
        // It flutters a little about its way.
        const double turn = 6 * flake_number(flake, 4) + time * (1.5 + flake_number(flake, 5));
        const Vector3d home(cube_side * flake_number(flake, 0),
                            cube_side * flake_number(flake, 1),
                            cube_side * flake_number(flake, 2));
        const Vector3d flutter(0.10 * std::sin(turn), 0.10 * std::cos(turn), 0);
        Vector3d away = home + speed * time + flutter - camera.position();
        away = {wrapped_in_cube(away.x()), wrapped_in_cube(away.y()), wrapped_in_cube(away.z())};
        const double distance = away.norm();
        if (distance > farthest_flake)
            continue;
        const Vector3d place = camera.position() + away;
        const Vector3d from = camera.project(place);
        if (from.z() < nearest_flake || from.x() < -20 || from.y() < -20 ||
            from.x() > camera.width() + 20 || from.y() > camera.height() + 20)
            continue;
        const Vector3d to = camera.project(place + speed * (0.5 * exposure_time));
        if (to.z() < nearest_flake / 2 || shelter.openness(place.cast<float>()) < 0.5F)
            continue;
        const double radius =
            0.0018 + 0.0045 * flake_number(flake, 6) * flake_number(flake, 6);  // [m]
        const double pixels = radius / from.z() / camera.pixel();
        // What is finer than a pixel hides less of it.
        const double share = std::min(1.0, 2 * pixels);
        // The far ones fade out before the cube ends.
        const double fade = std::min(1.0, 3 * (1 - distance / farthest_flake));
        draw_streak({from,
                     to,
                     static_cast<float>(std::max(0.5, pixels)),
                     static_cast<float>(0.8 * fade * share * (0.3 + 0.7 * share)),
                     lit},
                    light,
                    hits,
                    frame);
    }
}

}  // namespace reprise::render
