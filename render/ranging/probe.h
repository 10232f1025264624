#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "world/external/sensor.h"
#include "world/tick.h"

namespace reprise::render {

/// A question of somebody's own sensor: what is there, along a straight line?
struct Probe {
    Eigen::Vector3d origin;     ///< world
    Eigen::Vector3d direction;  ///< world; need not be a unit vector
};

/// And its answer.
struct ProbeEcho {
    double distance = std::numeric_limits<double>::infinity();  ///< [m]; infinity: nothing there
    std::uint32_t actor = 0;                                    ///< 0: the town
    world::SemanticClass label = world::SemanticClass::sky;
    Eigen::Vector3d normal{0, 0, 0};    ///< of the surface, towards the origin; world
    Eigen::Vector3d velocity{0, 0, 0};  ///< [m/s] of the place that was met; world
    float reflectivity = 0;             ///< of light of 905 nm, met straight on; dry
    float cross_section = 0;            ///< of waves of 77 GHz, of each square metre across the ray
};

class Scene;

/// One for each probe, of what is nearer than `range`. The scene is placed.
std::vector<ProbeEcho> probe_scene(const Scene& scene,
                                   const world::TickView& tick,
                                   std::span<const Probe> probes,
                                   double range,
                                   std::uint32_t mask);

}  // namespace reprise::render
