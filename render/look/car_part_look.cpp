#include <array>
#include <cmath>
#include <string_view>

#include "render/look/car_surface_point.h"
#include "render/shapes/cars/car_parts.h"

namespace reprise::render {

namespace {

using world::Livery;

/// Letters of 3 x 5 dots, the upper left one first.
bool inked(char letter, int column, int row) {
    struct Glyph {
        char letter;
        std::uint32_t dots;  ///< 15 bits
    };

    static constexpr std::array<Glyph, 14> glyphs{{{'A', 0b010'101'111'101'101},
                                                   {'B', 0b110'101'110'101'110},
                                                   {'C', 0b011'100'100'100'011},
                                                   {'E', 0b111'100'110'100'111},
                                                   {'I', 0b111'010'010'010'111},
                                                   {'L', 0b100'100'100'100'111},
                                                   {'M', 0b101'111'111'101'101},
                                                   {'N', 0b110'101'101'101'101},
                                                   {'O', 0b010'101'101'101'010},
                                                   {'P', 0b110'101'110'100'100},
                                                   {'T', 0b111'010'010'010'010},
                                                   {'U', 0b101'101'101'101'111},
                                                   {'X', 0b101'101'010'101'101},
                                                   {' ', 0}}};
    for (const Glyph& glyph : glyphs)
        if (glyph.letter == letter)
            return ((glyph.dots >> (14 - 3 * row - column)) & 1u) != 0;
    return false;
}

/// Is there ink at u to the right and v up, in [0, 1] of the word's field?
bool written(std::string_view word, float u, float v) {
    if (u < 0 || u >= 1 || v < 0 || v >= 1)
        return false;
    const int column = floor_int(u * static_cast<float>(4 * word.size()));
    const int row = 4 - floor_int(v * 5);
    return column % 4 < 3 && inked(word[static_cast<std::size_t>(column / 4)], column % 4, row);
}

}  // namespace

Look car_part_look(const ShadingInput& input, const Surface& at) {
    const float light = 1 / input.sky.exposure();
    const std::uint16_t lamps = at.instance->lamps;
    const auto flashing = [&](unsigned bit) {
        return (lamps & bit) != 0 && flashes_now(input.tick, at.instance->actor);
    };
    Look look;
    look.roughness = 0.4F;
    const auto lamp = [&](const Color& color, float power) {
        look.albedo = color * 0.3F + 0.02F;
        look.gloss = 1;
        look.roughness = 0.05F;
        look.emission = color * (power * light);
    };
    const float lit = low_beam(lamps, input.sky);
    switch (static_cast<CarPart>(at.tag)) {
        case CarPart::chrome:
            look.albedo = Color(.38F, .39F, .40F);
            look.f0 = 0.5F;
            look.roughness = 0.2F;
            break;
        case CarPart::rubber:
            look.albedo = Color::Constant(.022F);
            break;
        case CarPart::leather:
            look.albedo = Color(.03F, .026F, .024F);
            break;
        case CarPart::painted:
            look.albedo = at.instance->color;
            look.f0 = 0.045F;
            look.gloss = 1;
            look.roughness = 0.08F;
            break;
        case CarPart::window:
            look.albedo = Color(.03F, .034F, .036F);
            look.gloss = 1;
            look.f0 = 0.08F;
            look.roughness = 0.04F;
            break;
        case CarPart::front_lamp:
            lamp(Color(1, .95F, .84F), 5.0F * lit);
            look.albedo = Color(.5F, .51F, .53F);
            break;
        case CarPart::rear_lamp:
            lamp(Color(1, .006F, .004F), (lamps & world::lamp_brake) != 0 ? 4.5F : 0.8F * lit);
            break;
        case CarPart::left_indicator:
            lamp(Color(1, .42F, .03F), flashing(world::lamp_left) ? 4.5F : 0.0F);
            break;
        case CarPart::right_indicator:
            lamp(Color(1, .42F, .03F), flashing(world::lamp_right) ? 4.5F : 0.0F);
            break;
        case CarPart::blue_lamp:
            // Left and right in turn, two and a half times a second.
            lamp(Color(.02F, .09F, .75F),
                 (lamps & world::lamp_beacon) != 0 &&
                         ((input.tick + hash(at.instance->actor, 62) % 8) % 8 < 4) ==
                             (at.local.y() > 0)
                     ? 12.0F
                     : 0.0F);
            break;
        case CarPart::roof_sign: {
            look.albedo = Color(.62F, .56F, .30F);
            const bool faces = std::abs(at.local_normal.x()) > 0.9F;
            const float u = 0.5F + (at.local_normal.x() > 0 ? 1.0F : -1.0F) * at.local.y() / 0.34F;
            const float low = at.instance->prototype->mesh.vertices.back().z() - 0.105F;
            if (faces && written("TAXI", u, (at.local.z() - low) / 0.085F))
                look.albedo = Color::Constant(0.02F);
            else
                look.emission = Color(1, .85F, .35F) * (1.2F * lit * light);
            break;
        }
    }
    return look;
}

void paint_livery(Look& look, const CarSurfacePoint& at) {
    const Livery livery = at.shape.model->livery;
    const bool is_side = std::abs(at.normal.y()) > 0.6F;
    const float up = at.z / at.height;
    // The word reads from left to right on either side.
    const float ahead = at.y > 0 ? at.from_front : at.from_rear;
    if (livery == Livery::police) {
        const Color blue(.018F, .055F, .30F);
        const bool band = up > 0.43F && up < 0.555F;
        if (is_side && band)
            look.albedo = fraction(at.x / 0.9F + (up > 0.4925F ? 0.5F : 0.0F)) < 0.5F
                              ? blue
                              : Color(.55F, .56F, .05F);
        else if (at.normal.z() > 0.5F && at.from_front < 1.1F &&
                 written("POLICE", 0.5F + at.y / 1.1F, (at.from_front - 0.62F) / 0.32F))
            look.albedo = blue;
        else if (is_side && written("POLICE", (ahead - 1.35F) / 1.25F, (up - 0.30F) / 0.105F))
            look.albedo = blue;
    }
    if (livery == Livery::ambulance) {
        const Color red(.52F, .025F, .02F);
        const bool band = up > 0.36F && up < 0.46F;
        if ((is_side || at.normal.x() < -0.5F) && band)
            look.albedo =
                fraction((is_side ? at.x : at.y) / 0.8F + (up > 0.41F ? 0.5F : 0.0F)) < 0.5F
                    ? red
                    : Color(.58F, .58F, .05F);
        else if (is_side &&
                 written(
                     "AMBULANCE", (ahead - (at.y > 0 ? 2.8F : .85F)) / 2.3F, (up - 0.60F) / 0.13F))
            look.albedo = red;
    }
    if (livery == Livery::taxi && is_side && up > 0.47F && up < 0.53F) {
        const bool check = (floor_int(at.x / 0.045F) + floor_int(at.z / 0.045F)) % 2 == 0;
        look.albedo = mix(Color::Constant(.5F), Color::Constant(check ? .02F : .62F), at.fine);
    }
}

}  // namespace reprise::render
