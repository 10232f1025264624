#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

/// Snow lies on what stays where it is; who walks shakes it off.
bool keeps_snow(Kind kind) {
    return kind == Kind::car_body || kind == Kind::ground || kind == Kind::marking ||
           kind == Kind::town || kind == Kind::tree || kind == Kind::plant || kind == Kind::prop ||
           kind == Kind::parked;
}

/// Where wheels roll, less is left: in their two tracks the road shows first. In [0, 1].
float left_by_wheels(const ShadingInput& input, const Surface& at) {
    const bool road = at.material == Material::asphalt || at.material == Material::marking;
    if (!road)
        return 1;
    const float lane = input.scene.lanes().distance(at.position.x(), at.position.y());
    const float track = smooth_step(0.60F, 0.05F, std::abs(lane - 0.78F));
    const float driven = smooth_step(2.2F, 1.3F, lane);
    return 1 - 0.22F * driven - 0.40F * track;
}

/// How much stays on what slopes so. A drive leaves it on roofs and bonnets, not on panes.
float share_of_slope(const Surface& at) {
    if (at.material == Material::leaf)
        return 0.35F + 0.45F * clamp01(at.normal.z());
    const bool drives = at.instance->kind == Kind::car_body;
    return drives ? smooth_step(0.86F, 0.97F, at.normal.z())
                  : smooth_step(0.30F, 0.75F, at.normal.z());
}

}  // namespace

void lay_snow(Look& look, const ShadingInput& input, const Surface& at) {
    if (!(at.snow > 0) || !keeps_snow(at.instance->kind))
        return;
    const float up = share_of_slope(at);
    if (up <= 0)
        return;
    // What drives takes its patches with it; they are smaller, and have edges.
    const bool drives = at.instance->kind == Kind::car_body;
    const float x =
        drives ? 2.5F * at.local.x() + 7 * unit(hash(at.instance->actor, 149)) : at.position.x();
    const float y = drives ? 2.5F * at.local.y() : at.position.y();
    const float soft = drives ? 0.10F : 0.30F;
    // Patches: a cover of c lies on the share c of places, thinner where the noise is low.
    const float patch =
        0.6F * fractal_noise(x * 0.4F, y * 0.4F, 3, 140) +
        0.4F * fractal_noise(x * 3.1F + (drives ? 0 : at.position.z()), y * 3.1F, 2, 144);
    const float cover = at.snow * (drives ? 0.65F : left_by_wheels(input, at));
    const float share = up * smooth_step(patch - soft, patch + soft, 1.6F * cover - 0.30F);
    if (share <= 0)
        return;
    const float grain = detail(at, 0.3F);
    const float bumps = grain > 0 ? value_noise(x * 5, y * 5, 147) - 0.5F : 0.0F;
    look.albedo =
        mix(look.albedo,
            Color(Color(0.70F, 0.73F, 0.77F) * (1 + 0.10F * (patch - 0.5F + bumps * grain))),
            share);
    look.emission *= 1 - share;
    look.gloss *= 1 - share;
    look.f0 = mix(look.f0, 0.02F, share);
    look.roughness = mix(look.roughness, 0.75F, share);
    const float slope = 0.22F * grain * share;
    look.normal +=
        Eigen::Vector3f(slope * bumps, slope * (value_noise(x * 5, y * 5, 148) - 0.5F), 0);
    look.normal.normalize();
}

}  // namespace reprise::render
