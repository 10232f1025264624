#include "render/look/car_surface_point.h"

namespace reprise::render {

namespace {

bool flashing(const CarSurfacePoint& at) {
    const unsigned bit = at.y > 0 ? world::lamp_left : world::lamp_right;
    return (at.lamps & bit) != 0 && flashes_now(at.tick);
}

}  // namespace

bool front_lamp(Look& look,
                const ShadingInput& input,
                const CarSurfacePoint& at,
                float low,
                float high,
                float inner) {
    if (at.z < low || at.z > high || at.side < inner)
        return false;
    const float light = 1 / input.sky.exposure();
    const float middle_y = mix(inner, at.half * 0.86F, 0.42F);
    const float dy = (at.side - middle_y) / (at.half - inner);
    const float dz = (at.z - 0.5F * (low + high)) / (high - low);
    const float away = dy * dy * 5 + dz * dz * 4.5F;
    look.f0 = 0.06F;
    look.gloss = 1;
    look.roughness = 0.05F;
    look.albedo = away < 0.5F ? Color(.55F, .56F, .58F) : Color(.16F, .165F, .17F);
    look.emission = Color(1, .95F, .84F) *
                    (low_beam(at.lamps, input.sky) * light * (away < 0.5F ? 7.0F : 0.30F));
    if (flashing(at) && at.side > mix(inner, at.half, 0.72F))
        look.emission = Color(1.0F, .42F, .03F) * (4 * light);
    return true;
}

bool rear_lamp(Look& look,
               const ShadingInput& input,
               const CarSurfacePoint& at,
               float low,
               float high,
               float inner) {
    if (at.z < low || at.z > high || at.side < inner)
        return false;
    const float light = 1 / input.sky.exposure();
    const Color red(1.0F, .006F, .004F);
    look.albedo = Color(.26F, .008F, .008F);
    look.f0 = 0.06F;
    look.gloss = 0.6F;
    look.roughness = 0.06F;
    const float row = (at.z - low) / (high - low);
    if ((at.lamps & world::lamp_brake) != 0)
        look.emission = red * (4.5F * light);
    else
        look.emission = red * (low_beam(at.lamps, input.sky) * 0.8F * light);
    if (flashing(at) && row > 0.62F)
        look.emission = Color(1.0F, .40F, .02F) * (4.5F * light);
    if ((at.lamps & world::lamp_reverse) != 0 && row < 0.25F)
        look.emission = Color(1, .97F, .9F) * (4 * light);
    return true;
}

/// A number plate: white, framed, seven dark signs; unique by the actor.
bool number_plate(Look& look, const CarSurfacePoint& at, float low, std::uint32_t actor) {
    const float u = at.y + 0.26F;
    const float v = at.z - low;
    if (u < 0 || u > 0.52F || v < 0 || v > 0.115F)
        return false;
    as_trim(look, Color(.62F, .62F, .58F));
    if (u < 0.04F)
        look.albedo = Color(.02F, .05F, .28F);
    else if (u > 0.06F && u < 0.50F && v > 0.025F && v < 0.09F && at.fine > 0.1F) {
        const int sign = floor_int((u - 0.06F) / 0.063F);
        const float inside = fraction((u - 0.06F) / 0.063F);
        const int column = floor_int(inside * 4);
        const int row = floor_int((v - 0.025F) / 0.013F);
        const std::uint32_t dots = hash(actor, static_cast<std::uint32_t>(sign));
        const bool ink = column < 3 && (row == 0 || row == 4 ? column == 1 : true) &&
                         ((dots >> (column * 5 + row)) & 1u) != 0;
        if (ink)
            look.albedo = mix(look.albedo, black, at.fine);
    }
    return true;
}

}  // namespace reprise::render
