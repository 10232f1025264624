// What it must do: turn the primary hits into light, in about 0.2 s for 800 x 600 on two cores.
// What it assumes: hits are final; Scene, Sky and beams do not change meanwhile.
// How it goes, tiles in parallel, each stage of one as soon as its neighbours are past the last:
//   1. light: at each hit the look, one ray to the sun, two short ones into the sky's half sphere,
//   and
//      a mirror ray where the surface is glossy. Directions change in a fixed pattern of 4 x 4
//      pixels.
//   2. combine: the mean over 4 x 4 neighbours on the same surface has seen all the pattern's
//      directions, so that little noise is left (interleaved sampling: Keller and Heidrich, 2001).
//   3. refine: pixels on edges are taken again as the mean of two places inside, or of four
//      where the two differ.
// By night the light of lamps and the moon comes in between, see lamp_light.h: one more ray at a
// hit instead of the sun's; and lamps glare.
// What it keeps: nothing.
#include <algorithm>
#include <cmath>

#include <xmmintrin.h>

#include "render/shade/shading_job.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// Does the place of one thing lie where the other's surface goes on?
bool on_same_surface(const RawLight& own, const RawLight& other) {
    // Legs, poles and tyres have twelve sides or more: 30 degrees are still round, 40 are not.
    constexpr float round = 0.82F;
    return other.flat.dot(own.flat) >= round &&
           std::abs((other.position - own.position).dot(own.flat)) <= own.tolerance;
}

/// Of which of a pixel's shares its rays knew: sun, sky, the strongest lamp, the rest.
__m128 answers(int x, int y) {
    return ((x + y) & 1) == 0 ? _mm_setr_ps(1, 1, 1, 0) : _mm_setr_ps(1, 1, 0, 1);
}

/// `among_lamps`: by day nobody asks for lamps, and no answers are told apart.
template <bool among_lamps>
Light filtered(const ShadingJob& job, const TileBlock& tiles, const Eigen::Vector2i& pixel) {
    const Frame& frame = job.frame;
    const RawLight& own = tiles.middle().lights[tile_place(pixel.x(), pixel.y())];
    const Hit& hit = job.hits[frame.index(pixel.x(), pixel.y())];
    Color reflected = Color::Zero();
    // Pixels answer for the strongest lamp or for the rest, see LampLight: each has its own mean.
    __m128 shares = _mm_setzero_ps();
    __m128 counts = _mm_setzero_ps();
    float count = 0;
    const int left = std::max(0, pixel.x() - 2);
    const int right = std::min(frame.width - 1, pixel.x() + 1);
    const int low = std::max(0, pixel.y() - 2);
    const int high = std::min(frame.height - 1, pixel.y() + 1);
    for (int y = low; y <= high; ++y) {
        for (int x = left; x <= right; ++x) {
            const RawLight& other = tiles.pixels(x, y).lights[tile_place(x, y)];
            const Hit& other_hit = job.hits[frame.index(x, y)];
            if (other_hit.instance != hit.instance ||
                (other_hit.triangle != hit.triangle && !on_same_surface(own, other)))
                continue;
            const __m128 its = _mm_loadu_ps(&other.light.sun_visibility);
            if constexpr (among_lamps) {
                const __m128 counted = answers(x, y);
                shares += counted * its;
                counts += counted;
            } else {
                shares += its;
            }
            // Single bright spots would leave squares.
            reflected += other.light.reflected;
            count += 1;
        }
    }
    Light mean{reflected / count};
    if constexpr (!among_lamps) {
        _mm_storeu_ps(&mean.sun_visibility, shares / _mm_set1_ps(count));
        return mean;
    }
    _mm_storeu_ps(&mean.sun_visibility, shares / _mm_max_ps(counts, _mm_set1_ps(1)));
    // A place whose neighbours all asked for the other has that one's answer.
    if (_mm_cvtss_f32(_mm_shuffle_ps(counts, counts, 2)) == 0)
        mean.lamp_visibility = mean.rest_visibility;
    if (_mm_cvtss_f32(_mm_shuffle_ps(counts, counts, 3)) == 0)
        mean.rest_visibility = mean.lamp_visibility;
    return mean;
}

}  // namespace

