#include <array>
#include <cmath>

#include "render/look/lamp_colors.h"
#include "render/look/lettering.h"
#include "render/look/look.h"
#include "render/shapes/noise.h"
#include "render/shapes/street/prop_mesh.h"

namespace reprise::render {

namespace {

using world::PropKind;

const Color sign_white(.66F, .66F, .64F);
const Color sign_red(.46F, .025F, .03F);
const Color sign_black = Color::Constant(.025F);
const Color sign_blue(.02F, .07F, .30F);

/// A place on a sign's face in its half widths, x to the reader's right, y up.
Color speed_limit(float x, float y, std::uint32_t value) {
    const float r = std::sqrt(x * x + y * y);
    if (r > 0.98F)
        return sign_white;
    if (r > 0.76F)
        return sign_red;
    const float high = value >= 100 ? 0.52F : 0.68F;
    return mix(sign_white, sign_black, number(value).ink(x / high, y / high));
}

Color stop(float x, float y) {
    // Distance to the nearest of the eight sides.
    const float diagonal = 0.70710678F * (std::abs(x) + std::abs(y));
    const float side = std::max(std::max(std::abs(x), std::abs(y)), diagonal);
    if (side > 0.89F)
        return sign_white;
    return mix(sign_red, sign_white, stop_word().ink(x / 0.46F, y / 0.46F));
}

Color yield(float x, float y) {
    // Distance inwards from the nearest side of a triangle that stands on its point.
    const float radius = 1.28F;
    const float inner =
        0.5F * radius -
        std::max(y, std::max(0.8660254F * x - 0.5F * y, -0.8660254F * x - 0.5F * y));
    return inner < 0.19F ? (inner < 0.015F ? sign_white : sign_red) : sign_white;
}

/// A walker on stripes in a white triangle on blue.
Color crossing(float x, float y) {
    const float top = 0.72F;
    const float down = (top - y) / 1.25F;
    if (down < 0 || down > 1 || std::abs(x) > 0.78F * down)
        return std::max(std::abs(x), std::abs(y)) > 0.92F ? sign_white : sign_blue;
    const auto stroke = [&](float ax, float ay, float bx, float by, float half) {
        const float dx = bx - ax;
        const float dy = by - ay;
        const float share = clamp01(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy));
        const float ex = x - ax - share * dx;
        const float ey = y - ay - share * dy;
        return ex * ex + ey * ey < half * half;
    };
    const bool figure =
        stroke(.02F, .32F, .02F, .33F, .075F) || stroke(0, .2F, -.02F, -.05F, .075F) ||
        stroke(-.02F, -.05F, -.16F, -.38F, .05F) || stroke(-.02F, -.05F, .15F, -.38F, .05F) ||
        stroke(0, .17F, -.17F, 0, .04F) || stroke(0, .17F, .18F, .02F, .04F);
    const bool stripe = y < -.40F && y > -.48F && fraction(x / .16F) < .5F;
    return figure || stripe ? sign_black : sign_white;
}

Color bus_plate(const Surface& at) {
    const float z = fraction(at.local.z() * 2);
    return z > 0.35F ? Color(.62F, .42F, .03F) : Color(.03F, .12F, .07F);
}

void as_plate(Look& look, const ShadingInput& input, const Surface& at, const PropTag& tag) {
    const float x = -at.local.y() / sign_radius;
    const float y = (at.local.z() - 0.001F * static_cast<float>(tag.centre_mm)) / sign_radius;
    switch (tag.kind) {
        case PropKind::speed_limit_sign:
            look.albedo = speed_limit(x, y, at.instance->model);
            break;
        case PropKind::stop_sign:
            look.albedo = stop(x, y);
            break;
        case PropKind::yield_sign:
            look.albedo = yield(x, y - 0.25F);
            break;
        case PropKind::crossing_sign:
            look.albedo = crossing(x, y);
            break;
        default:
            look.albedo = bus_plate(at);
    }
    look.roughness = 0.35F;
    // Sheets that send light back look brighter than paint at night.
    look.emission = look.albedo * (0.10F * input.sky.lamplight() / input.sky.exposure());
}

Color painted(const PropTag& tag, std::uint32_t style) {
    static const std::array<Color, 5> fences{Color(.60F, .59F, .55F),
                                             Color(.22F, .15F, .095F),
                                             Color(.30F, .22F, .14F),
                                             Color(.12F, .17F, .12F),
                                             Color(.33F, .32F, .30F)};
    static const std::array<Color, 3> bins{
        Color(.05F, .12F, .07F), Color(.09F, .095F, .10F), Color(.30F, .14F, .03F)};
    static const std::array<Color, 4> toys{Color(.40F, .05F, .04F),
                                           Color(.05F, .14F, .36F),
                                           Color(.50F, .34F, .03F),
                                           Color(.06F, .26F, .10F)};
    const std::uint32_t draw = hash(style, 70);
    switch (tag.kind) {
        case PropKind::fence:
            return fences[draw % fences.size()];
        case PropKind::bin:
            return bins[draw % bins.size()];
        case PropKind::hydrant:
            return draw % 4 == 0 ? Color(.50F, .36F, .03F) : Color(.40F, .03F, .025F);
        case PropKind::mailbox:
            return draw % 2 == 0 ? Color(.46F, .34F, .02F) : Color(.02F, .08F, .30F);
        default:
            return toys[draw % toys.size()];
    }
}

Color masonry(const Surface& at, std::uint32_t style) {
    const float u =
        at.local.x() * std::abs(at.local_normal.y()) + at.local.y() * std::abs(at.local_normal.x());
    const float z = at.local.z();
    const bool brick = hash(style, 71) % 2 == 0;
    const float course_height = brick ? 0.075F : 0.3F;
    const float length = brick ? 0.25F : 0.55F;
    const int course = floor_int(z / course_height);
    const float shifted = u / length + (course % 2 == 0 ? 0.0F : 0.5F);
    const bool joint =
        fraction(shifted) * length < 0.012F || fraction(z / course_height) * course_height < 0.011F;
    const float tone =
        (0.85F + 0.3F * fractal_noise(u * 0.6F, z, 2, 72)) *
        (1 + 0.35F * detail(at, 0.15F) * (cell_noise(floor_int(shifted), course, 73) - 0.5F));
    const Color color = brick ? Color(.28F, .12F, .08F) : Color(.40F, .38F, .34F);
    return mix(color, Color(.38F, .36F, .33F), joint ? 0.7F * detail(at, 0.03F) : 0.0F) * tone;
}

void as_timber(Look& look, const Surface& at) {
    const float grain = value_noise(at.local.x() * 3, at.local.y() * 60 + at.local.z() * 60, 74);
    look.albedo = Color(.27F, .175F, .10F) * (0.75F + 0.5F * grain * detail(at, 0.05F));
}

void as_lamp(Look& look, const ShadingInput& input) {
    look.albedo = Color(.55F, .55F, .52F);
    look.roughness = 0.2F;
    look.emission = street_lamp_color * (input.sky.lamplight() * input.sky.lamp(30000, 5));
}

}  // namespace

