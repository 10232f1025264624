#include "render/shapes/people/head.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;
using world::Clothing;

/// `c`: middle of the head, `s`: half of its height.
void add_hair(Mesh& mesh, const world::WalkerModel& model, const Vector3f& c, float s) {
    using world::Hair;
    const auto blob = [&](const Vector3f& at, const Vector3f& radii, Material material) {
        add_ellipsoid(mesh, c + at * s, radii * s, 18, {material});
    };
    const auto tube = [&](float low, float high, float wide, float narrow, float x) {
        add_tube(
            mesh,
            {c + Vector3f(x, 0, low) * s, c + Vector3f(x, 0, high) * s, wide * s, narrow * s, 20},
            {Material::headgear});
    };
    if (model.hair == Hair::bald) {
        blob({-.22F, 0, -.08F}, {.72F, .73F, .36F}, Material::hair);
    } else if (model.hair != Hair::scarf) {
        blob({-.09F, 0, .32F}, {.90F, .77F, .75F}, Material::hair);
        blob({-.30F, 0, -.08F}, {.62F, .73F, .54F}, Material::hair);
    }
    switch (model.hair) {
        case Hair::bob:
            blob({-.22F, 0, -.18F}, {.70F, .84F, .72F}, Material::hair);
            break;
        case Hair::loose:
            blob({-.30F, 0, -.20F}, {.62F, .82F, .78F}, Material::hair);
            blob({-.50F, 0, -.85F}, {.34F, .68F, .80F}, Material::hair);
            break;
        case Hair::bun:
            blob({-.92F, 0, .34F}, {.34F, .36F, .34F}, Material::hair);
            break;
        case Hair::cap:
            blob({-.06F, 0, .36F}, {.92F, .79F, .74F}, Material::headgear);
            blob({.72F, 0, .36F}, {.62F, .56F, .06F}, Material::headgear);
            break;
        case Hair::hat:
            tube(.40F, .46F, 1.35F, 1.32F, -.04F);
            tube(.44F, 1.10F, .86F, .72F, -.04F);
            break;
        case Hair::helmet:
            if (model.clothing == Clothing::uniform) {  // a motorcyclist's, with its visor
                blob({.02F, 0, .06F}, {1.10F, .95F, 1.12F}, Material::headgear);
                blob({.48F, 0, .08F}, {.70F, .80F, .36F}, Material::eye);
            } else {
                blob({-.05F, 0, .42F}, {1.02F, .86F, .76F}, Material::headgear);
                if (model.clothing == Clothing::workwear)
                    blob({.20F, 0, .34F}, {1.02F, .84F, .07F}, Material::headgear);
            }
            break;
        case Hair::scarf:
            blob({-.14F, 0, .10F}, {.92F, .84F, .98F}, Material::headgear);
            blob({-.06F, 0, -.78F}, {.66F, .76F, .52F}, Material::headgear);
            break;
        default:
            break;
    }
}

}  // namespace

void add_head(Mesh& mesh, const world::WalkerModel& model, const BodyProportions& body) {
    const auto s = static_cast<float>(body.head / 2);
    const auto crown = static_cast<float>(body.height - body.hip);
    const Vector3f c(0.10F * s, 0, crown - s);
    const auto blob = [&](const Vector3f& at, const Vector3f& radii, Material material, int sides) {
        add_ellipsoid(mesh, c + at * s, radii * s, sides, {material});
    };
    blob({-.02F, 0, .14F}, {.86F, .70F, .84F}, Material::skin, 18);  // skull
    blob({.12F, 0, -.36F}, {.62F, .56F, .62F}, Material::skin, 16);  // jaw
    blob({.83F, 0, -.12F}, {.17F, .10F, .17F}, Material::skin, 8);   // nose
    blob({.69F, 0, -.53F}, {.07F, .20F, .045F}, Material::lips, 8);  // mouth
    for (const float side : {-1.0F, 1.0F}) {
        blob({.74F, side * .27F, .04F}, {.07F, .085F, .05F}, Material::eye, 8);
        blob({.76F, side * .29F, .21F}, {.07F, .15F, .028F}, Material::hair, 8);
        blob({-.05F, side * .70F, -.06F}, {.17F, .06F, .21F}, Material::skin, 8);
    }
    add_hair(mesh, model, c, s);
}

}  // namespace reprise::render
