#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "render/scene/scene.h"
#include "render/trace/camera.h"
#include "render/trace/ray.h"

namespace reprise::render {

/// Nearest hits, in packets of 8. `hits` has the size of `rays`.
void trace_nearest(const Scene& scene,
                   std::span<const Ray> rays,
                   bool coherent,
                   std::span<Hit> hits);

/// Shadow rays: 1 where nothing is hit up to Ray::far, 0 where something is. `coherent`: neighbours
/// run alike, as to the sun. It changes the time that it takes, and for some rays in a million that
/// graze an edge what is found: part of what a picture is.
void trace_visibility(const Scene& scene,
                      std::span<const Ray> rays,
                      bool coherent,
                      std::span<std::uint8_t> visible);

/// A triangle of an instance in the scene's frame: a corner, and the sides from there.
struct PlacedTriangle {
    PlacedTriangle(const Instance& instance, std::uint32_t triangle);

    Eigen::Vector3d a, to_b, to_c;
};

/// What each pixel of the camera sees, by rows; distances are depths. Runs on TBB.
void trace_primary(const Scene& scene,
                   const Camera& camera,
                   std::uint32_t mask,
                   std::vector<Hit>& hits);

/// Side of the square tiles that tasks work on. [px]
inline constexpr int tile = 16;

/// The i-th pixel of a tile, in blocks of 4 x 2 pixels: a packet of rays close together.
inline Eigen::Vector2i tile_pixel(int i) {
    const int block = i / 8;
    const int inside = i % 8;
    return {(block % (tile / 4)) * 4 + inside % 4, (block / (tile / 4)) * 2 + inside / 4};
}

}  // namespace reprise::render
