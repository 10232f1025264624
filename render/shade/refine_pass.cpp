#include <algorithm>
#include <array>
#include <cmath>

#include <xmmintrin.h>

#include "render/shade/shading_job.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

// Of a pixel, no two in one row or column (rotated grid); the first two lie across its middle.
constexpr std::array<std::array<double, 2>, 4> subpixel_offsets{
    {{.375, .125}, {.625, .875}, {.875, .375}, {.125, .625}}};
constexpr std::size_t pair = 2;
constexpr float even = 0.045F;       ///< [tone] steps that nobody sees as stairs
constexpr float least_step = 0.01F;  ///< [tone] between two things

bool is_edge(const ShadingJob& job, int x, int y) {
    const Frame& frame = job.frame;
    const std::size_t index = frame.index(x, y);
    const std::uint32_t own = job.hits[index].instance;
    const float tone = frame.tones[index];
    const auto row = static_cast<std::size_t>(frame.width);
    const std::array<std::size_t, 4> sides{x > 0 ? index - 1 : index,
                                           x + 1 < frame.width ? index + 1 : index,
                                           y > 0 ? index - row : index,
                                           y + 1 < frame.height ? index + row : index};
    const __m128 around = _mm_setr_ps(
        frame.tones[sides[0]], frame.tones[sides[1]], frame.tones[sides[2]], frame.tones[sides[3]]);
    const __m128 steps = _mm_andnot_ps(_mm_set1_ps(-0.0F), around - _mm_set1_ps(tone));
    const auto above = [&](float step) {
        return _mm_movemask_ps(_mm_cmpgt_ps(steps, _mm_set1_ps(step)));
    };
    if (above(2 * even) != 0)
        return true;
    // Smaller steps only count where another thing begins: before the sky they are its own.
    const int steep = above(own != no_instance ? least_step : even);
    for (unsigned side = 0; side < 4 && steep != 0; ++side)
        if ((steep >> side & 1) != 0 && own != job.hits[sides[side]].instance)
            return true;
    return false;
}

/// The neighbour that lies on the same thing, closest to the place: for the light that arrived
/// there.
struct Neighbour {
    Neighbour(const ShadingJob& job,
              const TileBlock& tiles,
              const Eigen::Vector2i& pixel,
              const Hit& hit,
              const Surface& at) {
        const Frame& frame = job.frame;
        float least = infinite;
        float farthest = infinite;  // squared
        for (int i = 0; i < 9; ++i) {
            const int x = std::clamp(pixel.x() + i % 3 - 1, 0, frame.width - 1);
            const int y = std::clamp(pixel.y() + i / 3 - 1, 0, frame.height - 1);
            if (job.hits[frame.index(x, y)].instance != hit.instance)
                continue;
            const std::size_t next = tile_place(x, y);
            const RawLight& raw = tiles.pixels(x, y).lights[next];
            const float squared = (raw.position - at.position).squaredNorm();
            // Farther than the closest so far, however it is turned: no root is needed.
            if (squared > farthest)
                continue;
            const float turned = 1 - raw.flat.dot(at.flat);
            const float away = std::sqrt(squared) + turned * at.distance * 0.01F;
            if (away < least) {
                least = away;
                farthest = 1.01F * away * away;
                pixels = &tiles.pixels(x, y);
                place = next;
                flush = turned < 0.02F && away < raw.tolerance;
            }
        }
    }

    const TilePixels* pixels = nullptr;  ///< of its tile; null: there is none
    std::size_t place = 0;               ///< there
    bool flush = false;                  ///< on the same plane, and near: lamps give both the same
};

/// What a ray through a part of a pixel hit, and how it is lit.
struct SubpixelSample {
    Hit hit;
    Surface surface;
    Look look;
    Light light;
    LampLight lamps;
};

/// Pixels of a tile whose colour is a mean of several places.
struct Refined {
    std::size_t index;  ///< in the frame
    Color sum = Color::Zero();
    float weights = 0;

    void add(const Color& color) {
        // Weighted against the brightness, so that one bright place does not bring back stairs.
        const float weight = 1 / (1 + luminance(color));
        sum += color * weight;
        weights += weight;
    }
};

/// Of four pixels in a row, bit by bit, those that may be edges: most of a picture is even.
unsigned uneven_of_four(const Frame& frame, int x, int y) {
    if (x == 0 || y == 0 || x + 4 >= frame.width || y + 1 >= frame.height)
        return 15;
    const float* tones = &frame.tones[frame.index(x, y)];
    const __m128 own = _mm_loadu_ps(tones);
    const auto step = [&](std::ptrdiff_t to) {
        return _mm_andnot_ps(_mm_set1_ps(-0.0F), _mm_loadu_ps(tones + to) - own);
    };
    const __m128 steps = _mm_max_ps(_mm_max_ps(step(-1), step(1)),
                                    _mm_max_ps(step(-frame.width), step(frame.width)));
    return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpgt_ps(steps, _mm_set1_ps(least_step))));
}

std::vector<Refined> edges_of(const ShadingJob& job, const Eigen::Vector2i& corner) {
    std::vector<Refined> found;
    for (int i = 0; i < tile * tile; i += 4) {
        const Eigen::Vector2i first = corner + tile_pixel(i);
        if (!job.contains(first))
            continue;
        const unsigned uneven = uneven_of_four(job.frame, first.x(), first.y());
        for (int x = first.x(); x < std::min(first.x() + 4, job.frame.width); ++x)
            if ((uneven >> (x - first.x()) & 1) != 0 && is_edge(job, x, first.y()))
                found.push_back({job.frame.index(x, first.y())});
    }
    return found;
}

