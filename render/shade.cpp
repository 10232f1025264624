// What it must do: turn the primary hits into light, in about 0.2 s for 800 x 600 on two cores.
// What it assumes: hits are final; Scene, Sky and beams do not change meanwhile.
// How it goes, each stage over all tiles in parallel:
//   1. light: at each hit the look, one ray to the sun, two short ones into the sky's half sphere,
//   and
//      a mirror ray where the surface is glossy. Directions change in a fixed pattern of 4 x 4
//      pixels.
//   2. combine: the mean over 4 x 4 neighbours on the same surface has seen all the pattern's
//      directions, so that little noise is left (interleaved sampling: Keller and Heidrich, 2001).
//   3. refine: pixels on edges are taken again as the mean of four places inside the pixel.
// What it keeps: nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tbb/parallel_for.h>

#include "render/frame.h"
#include "render/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float near_things = 2.4F;  // [m] how far things hide the sky from each other
constexpr float mirror_reach = 150;  // [m]
constexpr std::uint32_t all_but_paint = ~marking_bit;
constexpr float infinite = std::numeric_limits<float>::infinity();

/// One of 16 places in the pattern; 4 x 4 neighbours have all of them (Bayer's order).
int pattern(int x, int y) {
    static constexpr std::array<int, 16> order{
        0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    return order[static_cast<std::size_t>((y & 3) * 4 + (x & 3))];
}

/// Roberts' R2 sequence: evenly spread points of the unit square.
Vector2f spread(int i) {
    const auto n = static_cast<float>(i) + 0.5F;
    return {fraction(n * 0.7548777F), fraction(n * 0.5698403F)};
}

struct Tables {
    Tables() {
        for (int i = 0; i < 32; ++i) {
            const Vector2f at = spread(i);
            const double angle = 2 * M_PI * static_cast<double>(at.x());
            const Vector2f way(static_cast<float>(std::cos(angle)),
                               static_cast<float>(std::sin(angle)));
            const float wide = std::sqrt(at.y());
            sky[static_cast<std::size_t>(i)] = {
                wide * way.x(), wide * way.y(), std::sqrt(1 - at.y())};
            disc[static_cast<std::size_t>(i)] = wide * way;
        }
    }

    std::array<Vector3f, 32> sky;   // cosine-weighted over the half sphere
    std::array<Vector2f, 32> disc;  // evenly over the unit disc
};

const Tables tables;

struct Axes {
    explicit Axes(const Vector3f& z_axis)
        : x(z_axis.unitOrthogonal()),
          y(z_axis.cross(x)),
          z(z_axis) {}

    Vector3f apply(const Vector3f& v) const { return v.x() * x + v.y() * y + v.z() * z; }

    Vector3f x, y, z;
};

/// Runs `work(corner, plain tile number)` for each tile, in parallel.
template <typename Work>
void for_tiles(const Camera& camera, const Work& work) {
    const int columns = (camera.width() + tile - 1) / tile;
    const int rows = (camera.height() + tile - 1) / tile;
    tbb::parallel_for(0, columns * rows, [&](int index) {
        const PlainFloats plain;
        work(Eigen::Vector2i(index % columns * tile, index / columns * tile));
    });
}

/// Everything that the stages share.
struct Job {
    const Stage& stage;
    const Camera& camera;
    std::uint32_t mask;
    const std::vector<Hit>& hits;
    Frame& frame;
    std::vector<Beam> beams;
    Vector3f eye;
    float pixel;
    Axes sun_axes;
    bool sun_matters;

    bool holds(const Eigen::Vector2i& at) const {
        return at.x() < camera.width() && at.y() < camera.height();
    }
};

Vector3f lifted(const Vector3f& position, const Vector3f& flat, float distance) {
    return position + flat * (2e-3F + 1e-4F * distance);
}

Ray sun_ray(const Job& job, const Vector3f& origin, int place) {
    const Vector2f spot = tables.disc[static_cast<std::size_t>(place)] * job.stage.sky.sun_radius();
    return {
        origin, job.sun_axes.apply({spot.x(), spot.y(), 1}), infinite, job.mask & all_but_paint};
}

/// What a mirror ray met, lit without rays of its own.
Color mirrored_radiance(const Job& job, const Ray& ray, const Hit& hit, float footprint_scale) {
    const Stage& stage = job.stage;
    if (hit.instance == no_instance)
        return stage.sky.radiance(ray.direction, false);
    const Surface at = surface_at(stage.scene, hit, ray.origin, ray.direction, footprint_scale);
    const Look look = look_of(stage, at);
    Light light{job.sun_matters ? 0.6F : 1.0F, 0.75F, Color::Zero()};
    if (look.gloss > 0)
        light.mirrored =
            stage.sky.radiance(mirror_direction(at.view, look.normal, at.flat), false) * 0.8F;
    const Color color = outgoing(stage, job.beams, look, light, at.position, at.view);
    // Lamps would leave single dots: what one ray finds stands for 16 pixels.
    const Color seen = color.min(2.2F / stage.sky.exposure());
    return through_air(stage.sky, seen, at.view, at.distance);
}

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

void answer_free(const Job& job, Batches& batches, Batch& batch, const auto& give) {
    batches.free.resize(batch.rays.size());
    find_free(job.stage.scene, batch.rays, batches.free);
    for (std::size_t i = 0; i < batch.rays.size(); ++i)
        give(batch.owners[i], batches.free[i] != 0);
}

void request_light(const Job& job,
                   const Surface& at,
                   const Look& look,
                   int place,
                   std::size_t owner,
                   Batches& batches) {
    const Vector3f origin = lifted(at.position, at.flat, at.distance);
    const float facing = look.normal.dot(job.stage.sky.to_sun());
    if (job.sun_matters && (facing > 0 || look.translucency > 0))
        batches.sun.add(sun_ray(job, origin, place), owner);
    const Axes axes(at.normal);
    for (int i = 0; i < 2; ++i) {
        Vector3f direction = axes.apply(tables.sky[static_cast<std::size_t>(place + 16 * i)]);
        const float up = direction.dot(at.flat);
        if (up < 0.02F)
            direction += (0.04F - up) * at.flat;
        batches.sky.add({origin, direction, near_things, job.mask & all_but_paint}, owner);
    }
    if (look.gloss > 0) {
        const Vector2f spot = tables.disc[static_cast<std::size_t>(place)] *
                              (look.roughness * look.roughness * 0.55F);
        const Vector3f tilted = (look.normal + spot.x() * axes.x + spot.y() * axes.y).normalized();
        batches.mirror.add(
            {origin, mirror_direction(at.view, tilted, at.flat), mirror_reach, job.mask}, owner);
    }
}

void light_tile(Job& job, const Eigen::Vector2i& corner) {
    thread_local Batches batches;
    batches.sun.clear();
    batches.sky.clear();
    batches.mirror.clear();
    for (int i = 0; i < tile * tile; ++i) {
        const Eigen::Vector2i pixel = corner + tile_pixel(i);
        if (!job.holds(pixel))
            continue;
        const std::size_t index = job.frame.index(pixel.x(), pixel.y());
        RawLight& raw = job.frame.lights[index];
        const Hit& hit = job.hits[index];
        raw.instance = hit.instance;
        if (hit.instance == no_instance)
            continue;
        const Vector3f direction = job.camera.ray(pixel.x() + 0.5, pixel.y() + 0.5).cast<float>();
        const Surface at = surface_at(job.stage.scene, hit, job.eye, direction, job.pixel);
        Sample& sample = job.frame.samples[index];
        sample.look = look_of(job.stage, at);
        sample.position = at.position;
        sample.distance = at.distance;
        raw.position = at.position;
        raw.flat = at.flat;
        raw.tolerance = 0.01F + 4 * at.distance * job.pixel;
        raw.light = {job.sun_matters ? 0.0F : 1.0F, 0.0F, Color::Zero()};
        request_light(job, at, sample.look, pattern(pixel.x(), pixel.y()), index, batches);
    }
    std::vector<RawLight>& lights = job.frame.lights;
    answer_free(job, batches, batches.sun, [&](std::size_t owner, bool free) {
        lights[owner].light.sunlit = free ? 1.0F : 0.0F;
    });
    answer_free(job, batches, batches.sky, [&](std::size_t owner, bool free) {
        lights[owner].light.open += free ? 0.5F : 0.0F;
    });
    batches.hits.resize(batches.mirror.rays.size());
    find_nearest(job.stage.scene, batches.mirror.rays, false, batches.hits);
    for (std::size_t i = 0; i < batches.hits.size(); ++i)
        lights[batches.mirror.owners[i]].light.mirrored =
            mirrored_radiance(job, batches.mirror.rays[i], batches.hits[i], job.pixel * 2);
}

Light filtered(const Job& job, const Eigen::Vector2i& pixel) {
    const Frame& frame = job.frame;
    const RawLight& own = frame.lights[frame.index(pixel.x(), pixel.y())];
    Light sum{0, 0, Color::Zero()};
    float count = 0;
    const int left = std::max(0, pixel.x() - 2);
    const int right = std::min(frame.width - 1, pixel.x() + 1);
    const int low = std::max(0, pixel.y() - 2);
    const int high = std::min(frame.height - 1, pixel.y() + 1);
    for (int y = low; y <= high; ++y) {
        for (int x = left; x <= right; ++x) {
            const RawLight& other = frame.lights[frame.index(x, y)];
            if (other.instance != own.instance || other.flat.dot(own.flat) < 0.9F ||
                std::abs((other.position - own.position).dot(own.flat)) > own.tolerance)
                continue;
            sum.sunlit += other.light.sunlit;
            sum.open += other.light.open;
            // Single bright spots would leave squares.
            sum.mirrored += other.light.mirrored;
            count += 1;
        }
    }
    return {sum.sunlit / count, sum.open / count, sum.mirrored / count};
}

Color sky_color(const Job& job, const Vector3f& direction) {
    const Vector3f view = direction.normalized();
    // Fog reaches about as far as the clouds' base is seen: thicker towards the horizon.
    const Color sky = job.stage.sky.radiance(view, true);
    const float far = 120 / (std::max(view.z(), 0.0F) + 0.06F);
    return through_air(job.stage.sky, sky, view, job.stage.sky.extinction() > 1e-3F ? far : 0.0F);
}

void combine_tile(Job& job, const Eigen::Vector2i& corner) {
    Frame& frame = job.frame;
    for (int i = 0; i < tile * tile; ++i) {
        const Eigen::Vector2i pixel = corner + tile_pixel(i);
        if (!job.holds(pixel))
            continue;
        const std::size_t index = frame.index(pixel.x(), pixel.y());
        const Vector3f direction = job.camera.ray(pixel.x() + 0.5, pixel.y() + 0.5).cast<float>();
        Color color;
        if (frame.lights[index].instance == no_instance) {
            color = sky_color(job, direction);
        } else {
            Sample& sample = frame.samples[index];
            sample.light = filtered(job, pixel);
            const Vector3f view = direction.normalized();
            color =
                outgoing(job.stage, job.beams, sample.look, sample.light, sample.position, view);
            color = through_air(job.stage.sky, color, view, sample.distance);
        }
        frame.colors[index] = color * job.stage.sky.exposure();
    }
}

float brightness(const Color& color) {
    const float light = luminance(color);
    return light / (light + 0.5F);
}

bool is_edge(const Frame& frame, int x, int y) {
    const std::size_t index = frame.index(x, y);
    const RawLight& own = frame.lights[index];
    const float light = brightness(frame.colors[index]);
    constexpr std::array<std::array<int, 2>, 4> sides{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
    for (const auto& side : sides) {
        const int i = std::clamp(x + side[0], 0, frame.width - 1);
        const int j = std::clamp(y + side[1], 0, frame.height - 1);
        const std::size_t next = frame.index(i, j);
        const RawLight& other = frame.lights[next];
        if (std::abs(brightness(frame.colors[next]) - light) > 0.045F)
            return true;
        if (own.instance != other.instance && own.instance != no_instance &&
            std::abs(brightness(frame.colors[next]) - light) > 0.01F)
            return true;
    }
    return false;
}

/// The light of the neighbour that lies on the same surface, or of the pixel itself.
Light borrowed(const Frame& frame,
               const Eigen::Vector2i& pixel,
               const Hit& hit,
               const Surface& at) {
    Light best{0, 0.8F, Color::Zero()};
    float least = infinite;
    for (int i = 0; i < 9; ++i) {
        const int x = std::clamp(pixel.x() + i % 3 - 1, 0, frame.width - 1);
        const int y = std::clamp(pixel.y() + i / 3 - 1, 0, frame.height - 1);
        const std::size_t index = frame.index(x, y);
        const RawLight& raw = frame.lights[index];
        if (raw.instance != hit.instance)
            continue;
        const float away =
            (raw.position - at.position).norm() + (1 - raw.flat.dot(at.flat)) * at.distance * 0.01F;
        if (away < least) {
            least = away;
            best = frame.samples[index].light;
        }
    }
    return best;
}

constexpr std::size_t places = 4;  // in a pixel, no two in one row or column
constexpr std::array<std::array<double, 2>, places> place{
    {{.375, .125}, {.875, .375}, {.625, .875}, {.125, .625}}};

void refine_tile(Job& job, const std::vector<std::uint8_t>& edges, const Eigen::Vector2i& corner) {
    Frame& frame = job.frame;
    thread_local Batches batches;
    thread_local std::vector<Look> looks;
    thread_local std::vector<Light> lights;
    Batch& primary = batches.sky;
    primary.clear();
    batches.sun.clear();
    for (int i = 0; i < tile * tile; ++i) {
        const Eigen::Vector2i pixel = corner + tile_pixel(i);
        if (!job.holds(pixel) || edges[frame.index(pixel.x(), pixel.y())] == 0)
            continue;
        for (const auto& at : place)
            primary.add({job.eye,
                         job.camera.ray(pixel.x() + at[0], pixel.y() + at[1]).cast<float>(),
                         infinite,
                         job.mask},
                        frame.index(pixel.x(), pixel.y()));
    }
    if (primary.rays.empty())
        return;
    batches.hits.resize(primary.rays.size());
    find_nearest(job.stage.scene, primary.rays, true, batches.hits);
    std::vector<Surface> surfaces(primary.rays.size());
    looks.resize(primary.rays.size());
    lights.resize(primary.rays.size());
    for (std::size_t i = 0; i < primary.rays.size(); ++i) {
        const Hit& hit = batches.hits[i];
        if (hit.instance == no_instance)
            continue;
        surfaces[i] =
            surface_at(job.stage.scene, hit, job.eye, primary.rays[i].direction, job.pixel * 0.6F);
        looks[i] = look_of(job.stage, surfaces[i]);
        const Eigen::Vector2i pixel(static_cast<int>(primary.owners[i]) % frame.width,
                                    static_cast<int>(primary.owners[i]) / frame.width);
        lights[i] = borrowed(frame, pixel, hit, surfaces[i]);
        if (job.sun_matters) {
            lights[i].sunlit = 0;
            const Vector3f origin =
                lifted(surfaces[i].position, surfaces[i].flat, surfaces[i].distance);
            batches.sun.add(sun_ray(job, origin, static_cast<int>(i % 16)), i);
        }
    }
    answer_free(job, batches, batches.sun, [&](std::size_t owner, bool free) {
        lights[owner].sunlit = free ? 1.0F : 0.0F;
    });
    for (std::size_t i = 0; i < primary.rays.size(); i += places) {
        Color sum = Color::Zero();
        float weights = 0;
        for (std::size_t k = i; k < i + places; ++k) {
            Color color;
            if (batches.hits[k].instance == no_instance) {
                color = sky_color(job, primary.rays[k].direction);
            } else {
                color = outgoing(job.stage,
                                 job.beams,
                                 looks[k],
                                 lights[k],
                                 surfaces[k].position,
                                 surfaces[k].view);
                color = through_air(job.stage.sky, color, surfaces[k].view, surfaces[k].distance);
            }
            color *= job.stage.sky.exposure();
            // Weighted against the brightness, so that one bright place does not bring back the
            // stairs.
            const float weight = 1 / (1 + luminance(color));
            sum += color * weight;
            weights += weight;
        }
        frame.colors[primary.owners[i]] = sum / weights;
    }
}

}  // namespace

void shade(const Stage& stage,
           const Camera& camera,
           std::uint32_t mask,
           const std::vector<Hit>& hits,
           Frame& frame) {
    frame.width = camera.width();
    frame.height = camera.height();
    frame.samples.resize(hits.size());
    frame.lights.resize(hits.size());
    frame.colors.resize(hits.size());
    const Vector3f eye = camera.position().cast<float>();
    const float ambient = luminance(stage.sky.ambient(Vector3f::UnitZ()));
    Job job{stage,
            camera,
            mask,
            hits,
            frame,
            find_beams(stage, eye),
            eye,
            static_cast<float>(camera.pixel()),
            Axes(stage.sky.to_sun()),
            luminance(stage.sky.sun()) / pi > 0.01F * ambient};
    for_tiles(camera, [&](const Eigen::Vector2i& corner) { light_tile(job, corner); });
    for_tiles(camera, [&](const Eigen::Vector2i& corner) { combine_tile(job, corner); });
    std::vector<std::uint8_t> edges(hits.size());
    for_tiles(camera, [&](const Eigen::Vector2i& corner) {
        for (int i = 0; i < tile * tile; ++i) {
            const Eigen::Vector2i pixel = corner + tile_pixel(i);
            if (job.holds(pixel))
                edges[frame.index(pixel.x(), pixel.y())] =
                    static_cast<std::uint8_t>(is_edge(frame, pixel.x(), pixel.y()));
        }
    });
    for_tiles(camera, [&](const Eigen::Vector2i& corner) { refine_tile(job, edges, corner); });
}

}  // namespace reprise::render
