#include <algorithm>
#include <array>
#include <cmath>

#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using world::PlotKind;

/// As the ground's own material, with its weather.
Look as_ground(const ShadingInput& input, const Surface& at, Material material) {
    Surface ground = at;
    ground.material = material;
    return ground_look(input, ground);
}

Look lawn(const ShadingInput& input, const Surface& at) {
    Look look = as_ground(input, at, Material::grass);
    // Cut short: evenly green, in stripes that the mower left.
    const float stripe =
        fraction((at.position.x() + at.position.y()) / 3.2F) < 0.5F ? 1.06F : 0.95F;
    const Color even = Color(.070F, .125F, .028F) * (luminance(look.albedo) / 0.10F);
    look.albedo = mix(look.albedo, even, 0.7F) * stripe;
    return look;
}

Look gravel(const Surface& at) {
    const float x = at.position.x();
    const float y = at.position.y();
    float tone = 0.85F + 0.3F * fractal_noise(x * 0.4F, y * 0.4F, 3, 160);
    tone *= 1 + 0.7F * detail(at, 0.04F) * (value_noise(x * 45, y * 45, 161) - 0.5F) +
            0.3F * detail(at, 0.1F) * (value_noise(x * 17, y * 17, 162) - 0.5F);
    Look look;
    look.albedo = Color(.36F, .32F, .255F) * tone;
    look.normal = at.normal;
    return look;
}

Look paving(const Surface& at, const PlotFrame& plot, float edge) {
    const Vector2f away = at.position.head<2>() - plot.start;
    const float u = away.dot(plot.along);
    const float v = plot.along.x() * away.y() - plot.along.y() * away.x();
    // A border of dark setts, then slabs in rows of bands.
    const bool border = edge < 0.6F || (edge > 4.0F && edge < 4.25F);
    const float length = border ? 0.2F : 0.8F;
    const float width = border ? 0.2F : 0.4F;
    const int row = floor_int(v / width);
    const float shifted = u / length + (row % 2 == 0 ? 0.0F : 0.5F);
    const float joint = std::min(fraction(shifted) * length, fraction(v / width) * width);
    float tone = 0.88F + 0.24F * fractal_noise(u * 0.3F, v * 0.3F, 3, 163);
    tone *= 1 + 0.20F * detail(at, width) * (cell_noise(floor_int(shifted), row, 164) - 0.5F);
    tone *= 1 - 0.5F * detail(at, 0.05F) * smooth_step(0.014F, 0.006F, joint);
    const bool dark = !border && floor_int(u / 4.8F) % 2 == 0 && floor_int(v / 4.8F) % 2 == 0;
    Look look;
    look.albedo = (border ? Color(.17F, .165F, .16F)
                   : dark ? Color(.33F, .27F, .22F)
                          : Color(.40F, .37F, .32F)) *
                  tone;
    look.normal = at.normal;
    return look;
}

Look water(const ShadingInput& input, const Surface& at) {
    const float x = at.position.x();
    const float y = at.position.y();
    Look look;
    look.albedo = Color(.020F, .040F, .038F);
    look.f0 = 0.025F;
    look.gloss = 1;
    look.roughness = 0.03F;
    // Small waves that the wind drives on.
    const float drift = static_cast<float>(input.tick % 20000) * 0.02F;
    const float rough = 0.05F * detail(at, 0.8F);
    const auto slope = [&](std::uint32_t salt) {
        return value_noise(x * 2.1F + drift, y * 2.1F, salt) - 0.5F +
               0.5F * (value_noise(x * 5.3F - drift, y * 5.3F + drift, salt + 1) - 0.5F);
    };
    look.normal = Eigen::Vector3f(slope(165) * rough, slope(167) * rough, 1).normalized();
    return look;
}

