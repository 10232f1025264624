#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

/// Snow lies on what stays where it is; what drives and walks shakes it off.
bool keeps_snow(Kind kind) {
    return kind == Kind::ground || kind == Kind::marking || kind == Kind::town ||
           kind == Kind::tree || kind == Kind::plant || kind == Kind::prop || kind == Kind::parked;
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

}  // namespace

void lay_snow(Look& look, const ShadingInput& input, const Surface& at) {
    if (!(at.snow > 0) || !keeps_snow(at.instance->kind))
        return;
    const bool leaf = at.material == Material::leaf;
    const float up =
        leaf ? 0.35F + 0.45F * clamp01(at.normal.z()) : smooth_step(0.30F, 0.75F, at.normal.z());
    if (up <= 0)
        return;
    const float x = at.position.x();
    const float y = at.position.y();
    // Patches: a cover of c lies on the share c of places, thinner where the noise is low.
    const float patch = 0.6F * fractal_noise(x * 0.4F, y * 0.4F, 3, 140) +
                        0.4F * fractal_noise(x * 3.1F + at.position.z(), y * 3.1F, 2, 144);
    const float cover = at.snow * left_by_wheels(input, at);
    const float share = up * smooth_step(patch - 0.30F, patch + 0.30F, 1.6F * cover - 0.30F);
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
