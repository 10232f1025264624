#include <algorithm>
#include <array>
#include <cmath>

#include <emmintrin.h>

#include "render/shade/shading_job.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr int square_side = 4;  ///< of the square of pixels whose mean one gets [px]
constexpr int lead = 2;         ///< so many of them to its left, and above [px]
constexpr std::size_t window_side = tile + square_side - 1;

/// What the pixels of a tile and those around it have met, in rows: four neighbours at once.
class Window {
  public:
    Window(const ShadingJob& job, const TileBlock& tiles, const Eigen::Vector2i& corner)
        : corner_(corner.array() - lead) {
        const Frame& frame = job.frame;
        for (std::size_t i = 0; i < window_side * window_side; ++i) {
            const int x = corner_.x() + static_cast<int>(i % window_side);
            const int y = corner_.y() + static_cast<int>(i / window_side);
            // Beyond the picture lies what no surface is.
            instances_[i] = no_instance;
            if (x < 0 || y < 0 || x >= frame.width || y >= frame.height)
                continue;
            const Hit& hit = job.hits[frame.index(x, y)];
            instances_[i] = hit.instance;
            triangles_[i] = hit.triangle;
            lights_[i] = &tiles.pixels(x, y).lights[tile_place(x, y)];
        }
    }

    /// Where the pixel's square begins.
    std::size_t square(const Eigen::Vector2i& pixel) const {
        return static_cast<std::size_t>(pixel.y() - lead - corner_.y()) * window_side +
               static_cast<std::size_t>(pixel.x() - lead - corner_.x());
    }

    /// Of four from one on: bit by bit, which are of that instance.
    unsigned of_instance(std::size_t first, std::uint32_t instance) const {
        return equal(&instances_[first], instance);
    }

    unsigned of_triangle(std::size_t first, std::uint32_t triangle) const {
        return equal(&triangles_[first], triangle);
    }

    const RawLight& light(std::size_t i) const { return *lights_[i]; }

  private:
    static unsigned equal(const std::uint32_t* four, std::uint32_t number) {
        const __m128i them = _mm_loadu_si128(reinterpret_cast<const __m128i*>(four));
        const __m128i same = _mm_cmpeq_epi32(them, _mm_set1_epi32(static_cast<int>(number)));
        return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(same)));
    }

    Eigen::Vector2i corner_;
    std::array<std::uint32_t, window_side * window_side> instances_;
    std::array<std::uint32_t, window_side * window_side> triangles_{};
    std::array<const RawLight*, window_side * window_side> lights_;
};

/// Does the place of one thing lie where the other's surface goes on?
bool on_same_surface(const RawLight& own, const RawLight& other) {
    // Legs, poles and tyres have twelve sides or more: 30 degrees are still round, 40 are not.
    constexpr float round = 0.82F;
    return other.flat.dot(own.flat) >= round &&
           std::abs((other.position - own.position).dot(own.flat)) <= own.tolerance;
}

/// The mean over the square around a pixel. `among_lamps`: by day nobody asks for lamps, and no
/// answers are told apart.
template <bool among_lamps>
Light filtered(const Window& window, const Hit& hit, const Eigen::Vector2i& pixel) {
    const std::size_t square = window.square(pixel);
    const RawLight& own = window.light(square + lead * window_side + lead);
    Color reflected = Color::Zero();
    // Pixels answer for the strongest lamp or for the rest, see LampLight: each has its own mean.
    __m128 shares = _mm_setzero_ps();
    __m128 counts = _mm_setzero_ps();
    float count = 0;
    const auto add = [&](const RawLight& other) {
        const __m128 its = _mm_loadu_ps(&other.light.sun_visibility);
        if constexpr (among_lamps) {
            const __m128 asked = _mm_cmpge_ps(its, _mm_setzero_ps());
            shares += _mm_and_ps(asked, its);
            counts += _mm_and_ps(asked, _mm_set1_ps(1));
        } else {
            shares += its;
        }
        // Single bright spots would leave squares.
        reflected += other.light.reflected;
        count += 1;
    };
    for (unsigned y = 0; y < square_side; ++y) {
        const std::size_t row = square + y * window_side;
        const unsigned near = window.of_instance(row, hit.instance);
        const unsigned same = near & window.of_triangle(row, hit.triangle);
        for (unsigned x = 0; x < square_side; ++x)
            if ((same >> x & 1) != 0 ||
                ((near >> x & 1) != 0 && on_same_surface(own, window.light(row + x))))
                add(window.light(row + x));
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
    const Window window(job, tiles, corner);
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
            sample.light = job.lamps_matter ? filtered<true>(window, hit, pixel)
                                            : filtered<false>(window, hit, pixel);
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

}  // namespace reprise::render
