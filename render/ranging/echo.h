#pragma once

#include <limits>
#include <span>
#include <vector>

#include "render/scene/scene.h"
#include "render/trace/ray.h"

namespace reprise::render {

/// A straight line into the scene, in the scene's frame.
struct Beam {
    Eigen::Vector3d origin;
    Eigen::Vector3d direction;  ///< unit vector
};

/// Where a beam ended.
struct Echo {
    Hit hit;  ///< without an instance: nowhere
    const Instance* instance = nullptr;
    double distance = std::numeric_limits<double>::infinity();  ///< [m]
    float cosine = 0;  ///< of the angle between beam and normal

    explicit operator bool() const { return instance != nullptr; }
};

/// What beams meet up to `range`, in packets of 8 neighbours: those that run alike take a third
/// of the time of others. `mask`: see Scene::mask_hiding. `echoes` has the size of `beams`.
/// Distances come in double precision from the triangles themselves.
void find_echoes(const Scene& scene,
                 std::span<const Beam> beams,
                 double range,
                 std::uint32_t mask,
                 std::span<Echo> echoes);

/// Of the surface that ended the beam: a unit vector towards the sensor.
Eigen::Vector3d normal_of(const Echo& echo, const Beam& beam);

}  // namespace reprise::render
