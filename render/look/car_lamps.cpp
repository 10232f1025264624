#include <algorithm>
#include <string_view>
#include <vector>

#include "render/look/car_surface_point.h"
#include "render/look/lettering.h"

namespace reprise::render {

namespace {

bool flashing(const CarSurfacePoint& at) {
    const unsigned bit = at.y > 0 ? world::lamp_left : world::lamp_right;
    return (at.lamps & bit) != 0 && flashes_now(at.tick, at.actor);
}

}  // namespace

bool front_lamp(Look& look,
                const ShadingInput& input,
                const CarSurfacePoint& at,
                float low,
                float high,
                float inner) {
    if (at.z > high || at.side < inner || at.normal.z() > 0.93F)
        return false;
    // Around the corner it runs out into a point.
    const float wrap = at.from_front / 0.42F;
    const float from_inner = (at.side - inner) / (at.half - inner);
    const float lower = low + (high - low) * (0.80F * wrap * wrap + 0.22F * (1 - from_inner));
    if (wrap > 1 || at.z < lower)
        return false;
    const float light = 1 / input.sky.exposure();
    // Two round lamps behind clear glass, in a dark housing with a bright edge above.
    const float middle = 0.5F * (low + high) + 0.02F;
    const float radius = 0.36F * (high - low);
    const auto away = [&](float share) {
        const float dy = at.side - mix(inner, at.half, share);
        const float dz = at.z - middle;
        return (dy * dy + dz * dz) / (radius * radius);
    };
    const float nearest = std::min(away(0.26F), away(0.62F));
    const bool round = nearest < 1;
    const bool edge = !round && at.z > high - 0.14F * (high - low);
    look.f0 = 0.06F;
    look.gloss = 1;
    look.roughness = 0.05F;
    look.albedo = nearest < 0.55F ? Color(.62F, .64F, .67F)
                  : round         ? Color(.30F, .31F, .32F)
                  : edge          ? Color(.60F, .61F, .62F)
                                  : Color(.085F, .088F, .092F);
    look.emission = Color(1, .95F, .84F) * (low_beam(at.lamps, input.sky) * light *
                                            (round  ? 7.0F
                                             : edge ? 2.0F
                                                    : 0.30F));
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
    const float row = (at.z - low) / (high - low);
    const float from_inner = (at.side - inner) / (at.half - inner);
    // Its inner edge leans outwards below.
    if (from_inner < 0.30F * (1 - row))
        return false;
    const float light = 1 / input.sky.exposure();
    const Color red(1.0F, .006F, .004F);
    look.albedo = Color(.26F, .008F, .008F);
    look.f0 = 0.06F;
    look.gloss = 0.6F;
    look.roughness = 0.06F;
    if ((at.lamps & world::lamp_brake) != 0)
        look.emission = red * (4.5F * light);
    else
        look.emission = red * (low_beam(at.lamps, input.sky) * 0.8F * light);
    if (flashing(at) && row > 0.62F)
        look.emission = Color(1.0F, .40F, .02F) * (4.5F * light);
    if ((at.lamps & world::lamp_reverse) != 0 && row < 0.25F)
        look.emission = Color(1, .97F, .9F) * (4 * light);
    // A dark rim, and chambers that are brighter in their middle.
    const float rim = std::min({row, 1 - row, from_inner - 0.30F * (1 - row) + 0.02F});
    if (rim < 0.075F) {
        look.albedo = Color(.035F, .006F, .006F);
        look.emission *= 0.25F;
    } else {
        const float chamber = std::abs(fraction(row * 3) - 0.5F);
        look.albedo *= mix(1, 1.7F - 2.6F * chamber, at.fine);
        look.emission *= mix(1, 1.25F - chamber, at.fine);
    }
    return true;
}

/// The signs of number plates; without I, O and Q, which read as figures.
const Lettering& plate_sign(std::uint32_t sign) {
    static const std::vector<Lettering> signs = [] {
        std::vector<Lettering> made;
        for (const char letter : std::string_view("0123456789ABCDEFGHJKLMNPRSTUVWXYZ"))
            made.emplace_back(std::string_view(&letter, 1));
        return made;
    }();
    return signs[sign % signs.size()];
}

/// The sign at a place of seven: two letters, two figures, three letters.
const Lettering& plate_sign_at(std::uint32_t actor, int place) {
    const std::uint32_t drawn = hash(actor, static_cast<std::uint32_t>(place));
    const bool figure = place == 2 || place == 3;
    return plate_sign(figure ? drawn % 10 : 10 + drawn % 23);
}

/// A number plate: white, its strip on the left of who reads it, seven dark signs; by the actor.
bool number_plate(Look& look, const CarSurfacePoint& at, float low, std::uint32_t actor) {
    // To the right of who looks at it: from ahead that is the car's left.
    const float u = 0.26F + (at.normal.x() > 0 ? at.y : -at.y);
    const float v = at.z - low;
    if (u < 0 || u > 0.52F || v < 0 || v > 0.115F)
        return false;
    as_trim(look, Color(.62F, .62F, .58F));
    if (u < 0.04F)
        look.albedo = Color(.02F, .05F, .28F);
    else if (u > 0.06F && u < 0.501F && at.fine > 0.1F) {
        constexpr float pitch = 0.063F;    // [m] from sign to sign
        constexpr float capital = 0.068F;  // [m] high
        const float place = (u - 0.06F) / pitch;
        const int sign = std::min(floor_int(place), 6);
        const Lettering& written = plate_sign_at(actor, sign);
        // Narrow signs are left as they are, wide ones are made to fit.
        const float fit = std::max(1.0F, 1.06F * capital * written.width() / pitch);
        const float ink =
            written.ink((place - static_cast<float>(sign) - 0.5F) * pitch * fit / capital,
                        (v - 0.0575F) / capital);
        look.albedo = mix(look.albedo, black, ink * at.fine);
    }
    return true;
}

}  // namespace reprise::render
