#include "render/ranging/obstacle.h"

#include <bit>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/ranging/echo.h"
#include "render/ranging/mount.h"
#include "render/ranging/point_frame.h"
#include "world/external/point_fields.h"
#include "world/external/sensor_attributes.h"

namespace reprise::render {

namespace {

constexpr int rings = 4;    // of the tube, around its middle
constexpr int spokes = 16;  // rays on each

std::vector<Beam> tube(const Eigen::Isometry3d& pose, double radius) {
    std::vector<Beam> beams{{pose.translation(), pose.linear().col(0)}};
    for (int ring = 1; ring <= rings; ++ring)
        for (int spoke = 0; spoke < spokes; ++spoke) {
            const double angle = 2 * std::numbers::pi * spoke / spokes;
            const double away = radius * ring / rings;
            const Eigen::Vector3d place(0, away * std::cos(angle), away * std::sin(angle));
            beams.push_back({pose * place, pose.linear().col(0)});
        }
    return beams;
}

}  // namespace

world::SensorFrame obstacle_frame(Scene& scene,
                                  const world::TickView& tick,
                                  const world::SensorSpec& spec) {
    const Mount mount(tick, spec, scene.origin());
    const std::uint32_t hidden = mount.hidden();
    scene.place(tick, std::span(&hidden, hidden != 0 ? 1U : 0U));
    const std::vector<Beam> beams = tube(mount.pose(), world::attribute(spec, "hit_radius"));
    std::vector<Echo> echoes(beams.size());
    find_echoes(
        scene, beams, world::attribute(spec, "distance"), scene.mask_hiding(hidden), echoes);
    const bool actors_only = world::attribute(spec, "only_dynamics") >= 0.5;
    const Echo* nearest = nullptr;
    for (const Echo& echo : echoes)
        if (echo && (!actors_only || echo.instance->actor != 0) &&
            (nearest == nullptr || echo.distance < nearest->distance))
            nearest = &echo;

    if (nearest == nullptr)
        return point_frame(tick, spec, {});
    const std::uint32_t words[] = {
        nearest->instance->actor,
        std::bit_cast<std::uint32_t>(static_cast<float>(nearest->distance))};
    return point_frame(tick, spec, words);
}

}  // namespace reprise::render