/// Two rays a pixel, from the subpixel `first` on.
void add_subpixel_rays(const ShadingJob& job,
                       const std::vector<Refined>& pixels,
                       std::size_t first,
                       RayBatch& batch) {
    batch.clear();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const auto owner = static_cast<int>(pixels[i].index);
        const int x = owner % job.frame.width;
        const int y = owner / job.frame.width;
        for (std::size_t k = first; k < first + pair; ++k)
            batch.add(job.eye,
                      job.camera.ray(x + subpixel_offsets[k][0], y + subpixel_offsets[k][1])
                          .cast<float>(),
                      infinite,
                      job.mask,
                      i);
    }
}

/// Who asks for the light at this pixel soon would wait for memory.
void expect_light(const ShadingJob& job, const TileBlock& tiles, std::size_t index) {
    const auto owner = static_cast<int>(index);
    const std::size_t place = tile_place(owner % job.frame.width, owner / job.frame.width);
    prefetch(&tiles.middle().lights[place]);
    prefetch(&tiles.middle().samples[place].light);
}

void light_subpixel(const ShadingJob& job,
                    const TileBlock& tiles,
                    const Eigen::Vector2i& pixel,
                    NearSources& near,
                    SubpixelSample& sample) {
    const Surface& at = sample.surface;
    const Neighbour neighbour(job, tiles, pixel, sample.hit, at);
    sample.light = neighbour.pixels != nullptr ? neighbour.pixels->samples[neighbour.place].light
                                               : Light{Color::Zero(), 0, 0.8F, 0.8F, 0.8F};
    sample.lamps = {};
    if (!job.lamps_matter)
        return;
    sample.lamps = neighbour.flush
                       ? neighbour.pixels->lamps[neighbour.place]
                       : LampSum(job.input, near, sample.look, at.position, at.view).light();
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

/// Adds two places of each pixel; of `pixels` those stay of which the two differ.
void add_pair(ShadingJob& job,
              const TileBlock& tiles,
              std::size_t first,
              std::vector<Refined>& pixels) {
    Frame& frame = job.frame;
    thread_local TileRays rays;
    thread_local RayBatch batch;
    thread_local std::array<SubpixelSample, RayBatch::most> samples;
    rays.sun.clear();
    add_subpixel_rays(job, pixels, first, batch);
    const std::span<const Ray> primary = batch.rays();
    trace_nearest(job.input.scene, primary, true, std::span(rays.hits).first(primary.size()));
    Surfaces surfaces(job.input.scene, job.eye, job.pixel * 0.6F);
    NearSources near(job.sources);
    constexpr std::size_t soon = 3;
    for (std::size_t i = 0; i < primary.size(); ++i) {
        SubpixelSample& sample = samples[i];
        if (i + 2 * soon < primary.size())
            surfaces.expect(rays.hits[i + 2 * soon]);
        if (i + soon < primary.size()) {
            surfaces.expect_corners(rays.hits[i + soon]);
            expect_light(job, tiles, pixels[batch.owner(i + soon)].index);
        }
        sample.hit = rays.hits[i];
        if (sample.hit.instance == no_instance)
            continue;
        make_in(sample.surface, [&] { return surfaces.at(sample.hit, primary[i].direction); });
        expose(job.input, sample.surface);
        make_in(sample.look, [&] { return shade_surface(job.input, sample.surface); });
        const auto owner = static_cast<int>(pixels[batch.owner(i)].index);
        light_subpixel(job, tiles, {owner % frame.width, owner / frame.width}, near, sample);
        // What looks away from the sun gets nothing of it, whatever is between.
        const bool faces = sample.look.normal.dot(job.input.sky.to_sun()) > 0;
        if (!job.sun_matters || (!faces && sample.look.translucency <= 0))
            continue;
        const Vector3f origin =
            offset_origin(sample.surface.position, sample.surface.flat, sample.surface.distance);
        const Vector3f direction = sun_direction(job, static_cast<int>((2 * i + first) % 16));
        rays.sun.add(origin, direction, infinite, job.mask & ~marking_bit, i);
    }
    trace_batch(job, rays, rays.sun, true, [&](std::size_t owner, bool visible) {
        samples[owner].light.sun_visibility =
            visible ? job.input.sky.clouds().sunlight(samples[owner].surface.position) : 0.0F;
    });
    std::vector<Refined> uneven;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const SubpixelSample& one = samples[pair * i];
        const SubpixelSample& other = samples[pair * i + 1];
        const Color first_color = color_of(job, primary[pair * i], one);
        const Color second_color = color_of(job, primary[pair * i + 1], other);
        Refined& pixel = pixels[i];
        pixel.add(first_color);
        pixel.add(second_color);
        const float step = std::abs(tone_of(first_color) - tone_of(second_color));
        const float own = frame.tones[pixel.index];
        const float away = std::abs(tone_of(first_color) - own);
        if (one.hit.instance != other.hit.instance || std::max(step, away) > 2 * even)
            uneven.push_back(pixel);
        else
            frame.colors[pixel.index] = pixel.sum / pixel.weights;
    }
    pixels.swap(uneven);
}

}  // namespace

void refine_tile(ShadingJob& job, const Eigen::Vector2i& corner) {
    std::vector<Refined> pixels = edges_of(job, corner);
    if (pixels.empty())
        return;
    const TileBlock tiles(job, corner);
    add_pair(job, tiles, 0, pixels);
    if (pixels.empty())
        return;
    add_pair(job, tiles, pair, pixels);
    for (const Refined& pixel : pixels)
        job.frame.colors[pixel.index] = pixel.sum / pixel.weights;
}

}  // namespace reprise::render
