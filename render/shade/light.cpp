#include "render/shade/light.h"

#include <algorithm>

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr std::size_t most_beams = 10;
constexpr float beam_reach = 45;  // [m]

/// Light of the head lamps over pi; a low beam keeps below the horizon.
float beam_light(const std::vector<Beam>& beams, const Vector3f& position, const Vector3f& normal) {
    float sum = 0;
    for (const Beam& beam : beams) {
        const Vector3f away = position - beam.position;
        const float squared = away.squaredNorm();
        if (squared > beam_reach * beam_reach || squared < 0.04F)
            continue;
        const float distance = std::sqrt(squared);
        const float ahead = away.dot(beam.ahead) / distance;
        const float incidence = -away.dot(normal) / distance;
        if (ahead < 0.6F || incidence <= 0)
            continue;
        const float cone = smooth_step(0.60F, 0.99F, ahead);
        const float rise = away.z() / distance;
        const float cut = smooth_step(0.05F, -0.01F, rise);
        const float fade = 1 - squared / (beam_reach * beam_reach);
        sum +=
            cone * (0.06F + 0.94F * cut) * std::min(incidence * 2.2F, 1.0F) * fade / (squared + 6);
    }
    return sum;
}

/// Ambient visibility with the light that occluders reflect: the paler, the more (Jimenez et al.,
/// "Practical Realtime Strategies for Accurate Indirect Occlusion", 2016).
Color multi_bounce(float visibility, const Color& albedo) {
    const Color a = 2.0404F * albedo - 0.3324F;
    const Color b = -4.7951F * albedo + 0.6417F;
    const Color c = 2.7552F * albedo + 0.6903F;
    return (((visibility * a + b) * visibility + c) * visibility).max(visibility);
}

float highlight(float roughness, float normal_half) {
    // Trowbridge and Reitz (GGX), with masking folded into a constant.
    const float a = std::max(roughness * roughness, 0.004F);
    const float a2 = a * a;
    const float base = normal_half * normal_half * (a2 - 1) + 1;
    return a2 / (4 * pi * base * base);
}

}  // namespace

std::vector<Beam> find_beams(const ShadingInput& input, const Vector3f& eye) {
    std::vector<std::pair<float, Beam>> found;
    for (const Instance& car : input.scene.moving()) {
        const bool on = (car.lamps & world::lamp_low_beam) != 0 || input.sky.lamps_on();
        if (car.kind != Kind::car_body || !on || !input.sky.dim())
            continue;
        const CarShape& shape = input.scene.car_shape(car.model);
        const Eigen::Vector3d lamp(static_cast<double>(shape.front), 0, 0.66);
        const Vector3f position = (car.pose * lamp).cast<float>();
        const Vector3f ahead = car.pose.linear().col(0).cast<float>();
        const float away = (position - eye).squaredNorm();
        if (away < 100 * 100)
            found.emplace_back(away, Beam{position, (ahead - Vector3f(0, 0, .03F)).normalized()});
    }
    // Stable: equal distances stay in the order of ids.
    std::stable_sort(found.begin(), found.end(), [](const auto& last, const auto& next) {
        return last.first < next.first;
    });
    std::vector<Beam> beams;
    for (std::size_t i = 0; i < std::min(most_beams, found.size()); ++i)
        beams.push_back(found[i].second);
    return beams;
}

Vector3f mirror_direction(const Vector3f& view, const Vector3f& normal, const Vector3f& flat) {
    Vector3f direction = view - 2 * view.dot(normal) * normal;
    const float up = direction.dot(flat);
    if (up < 0.01F)
        direction += (0.01F - up) * flat;
    return direction.normalized();
}

Color outgoing_radiance(const ShadingInput& input,
                        const std::vector<Beam>& beams,
                        const Look& look,
                        const Light& light,
                        const Vector3f& position,
                        const Vector3f& view) {
    const Sky& sky = input.sky;
    const Vector3f& normal = look.normal;
    const float facing = normal.dot(sky.to_sun());
    const float front = std::max(facing, 0.0F);
    const float back = std::max(-facing, 0.0F) * look.translucency;
    Color arriving = sky.sun() * ((front + back) * light.sun_visibility / pi) +
                     sky.ambient(normal) * multi_bounce(light.sky_visibility, look.albedo);
    if (!beams.empty())
        arriving +=
            Color(1, .93F, .80F) * (15 * beam_light(beams, position, normal) / sky.exposure());
    const float mirror = fresnel(look.f0, -view.dot(normal)) * look.gloss;
    Color color = look.albedo * arriving * (1 - mirror) + look.emission + light.reflected * mirror;
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