void combine_tile(ShadingJob& job, const Eigen::Vector2i& corner) {
    Frame& frame = job.frame;
    const TileBlock tiles(job, corner);
    TilePixels& own = tiles.middle();
    for (int i = 0; i < tile * tile; ++i) {
        const Eigen::Vector2i pixel = corner + tile_pixel(i);
        if (!job.contains(pixel))
            continue;
        job.look_ahead(corner, i + block, [&](std::size_t next) {
            prefetch(&frame.colors[next]);
            prefetch(&frame.tones[next]);
            prefetch(&job.hits[next]);
            const Eigen::Vector2i there = tile_pixel(i + block);
            const std::size_t place = tile_place(there.x(), there.y());
            prefetch(&own.lights[place]);
            prefetch(&own.samples[place].look);
            prefetch(&own.samples[place].light);
        });
        const std::size_t index = frame.index(pixel.x(), pixel.y());
        const Vector3f direction = job.camera.ray(pixel.x() + 0.5, pixel.y() + 0.5).cast<float>();
        Color color;
        const Hit& hit = job.hits[index];
        if (hit.instance == no_instance) {
            color = sky_color(job, direction);
        } else {
            const std::size_t place = tile_place(pixel.x(), pixel.y());
            Sample& sample = own.samples[place];
            sample.light = job.lamps_matter ? filtered<true>(job, tiles, pixel)
                                            : filtered<false>(job, tiles, pixel);
            const float length = direction.norm();
            const Vector3f view = direction / length;
            color = outgoing_radiance(job.input,
                                      sample.look,
                                      sample.light,
                                      job.lamps_matter ? own.lamps[place] : LampLight(),
                                      view);
            color = through_atmosphere(job.input.sky, color, job.eye, view, hit.distance * length);
        }
        frame.colors[index] = color * job.input.sky.exposure();
        frame.tones[index] = tone_of(frame.colors[index]);
    }
}

void shade(const ShadingInput& input,
           const Camera& camera,
           std::uint32_t mask,
           const std::vector<Hit>& hits,
           Frame& frame) {
    frame.width = camera.width();
    frame.height = camera.height();
    frame.colors.resize(hits.size());
    frame.tones.resize(hits.size());
    const Vector3f eye = camera.position().cast<float>();
    const float ambient = luminance(input.sky.ambient(Vector3f::UnitZ()));
    ShadingJob job{input,
                   camera,
                   mask,
                   hits,
                   frame,
                   {},
                   SourceGrid(find_sources(input, eye), eye),
                   false,
                   eye,
                   static_cast<float>(camera.pixel()),
                   sun_directions(input.sky),
                   luminance(input.sky.sun()) / pi > 0.01F * ambient};
    job.lamps_matter = !job.sources.empty() || input.sky.moon().light.maxCoeff() > 0;
    // A tile's next stage comes as soon as its neighbours are so far: what they wrote is still in
    // the cache.
    TileStage lit(camera);
    TileStage combined(camera);
    TileStage refined(camera);
    job.tiles.resize(lit.tiles());
    frame.pool.recall();
    for_tiles(camera, [&](const Eigen::Vector2i& first) {
        job.pixels(first) = frame.pool.take();
        light_tile(job, first);
        lit.finish(first, [&](const Eigen::Vector2i& second) {
            combine_tile(job, second);
            combined.finish(second, [&](const Eigen::Vector2i& third) {
                refine_tile(job, third);
                refined.finish(third, [&](const Eigen::Vector2i& done) {
                    frame.pool.give_back(job.pixels(done));
                });
            });
        });
    });
}

}  // namespace reprise::render
