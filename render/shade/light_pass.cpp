#include <array>

#include "render/shade/shading_job.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float near_things = 2.4F;  // [m] how far things hide the sky from each other
constexpr float far_corners = 90;    // [m]
constexpr float mirror_reach = 150;  // [m]

/// One of 16 places in the pattern; 4 x 4 neighbours have all of them (Bayer's order). Where x + y
/// is even they are below 8, see asks_strongest().
int pattern(int x, int y) {
    static constexpr std::array<int, 16> order{
        0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
    return order[static_cast<std::size_t>((y & 3) * 4 + (x & 3))];
}

/// What a mirror ray met, lit without rays of its own.
Color mirrored_radiance(const ShadingJob& job,
                        NearSources& near,
                        const Ray& ray,
                        const Hit& hit,
                        float footprint_scale) {
    const ShadingInput& input = job.input;
    if (hit.instance == no_instance)
        return input.sky.radiance(ray.direction, false);
    Surface at = Surfaces(input.scene, ray.origin, footprint_scale).at(hit, ray.direction);
    expose(input, at);
    const Look look = shade_surface(input, at);
    Light light{Color::Zero(), job.sun_matters ? 0.6F : 1.0F, 0.75F, 0.75F, 0.75F};
    if (look.gloss > 0)
        light.reflected =
            input.sky.radiance(mirror_direction(at.view, look.normal, at.flat), false) * 0.8F;
    LampLight lamps;
    if (job.lamps_matter)
        lamps = LampSum(input, near, look, at.position, at.view).light();
    const Color color = outgoing_radiance(input, look, light, lamps, at.view);
    // Lamps would leave single dots: what one ray finds stands for 16 pixels. By night their shine
    // on what is wet is added up, see LampSum.
    const Color seen = color.min(mix(2.2F, 1.0F, input.sky.lamplight()) / input.sky.exposure());
    return through_atmosphere(input.sky, seen, ray.origin, at.view, at.distance);
}

/// Rays among leaves are the dearest and change the least; from far, corners are too small to see.
bool asks_for_sky(const Surface& at) {
    return at.material != Material::leaf && at.distance < far_corners;
}

void request_light(const ShadingJob& job,
                   const Surface& at,
                   const Look& look,
                   int place,
                   std::size_t owner,
                   NearSources& near,
                   TilePixels& pixels,
                   TileRays& rays) {
    const Vector3f origin = offset_origin(at.position, at.flat, at.distance);
    const float facing = look.normal.dot(job.input.sky.to_sun());
    if (job.sun_matters && (facing > 0 || look.translucency > 0))
        rays.sun.add(origin, sun_direction(job, place), infinite, job.mask & ~marking_bit, owner);
    if (job.lamps_matter) {
        const LampSum lamps(job.input, near, look, at.position, at.view);
        pixels.lamps[owner] = lamps.light();
        Light& light = pixels.lights[owner].light;
        const bool asks = lamps.any();
        light.lamp_visibility = asks && (asks_strongest(place) || lamps.is_one()) ? 0 : not_asked;
        light.rest_visibility = asks && (!asks_strongest(place) || lamps.is_one()) ? 0 : not_asked;
        if (asks) {
            const Vector3f way = lamp_direction(lamps, place);
            rays.lamp.add(origin, way, lamp_reach(way), job.mask & ~marking_bit, owner);
        }
    }
    const OrthonormalBasis axes(at.normal);
    for (int i = 0; i < 2 && asks_for_sky(at); ++i) {
        Vector3f direction = axes.apply(sky_direction(place + 16 * i));
        const float up = direction.dot(at.flat);
        if (up < 0.02F)
            direction += (0.04F - up) * at.flat;
        rays.sky.add(origin, direction, near_things, job.mask & ~marking_bit, owner);
    }
    if (look.gloss > 0) {
        const Vector2f spot = disc_point(place) * (look.roughness * look.roughness * 0.55F);
        const Vector3f tilted = (look.normal + spot.x() * axes.x + spot.y() * axes.y).normalized();
        const Vector3f direction = mirror_direction(at.view, tilted, at.flat);
        rays.mirror.add(origin, direction, mirror_reach, job.mask, owner);
    }
}

}  // namespace

void light_tile(ShadingJob& job, const Eigen::Vector2i& corner) {
    thread_local TileRays rays;
    rays.clear();
    TilePixels& pixels = *job.pixels(corner);
    Surfaces surfaces(job.input.scene, job.eye, job.pixel);
    NearSources near(job.sources);
    for (int i = 0; i < tile * tile; ++i) {
        const Eigen::Vector2i pixel = corner + tile_pixel(i);
        if (!job.contains(pixel))
            continue;
        job.look_ahead(
            corner, i + block, [&](std::size_t next) { surfaces.expect(job.hits[next]); });
        job.look_ahead(corner, i + 2 * block, [&](std::size_t next) { prefetch(&job.hits[next]); });
        job.look_ahead(corner, i + block / 2, [&](std::size_t next) {
            surfaces.expect_corners(job.hits[next]);
        });
        const Hit& hit = job.hits[job.frame.index(pixel.x(), pixel.y())];
        if (hit.instance == no_instance)
            continue;
        const std::size_t place = tile_place(pixel.x(), pixel.y());
        const Vector3f direction = job.camera.ray(pixel.x() + 0.5, pixel.y() + 0.5).cast<float>();
        Surface at = surfaces.at(hit, direction);
        expose(job.input, at);
        Sample& sample = pixels.samples[place];
        make_in(sample.look, [&] { return shade_surface(job.input, at); });
        RawLight& raw = pixels.lights[place];
        raw.position = at.position;
        raw.flat = at.flat;
        raw.tolerance = 0.01F + 4 * at.distance * job.pixel;
        raw.light = {Color::Zero(), job.sun_matters ? 0.0F : 1.0F, 0.0F, 1.0F, 1.0F};
        if (!asks_for_sky(at))
            raw.light.sky_visibility = at.material == Material::leaf ? 0.7F : 0.95F;
        request_light(
            job, at, sample.look, pattern(pixel.x(), pixel.y()), place, near, pixels, rays);
    }
    auto& lights = pixels.lights;
    trace_batch(job, rays, rays.sun, true, [&](std::size_t owner, bool visible) {
        lights[owner].light.sun_visibility =
            visible ? job.input.sky.clouds().sunlight(lights[owner].position) : 0.0F;
    });
    trace_batch(job, rays, rays.lamp, false, [&](std::size_t owner, bool visible) {
        Light& light = lights[owner].light;
        for (float* share : {&light.lamp_visibility, &light.rest_visibility})
            if (*share != not_asked)
                *share = visible ? 1.0F : 0.0F;
    });
    // Into a half sphere each: as packets that run alike they take four times as long.
    trace_batch(job, rays, rays.sky, false, [&](std::size_t owner, bool visible) {
        lights[owner].light.sky_visibility += visible ? 0.5F : 0.0F;
    });
    const std::span<const Ray> mirror = rays.mirror.rays();
    trace_nearest(job.input.scene, mirror, false, std::span(rays.hits).first(mirror.size()));
    for (std::size_t i = 0; i < mirror.size(); ++i)
        lights[rays.mirror.owner(i)].light.reflected =
            mirrored_radiance(job, near, mirror[i], rays.hits[i], job.pixel * 2);
}

}  // namespace reprise::render
