#include <algorithm>
#include <cmath>

#include "render/look/wall_surface_point.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

/// Rows of tiles along the slope, farther apart in height the flatter it is; sheets on metal halls.
/// `across`: length of the flat normal in plan.
Color roof_cover(const Surface& at, const BuildingPaint& paint, float u, float across) {
    const float z = at.position.z();
    // Rows along the slope: farther apart in height the flatter it is.
    const float row = z / (0.21F * std::max(0.25F, across));
    const float shifted = u / 0.24F + (floor_int(row) % 2 == 0 ? 0.0F : 0.5F);
    const float shade = 1 - 0.45F * detail(at, 0.2F) * smooth_step(0.25F, 0.0F, fraction(row));
    const float tone = (0.82F + 0.36F * fractal_noise(u * 0.7F, z, 2, 151)) *
                       (1 + 0.35F * detail(at, 0.24F) *
                                (cell_noise(floor_int(shifted), floor_int(row), 152) - 0.5F));
    return paint.roof * (paint.model->facade == world::FacadeKind::metal ? 1.0F : shade * tone);
}

}  // namespace

Look building_part_look(const Surface& at, const BuildingPaint& paint, BuildingFinish finish) {
    Look look;
    look.normal = at.normal;
    const float across =
        std::max(1e-3F, std::sqrt(at.flat.x() * at.flat.x() + at.flat.y() * at.flat.y()));
    const float u = (at.position.y() * at.flat.x() - at.position.x() * at.flat.y()) / across;
    const float x = at.position.x();
    const float y = at.position.y();
    const float z = at.position.z();
    const float grain = 0.9F + 0.2F * fractal_noise(x * 0.8F + z, y * 0.8F + z, 2, 150);
    switch (finish) {
        case BuildingFinish::masonry:
            look.albedo = wall_texture(paint, u, z, at);
            break;
        case BuildingFinish::trim:
            look.albedo = (paint.half_timbered ? Color(.42F, .36F, .28F) : paint.trim) * grain;
            break;
        case BuildingFinish::tiles:
            look.albedo = roof_cover(at, paint, u, across);
            break;
        case BuildingFinish::deck:
            look.albedo =
                Color(.20F, .195F, .19F) * grain *
                (1 + 0.3F * detail(at, 0.05F) * (value_noise(x * 40, y * 40, 153) - 0.5F));
            break;
        case BuildingFinish::metal:
            look.albedo = Color(.035F, .036F, .038F);
            look.roughness = 0.4F;
            break;
        case BuildingFinish::machine:
            look.albedo = Color(.42F, .43F, .43F) * grain *
                          (fraction(z / 0.18F) < 0.2F * detail(at, 0.15F) ? 0.6F : 1.0F);
            look.roughness = 0.4F;
            break;
        case BuildingFinish::copper:
            look.albedo = mix(Color(.19F, .36F, .30F),
                              Color(.13F, .20F, .16F),
                              fractal_noise(u * 0.9F, z * 0.5F, 3, 154));
            break;
        case BuildingFinish::glass:
            look.albedo = Color(.07F, .085F, .085F);
            look.f0 = 0.07F;
            look.gloss = 1;
            look.roughness = 0.04F;
            break;
        case BuildingFinish::awning:
            look.albedo = fraction(u / 0.5F) < 0.5F ? Color(.62F, .60F, .54F) : paint.accent;
            look.translucency = 0.15F;
            break;
        case BuildingFinish::timber:
            look.albedo = mix(paint.frame,
                              Color(.30F, .22F, .15F),
                              hash(paint.seed, 67) % 2 == 0 ? 0.0F : 0.8F) *
                          grain;
            break;
    }
    return look;
}

}  // namespace reprise::render
