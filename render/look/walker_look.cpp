#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

Look walker_look(const ShadingInput& input, const Surface& at) {
    const Outfit& outfit = input.scene.outfits()[at.instance->outfit];
    Look look;
    look.albedo = outfit.color_of(at.material);
    look.roughness = 0.85F;
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
        case Material::trousers: {
            // Folds: soft, so that no pixel is too large for them.
            const float folds =
                value_noise(at.local.x() * 3 + at.local.y() * 2, at.local.z() * 4, 3);
            look.albedo *= 0.92F + 0.16F * folds;
            break;
        }
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
