#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "render/shade/shading_job.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr std::size_t subpixels = 4;  // of a pixel, no two in one row or column (rotated grid)
constexpr std::array<std::array<double, 2>, subpixels> subpixel_offsets{
    {{.375, .125}, {.875, .375}, {.625, .875}, {.125, .625}}};

bool is_edge(const Frame& frame, int x, int y) {
    const std::size_t index = frame.index(x, y);
    const RawLight& own = frame.lights[index];
    const float tone = frame.tones[index];
    constexpr std::array<std::array<int, 2>, 4> sides{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    for (const auto& side : sides) {
        const int i = std::clamp(x + side[0], 0, frame.width - 1);
        const int j = std::clamp(y + side[1], 0, frame.height - 1);
        const std::size_t next = frame.index(i, j);
        const float step = std::abs(frame.tones[next] - tone);
        if (step > 0.045F)
            return true;
        if (step > 0.01F && own.instance != no_instance &&
            own.instance != frame.lights[next].instance)
            return true;
    }
    return false;
}

/// The neighbour that lies on the same thing, closest to the place: for the light that arrived
/// there.
struct Neighbour {
    Neighbour(const Frame& frame, const Eigen::Vector2i& pixel, const Hit& hit, const Surface& at) {
        float least = infinite;
        for (int i = 0; i < 9; ++i) {
            const int x = std::clamp(pixel.x() + i % 3 - 1, 0, frame.width - 1);
            const int y = std::clamp(pixel.y() + i / 3 - 1, 0, frame.height - 1);
            const std::size_t next = frame.index(x, y);
            const RawLight& raw = frame.lights[next];
            if (raw.instance != hit.instance)
                continue;
            const float turned = 1 - raw.flat.dot(at.flat);
            const float away = (raw.position - at.position).norm() + turned * at.distance * 0.01F;
            if (away < least) {
                least = away;
                index = next;
                flush = turned < 0.02F && away < raw.tolerance;
            }
        }
        found = least < infinite;
    }

    std::size_t index = 0;
    bool found = false;
    bool flush = false;  ///< on the same plane, and near: lamps give both the same
};

/// What a ray through a part of a pixel hit, and how it is lit.
struct SubpixelSample {
    Hit hit;
    Surface surface;
    Look look;
    Light light;
    LampLight lamps;
};

RayBatch subpixel_rays(const ShadingJob& job,
                       const Eigen::Vector2i& corner,
                       const std::vector<std::uint8_t>& edges) {
    RayBatch batch;
    for (int i = 0; i < tile * tile; ++i) {
        const Eigen::Vector2i pixel = corner + tile_pixel(i);
        if (!job.contains(pixel) || edges[job.frame.index(pixel.x(), pixel.y())] == 0)
            continue;
        for (const auto& at : subpixel_offsets)
            batch.add({job.eye,
                       job.camera.ray(pixel.x() + at[0], pixel.y() + at[1]).cast<float>(),
                       infinite,
                       job.mask},
                      job.frame.index(pixel.x(), pixel.y()));
    }
    return batch;
}

void light_subpixel(const ShadingJob& job, const Eigen::Vector2i& pixel, SubpixelSample& sample) {
    const Surface& at = sample.surface;
    const Neighbour neighbour(job.frame, pixel, sample.hit, at);
    sample.light = neighbour.found ? job.frame.samples[neighbour.index].light
                                   : Light{0, 0.8F, Color::Zero(), 0.8F};
    if (!job.lamps_matter)
        return;
    sample.lamps = neighbour.flush
                       ? job.frame.lamps[neighbour.index]
                       : LampSum(job.input, job.sources, sample.look, at.position, at.view).light();
}

Color color_of(const ShadingJob& job, const Ray& ray, const SubpixelSample& sample) {
    Color color;
    if (sample.hit.instance == no_instance) {
        color = sky_color(job, ray.direction);
    } else {
        const Surface& at = sample.surface;
        color = outgoing_radiance(job.input, sample.look, sample.light, sample.lamps, at.view);
        color = through_atmosphere(job.input.sky, color, ray.origin, at.view, at.distance);
    }
    return color * job.input.sky.exposure();
}

}  // namespace

void mark_edges(const ShadingJob& job,
                const Eigen::Vector2i& corner,
                std::vector<std::uint8_t>& edges) {
    for (int i = 0; i < tile * tile; ++i) {
        const Eigen::Vector2i pixel = corner + tile_pixel(i);
        if (job.contains(pixel))
            edges[job.frame.index(pixel.x(), pixel.y())] =
                static_cast<std::uint8_t>(is_edge(job.frame, pixel.x(), pixel.y()));
    }
}

void refine_tile(ShadingJob& job,
                 const Eigen::Vector2i& corner,
                 const std::vector<std::uint8_t>& edges) {
    Frame& frame = job.frame;
    const RayBatch primary = subpixel_rays(job, corner, edges);
    if (primary.rays.empty())
        return;
    thread_local TileRays rays;
    thread_local std::vector<SubpixelSample> samples;
    rays.sun.clear();
    rays.hits.resize(primary.rays.size());
    trace_nearest(job.input.scene, primary.rays, true, rays.hits);
    samples.assign(primary.rays.size(), {});
    for (std::size_t i = 0; i < samples.size(); ++i) {
        SubpixelSample& sample = samples[i];
        sample.hit = rays.hits[i];
        if (sample.hit.instance == no_instance)
            continue;
        sample.surface = surface_at(
            job.input.scene, sample.hit, job.eye, primary.rays[i].direction, job.pixel * 0.6F);
        expose(job.input, sample.surface);
        sample.look = shade_surface(job.input, sample.surface);
        const auto owner = static_cast<int>(primary.owners[i]);
        light_subpixel(job, {owner % frame.width, owner / frame.width}, sample);
        if (!job.sun_matters)
            continue;
        const Vector3f origin =
            offset_origin(sample.surface.position, sample.surface.flat, sample.surface.distance);
        rays.sun.add(sun_ray(job, origin, static_cast<int>(i % 16)), i);
    }
    trace_batch(job, rays, rays.sun, true, [&](std::size_t owner, bool visible) {
        samples[owner].light.sun_visibility =
            visible ? job.input.sky.clouds().sunlight(samples[owner].surface.position) : 0.0F;
    });
    for (std::size_t i = 0; i < samples.size(); i += subpixels) {
        Color sum = Color::Zero();
        float weights = 0;
        for (std::size_t k = i; k < i + subpixels; ++k) {
            const Color color = color_of(job, primary.rays[k], samples[k]);
            // Weighted against the brightness, so that one bright place does not bring back stairs.
            const float weight = 1 / (1 + luminance(color));
            sum += color * weight;
            weights += weight;
        }
        frame.colors[primary.owners[i]] = sum / weights;
    }
}

}  // namespace reprise::render
