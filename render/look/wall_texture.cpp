#include <algorithm>
#include <cmath>

#include "render/look/wall_surface_point.h"
#include "render/shapes/noise.h"

namespace reprise::render {

using world::FacadeKind;

Color wall_texture(const BuildingPaint& paint, float u, float z, const Surface& at) {
    Color color = paint.wall;
    float tone = 0.90F + 0.2F * fractal_noise(u * 0.5F, z * 0.35F, 3, 130);
    // Rain has washed dirt up from the pavement, and down in streaks.
    const float low = z < 0 ? 0 : z;
    const float dirt = smooth_step(1.1F, 0.0F, low);
    if (dirt > 0)
        tone *= 1 - 0.18F * dirt * (0.5F + value_noise(u * 2, 0.5F, 131));
    tone *= 0.96F + 0.06F * value_noise(u * 3.1F, z * 0.22F, 133);
    switch (paint.model->facade) {
        case FacadeKind::brick: {
            const float bricks = detail(at, 0.14F);
            const int course = floor_int(z / 0.075F);
            const float shifted = u / 0.25F + (course % 2 == 0 ? 0.0F : 0.5F);
            const bool mortar = fraction(shifted) < 0.045F || fraction(z / 0.075F) < 0.15F;
            tone *= 1 + bricks * 0.45F * (cell_noise(floor_int(shifted), course, 7) - 0.5F);
            // From far the mean of bricks and mortar.
            const float near = detail(at, 0.03F);
            color = mix(color,
                        Color(.42F, .39F, .35F),
                        (mortar ? 0.75F : 0.0F) * near + 0.14F * (1 - near));
            break;
        }
        case FacadeKind::stone: {
            const bool odd = floor_int(z / 0.6F) % 2 == 0;
            const float block = u / 0.9F + (odd ? 0.0F : 0.5F);
            const float joint = std::min(fraction(z / 0.6F) * 0.6F, fraction(block) * 0.9F);
            tone *= 1 - 0.35F * detail(at, 0.06F) * smooth_step(0.02F, 0.008F, joint);
            tone *= 1 + 0.14F * detail(at, 0.6F) *
                            (cell_noise(floor_int(block), floor_int(z / 0.6F), 8) - 0.5F);
            break;
        }
        case FacadeKind::timber:
            if (paint.half_timbered) {
                color = Color(.64F, .60F, .51F);
            } else {
                const float board = fraction(z / 0.17F);
                tone *= 1 - 0.38F * detail(at, 0.09F) * smooth_step(0.16F, 0.02F, board);
                tone *= 1 + 0.10F * detail(at, 0.17F) *
                                (cell_noise(floor_int(u / 3.1F), floor_int(z / 0.17F), 9) - 0.5F);
            }
            break;
        case FacadeKind::metal:
            tone *= 1 + 0.16F * detail(at, 0.25F) * (std::abs(fraction(u / 0.33F) - 0.5F) * 4 - 1);
            break;
        case FacadeKind::office: {
            const float joint = std::min(fraction(u / 1.6F) * 1.6F, fraction(z / 1.7F) * 1.7F);
            tone *= 1 - 0.3F * detail(at, 0.06F) * smooth_step(0.02F, 0.008F, joint);
            break;
        }
        default:
            if (const float grain = detail(at, 0.08F); grain > 0)
                tone *= 1 + 0.08F * grain * (value_noise(u * 24, z * 24, 132) - 0.5F);
    }
    return color * tone;
}

}  // namespace reprise::render
