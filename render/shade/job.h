#pragma once

#include <functional>
#include <vector>

#include "render/shade/frame.h"

namespace reprise::render {

struct Axes {
    explicit Axes(const Eigen::Vector3f& z_axis)
        : x(z_axis.unitOrthogonal()),
          y(z_axis.cross(x)),
          z(z_axis) {}

    Eigen::Vector3f apply(const Eigen::Vector3f& v) const {
        return v.x() * x + v.y() * y + v.z() * z;
    }

    Eigen::Vector3f x, y, z;
};

/// Everything that the stages of shade() share.
struct Job {
    const Stage& stage;
    const Camera& camera;
    std::uint32_t mask;
    const std::vector<Hit>& hits;
    Frame& frame;
    std::vector<Beam> beams;
    Eigen::Vector3f eye;
    float pixel;
    Axes sun_axes;
    bool sun_matters;

    bool holds(const Eigen::Vector2i& at) const {
        return at.x() < camera.width() && at.y() < camera.height();
    }
};

/// Runs `work(upper left pixel)` for each tile, in parallel.
void for_tiles(const Camera& camera,
               const std::function<void(const Eigen::Vector2i& corner)>& work);

/// Rays of a tile, and where their answers go.
struct Batch {
    std::vector<Ray> rays;
    std::vector<std::size_t> owners;

    void clear() {
        rays.clear();
        owners.clear();
    }

    void add(const Ray& ray, std::size_t owner) {
        rays.push_back(ray);
        owners.push_back(owner);
    }
};

struct Batches {
    Batch sun, sky, mirror;
    std::vector<std::uint8_t> free;
    std::vector<Hit> hits;
};

/// Traces a batch's rays and gives each owner whether its way was free.
template <typename Give>
void answer_free(const Job& job, Batches& batches, const Batch& batch, const Give& give) {
    batches.free.resize(batch.rays.size());
    find_free(job.stage.scene, batch.rays, batches.free);
    for (std::size_t i = 0; i < batch.rays.size(); ++i)
        give(batch.owners[i], batches.free[i] != 0);
}

/// A point on the unit disc, and a direction of the half sphere around z, closer to z more often.
/// The first 16 are the pattern that 4 x 4 neighbouring pixels share among them; 32 in all.
const Eigen::Vector2f& disc_point(int place);
const Eigen::Vector3f& sky_direction(int place);

/// A little off the surface, so that rays do not meet what they start from.
Eigen::Vector3f lifted(const Eigen::Vector3f& position,
                       const Eigen::Vector3f& flat,
                       float distance);

/// To a place on the sun's disc.
Ray sun_ray(const Job& job, const Eigen::Vector3f& origin, int place);

/// Radiance of the sky behind a pixel, with haze.
Color sky_color(const Job& job, const Eigen::Vector3f& direction);

// The stages, for the tile at `corner`.
void light_tile(Job& job, const Eigen::Vector2i& corner);
void combine_tile(Job& job, const Eigen::Vector2i& corner);
void mark_edges(const Job& job, const Eigen::Vector2i& corner, std::vector<std::uint8_t>& edges);
void refine_tile(Job& job, const Eigen::Vector2i& corner, const std::vector<std::uint8_t>& edges);

}  // namespace reprise::render