Look car_park(const ShadingInput& input, const Surface& at, const PlotFrame& plot) {
    const Vector2f away = at.position.head<2>() - plot.start;
    const float u = away.dot(plot.along);
    const float v = plot.along.x() * away.y() - plot.along.y() * away.x();
    // Bays of 2.5 m by 5 m on both sides of an aisle of 6 m, again and again: as those who park
    // cars by program count them, from half a metre inside the longest side.
    const float across = fraction((v - 0.5F) / 16.4F) * 16.4F;
    const float bay = fraction((u - 0.5F) / 2.5F) * 2.5F;
    const bool in_bays = (across < 5 || (across > 11 && across < 16)) && v > 0.5F && u > 0.4F &&
                         u < plot.longest - 0.4F;
    const bool line = in_bays && std::min(bay, 2.5F - bay) < 0.06F;
    return as_ground(input, at, line ? Material::marking : Material::asphalt);
}

Look playground(const Surface& at, float edge) {
    const float x = at.position.x();
    const float y = at.position.y();
    Look look;
    look.normal = at.normal;
    // Soft tiles with islands of another colour, in a kerb of timber.
    const float island = fractal_noise(x * 0.13F, y * 0.13F, 2, 170);
    const Color soft = island > 0.56F ? Color(.10F, .19F, .28F) : Color(.33F, .105F, .065F);
    const float joint = std::min(fraction(x / 0.5F), fraction(y / 0.5F)) * 0.5F;
    look.albedo = soft * (0.9F + 0.2F * value_noise(x * 30, y * 30, 171) * detail(at, 0.05F)) *
                  (1 - 0.35F * detail(at, 0.05F) * smooth_step(0.012F, 0.005F, joint));
    if (edge < 0.18F)
        look.albedo = Color(.24F, .16F, .10F);
    return look;
}

Look forest_floor(const Surface& at) {
    const float x = at.position.x();
    const float y = at.position.y();
    const float moss = smooth_step(.42F, .66F, fractal_noise(x * 0.35F, y * 0.35F, 3, 172));
    const float litter =
        value_noise(x * 16, y * 16, 173) * 0.6F + value_noise(x * 37, y * 37, 174) * 0.4F;
    Look look;
    look.normal = at.normal;
    look.albedo = mix(Color(.115F, .078F, .046F), Color(.055F, .085F, .026F), moss) *
                  (1 + 0.9F * detail(at, 0.1F) * (litter - 0.5F));
    return look;
}

}  // namespace

Look plot_look(const ShadingInput& input, const Surface& at) {
    const PlotFrame& plot = input.scene.plots()[at.tag];
    const float edge = plot.edge_distance(at.position.head<2>());
    Look look;
    switch (plot.kind) {
        case PlotKind::lawn:
            return lawn(input, at);
        case PlotKind::water:
            return water(input, at);
        case PlotKind::car_park:
            return car_park(input, at, plot);
        case PlotKind::park:
            // A path runs around inside.
            if (edge < 3.0F || edge > 5.2F)
                return lawn(input, at);
            look = gravel(at);
            break;
        case PlotKind::square:
            look = paving(at, plot, edge);
            break;
        case PlotKind::gravel:
            look = gravel(at);
            break;
        case PlotKind::playground:
            look = playground(at, edge);
            break;
        case PlotKind::forest:
            look = forest_floor(at);
            break;
    }
    if (plot.kind != PlotKind::water)
        look.albedo = soaked(look.albedo, 0.8F * at.wetness);
    if (plot.kind == PlotKind::square) {
        look.gloss = std::max(look.gloss, 0.5F * at.wetness);
        look.f0 = mix(look.f0, 0.03F, at.wetness);
        look.roughness = mix(look.roughness, 0.3F, at.wetness);
    }
    return look;
}

world::SemanticClass plot_class(world::PlotKind kind) {
    using world::SemanticClass;
    switch (kind) {
        case PlotKind::lawn:
        case PlotKind::park:
        case PlotKind::forest:
            return SemanticClass::terrain;
        case PlotKind::water:
            return SemanticClass::water;
        default:
            return SemanticClass::ground;
    }
}

}  // namespace reprise::render