Look prop_look(const ShadingInput& input, const Surface& at) {
    const PropTag tag = PropTag::of(at.tag);
    const std::uint32_t style = at.instance->style;
    Look look;
    look.normal = at.normal;
    switch (tag.finish) {
        case PropFinish::steel:
            look.albedo = Color(.30F, .31F, .31F);
            look.roughness = 0.4F;
            break;
        case PropFinish::iron:
            look.albedo = Color(.035F, .038F, .038F);
            look.roughness = 0.4F;
            break;
        case PropFinish::plate:
            as_plate(look, input, at, tag);
            break;
        case PropFinish::plate_back:
            look.albedo = Color(.33F, .34F, .34F);
            look.roughness = 0.5F;
            break;
        case PropFinish::lamp:
            as_lamp(look, input);
            break;
        case PropFinish::timber:
            as_timber(look, at);
            break;
        case PropFinish::concrete:
            look.albedo =
                Color(.42F, .40F, .36F) *
                (0.8F + 0.4F * fractal_noise(
                                   at.local.x() * 1.5F + at.local.z(), at.local.y() * 1.5F, 3, 75));
            break;
        case PropFinish::masonry:
            look.albedo = masonry(at, style);
            break;
        case PropFinish::coping:
            look.albedo = Color(.50F, .48F, .44F);
            break;
        case PropFinish::paint:
            look.albedo = painted(tag, style);
            look.roughness = 0.4F;
            break;
        case PropFinish::glass:
            look.albedo = Color(.12F, .14F, .14F);
            look.f0 = 0.06F;
            look.gloss = 1;
            look.roughness = 0.03F;
            break;
        case PropFinish::water:
            look.albedo = Color(.035F, .065F, .065F);
            look.f0 = 0.03F;
            look.gloss = 1;
            look.roughness = 0.05F;
            break;
        case PropFinish::foliage:
            look.albedo =
                mix(Color(.040F, .085F, .022F), Color(.070F, .115F, .030F), unit(hash(style, 76))) *
                (tag.centre_mm == 0 ? 0.5F : 0.65F + 0.6F * unit(hash(at.tag, 77)));
            look.translucency = tag.centre_mm == 0 ? 0 : 0.35F;
            break;
    }
    if (look.gloss <= 0 && tag.finish != PropFinish::plate)
        look.albedo = soaked(look.albedo, 0.6F * at.wetness);
    return look;
}

world::SemanticClass prop_class(std::uint32_t bits) {
    using world::SemanticClass;
    const PropTag tag = PropTag::of(bits);
    switch (tag.kind) {
        case PropKind::speed_limit_sign:
        case PropKind::stop_sign:
        case PropKind::yield_sign:
        case PropKind::crossing_sign:
            return tag.finish == PropFinish::steel ? SemanticClass::pole
                                                   : SemanticClass::traffic_sign;
        case PropKind::street_light:
        case PropKind::pole:
        case PropKind::bollard:
            return SemanticClass::pole;
        case PropKind::fence:
            return SemanticClass::fence;
        case PropKind::wall:
            return SemanticClass::wall;
        case PropKind::hedge:
            return SemanticClass::vegetation;
        case PropKind::bin:
            return SemanticClass::dynamic_object;
        case PropKind::fountain:
            return tag.finish == PropFinish::water ? SemanticClass::water
                                                   : SemanticClass::static_object;
        default:
            return SemanticClass::static_object;
    }
}

}  // namespace reprise::render
