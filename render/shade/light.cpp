#include "render/shade/light.h"

#include <algorithm>

#include "render/shade/highlight.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// Ambient visibility with the light that occluders reflect: the paler, the more (Jimenez et al.,
/// "Practical Realtime Strategies for Accurate Indirect Occlusion", 2016).
Color multi_bounce(float visibility, const Color& albedo) {
    const Color a = 2.0404F * albedo - 0.3324F;
    const Color b = -4.7951F * albedo + 0.6417F;
    const Color c = 2.7552F * albedo + 0.6903F;
    return (((visibility * a + b) * visibility + c) * visibility).max(visibility);
}

/// Of all lamps' light, of which the strongest gives so much.
float lit_share(const Light& light, float strongest) {
    return strongest * light.lamp_visibility + (1 - strongest) * light.rest_visibility;
}

}  // namespace

Vector3f mirror_direction(const Vector3f& view, const Vector3f& normal, const Vector3f& flat) {
    Vector3f direction = view - 2 * view.dot(normal) * normal;
    const float up = direction.dot(flat);
    if (up < 0.01F)
        direction += (0.01F - up) * flat;
    return direction.normalized();
}

Color outgoing_radiance(const ShadingInput& input,
                        const Look& look,
                        const Light& light,
                        const LampLight& lamps,
                        const Vector3f& view) {
    const Sky& sky = input.sky;
    const Vector3f& normal = look.normal;
    const float facing = normal.dot(sky.to_sun());
    const float front = std::max(facing, 0.0F);
    const float back = std::max(-facing, 0.0F) * look.translucency;
    Color arriving = sky.sun() * ((front + back) * light.sun_visibility / pi) +
                     sky.ambient(normal) * multi_bounce(light.sky_visibility, look.albedo);
    // Streets and walls send some of their lamps' light back into the shadows.
    arriving += lamps.arriving * (0.06F + 0.94F * lit_share(light, lamps.strongest));
    const float mirror = fresnel(look.f0, -view.dot(normal)) * look.gloss;
    Color color = look.albedo * arriving * (1 - mirror) + look.emission + light.reflected * mirror +
                  lamps.shine * lit_share(light, lamps.strongest_shine);
    if (front > 0 && light.sun_visibility > 0) {
        const Vector3f half = (sky.to_sun() - view).normalized();
        const float shine = fresnel(look.f0, half.dot(sky.to_sun())) *
                            highlight(look.roughness, std::max(0.0F, half.dot(normal)));
        color += sky.sun() * (light.sun_visibility * front * std::min(shine, 60.0F));
    }
    return color;
}

Color through_atmosphere(const Sky& sky,
                         const Color& radiance,
                         const Vector3f& from,
                         const Vector3f& view,
                         float distance) {
    const float passes = sky.veil().passes(from.z(), view.z(), distance);
    return radiance * passes + sky.haze(view) * (1 - passes);
}

}  // namespace reprise::render
