#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// Cloth hangs in folds, upright ones and, fewer, across; from far they are too small to see.
void fold(Look& look, const Surface& at) {
    const float seen = detail(at, 0.10F);
    // Parts are shared shapes that are stretched in their place.
    const Eigen::Vector3f stretch = at.instance->pose.linear().colwise().norm().cast<float>();
    const Vector3f p = at.local.cwiseProduct(stretch);
    const float round = p.x() + 0.8F * p.y();
    const float upright = value_noise(round * 21, p.z() * 3.5F, 3);
    const float across = value_noise(round * 6, p.z() * 17, 4);
    look.albedo *= 0.90F + 0.14F * upright + 0.06F * across;
    const Vector3f aside = Vector3f(-at.normal.y(), at.normal.x(), 0);
    const Vector3f tilt =
        (0.95F * (upright - 0.5F)) * aside + Vector3f(0, 0, 0.55F * (across - 0.5F));
    look.normal = (at.normal + seen * tilt).normalized();
}

}  // namespace

Look walker_look(const ShadingInput& input, const Surface& at) {
    const Outfit& outfit = input.scene.outfits()[at.instance->outfit];
    Look look;
    look.albedo = outfit.color_of(at.material);
    look.roughness = 0.85F;
    look.normal = at.normal;
    switch (at.material) {
        case Material::skin:
            look.roughness = 0.5F;
            look.f0 = 0.03F;
            break;
        case Material::hair:
        case Material::shoe:
            look.roughness = 0.45F;
            break;
        case Material::headgear:
        case Material::bag:
            look.roughness = 0.6F;
            break;
        case Material::shirt:
        case Material::trousers:
            fold(look, at);
            break;
        case Material::trim: {
            // A vest's reflecting bands.
            const float z = at.local.z();
            const bool vest = outfit.trim.y() > 0.15F && outfit.trim.x() > 0.5F;
            if (vest && ((z > .14F && z < .19F) || (z > .27F && z < .32F)))
                look.albedo = Color(.66F, .67F, .68F);
            break;
        }
        default:
            break;
    }
    return look;
}

}  // namespace reprise::render
