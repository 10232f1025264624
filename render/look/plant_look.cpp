#include <array>

#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using world::PlantKind;

/// Two greens between which the plants of a kind differ.
struct Greens {
    Color dark;
    Color bright;
};

Greens greens_of(PlantKind kind) {
    switch (kind) {
        case PlantKind::lime:
            return {{.062F, .120F, .022F}, {.095F, .150F, .028F}};
        case PlantKind::birch:
            return {{.105F, .150F, .036F}, {.140F, .170F, .042F}};
        case PlantKind::poplar:
            return {{.050F, .100F, .026F}, {.070F, .120F, .030F}};
        case PlantKind::plane:
            return {{.080F, .120F, .030F}, {.110F, .135F, .034F}};
        case PlantKind::maple:
            return {{.050F, .098F, .022F}, {.085F, .125F, .028F}};
        case PlantKind::cherry:
            return {{.075F, .105F, .028F}, {.090F, .115F, .030F}};
        case PlantKind::pine:
            return {{.034F, .068F, .034F}, {.048F, .078F, .036F}};
        case PlantKind::spruce:
            return {{.022F, .054F, .030F}, {.036F, .070F, .046F}};
        case PlantKind::round_bush:
            return {{.040F, .085F, .022F}, {.070F, .110F, .026F}};
        case PlantKind::tall_bush:
            return {{.046F, .080F, .028F}, {.095F, .120F, .036F}};
        default:
            return {{.060F, .105F, .026F}, {.085F, .120F, .028F}};
    }
}

/// Blossoms among the leaves: how many of the bunches, and their colour.
float blossoms(PlantKind kind, std::uint32_t style, Color& color) {
    static const std::array<Color, 4> flowers{Color(.55F, .10F, .20F),
                                              Color(.60F, .50F, .52F),
                                              Color(.50F, .36F, .06F),
                                              Color(.26F, .14F, .42F)};
    if (kind == PlantKind::flowering_bush) {
        color = flowers[hash(style, 3) % flowers.size()];
        return 0.30F;
    }
    color = Color(.66F, .44F, .48F);
    return kind == PlantKind::cherry && hash(style, 4) % 2 == 0 ? 0.85F : 0.0F;
}

/// Leaves on a bunch, or on the solid inside of a bough: patches that lean all ways, some in the
/// shade of others.
void dapple(Look& look, const Surface& at, float strength) {
    const float near = detail(at, 0.25F);
    if (near <= 0) {
        look.albedo *= 1 - 0.45F * strength;  // the mean of patches that no pixel can show
        look.normal = at.normal.normalized();
        return;
    }
    Eigen::Vector3f p = at.position * 8.0F;
    if (at.tag == 0) {
        // The large faces inside show the lattice of patches: bent until no edge is straight.
        p.x() += 1.5F * value_noise(p.y() * 1.9F, p.z() * 1.9F + 0.3F * p.x(), 10);
        p.y() += 1.5F * value_noise(p.z() * 1.9F + 0.3F * p.y(), p.x() * 1.9F, 11);
        p.z() += 1.5F * value_noise(p.x() * 1.9F + 0.3F * p.z(), p.y() * 1.9F, 12);
    }
    const float bend = 2 * value_noise(p.x() * 0.7F + p.z() * 0.4F, p.y() * 0.7F - p.z() * 0.5F, 9);
    const int column = floor_int(p.x() + bend + 0.5F * p.z());
    const int row = floor_int(p.y() - bend + 0.3F * p.x());
    const int level = floor_int(p.z() * 1.3F + bend);
    const std::uint32_t patch = hash(static_cast<std::uint32_t>(column),
                                     static_cast<std::uint32_t>(row),
                                     static_cast<std::uint32_t>(level));
    look.albedo *= mix(1 - 0.45F * strength, 1 + strength * (0.75F * unit(patch) - 0.75F), near);
    const Eigen::Vector3f lean(
        unit(hash(patch, 1)) - 0.5F, unit(hash(patch, 2)) - 0.5F, unit(hash(patch, 3)) - 0.5F);
    look.normal = (at.normal + 1.5F * strength * near * lean).normalized();
}

}  // namespace

Look plant_leaf_look(const Surface& at) {
    Look look;
    const auto kind = static_cast<PlantKind>(at.instance->model);
    const std::uint32_t style = at.instance->style;
    const Greens greens = greens_of(kind);
    const float hue = unit(hash(style, 5));
    Color green = mix(greens.dark, greens.bright, hue);
    if (kind == PlantKind::maple && hash(style, 9) % 6 == 0)
        green = Color(.150F, .040F, .026F);
    const float own = unit(hash(at.tag, 6));
    const float patch =
        value_noise(at.position.x() * 0.9F, at.position.y() * 0.9F + at.position.z(), 8);
    look.albedo = green * (0.90F + 0.55F * own + 0.40F * patch);
    Color flower;
    const bool blooms = unit(hash(at.tag, 7)) < blossoms(kind, style, flower);
    if (blooms)
        look.albedo = flower * (0.75F + 0.4F * own);
    look.translucency = at.tag == 0 ? 0 : 0.42F;
    look.f0 = 0.02F;
    look.normal = at.normal;
    dapple(look, at, at.tag == 0 ? 1.0F : 0.4F);
    return look;
}

Look plant_bark_look(const Surface& at) {
    Look look;
    const auto kind = static_cast<PlantKind>(at.instance->model);
    const float x = at.position.x() * 14 + at.position.y() * 11;
    const float grain = value_noise(x, at.position.z() * 3);
    look.albedo = Color(.13F, .10F, .075F) * (0.6F + 0.7F * grain * detail(at, 0.1F));
    if (kind == PlantKind::birch) {
        // White, with dark bands across.
        const float band = value_noise(x * 0.3F, at.position.z() * 9, 2);
        look.albedo =
            mix(Color(.56F, .54F, .49F), Color(.06F, .055F, .05F), smooth_step(.66F, .76F, band));
    } else if (kind == PlantKind::plane) {
        const float flake = value_noise(x * 0.5F, at.position.z() * 4, 4);
        look.albedo =
            mix(Color(.36F, .34F, .24F), Color(.20F, .18F, .14F), smooth_step(.42F, .58F, flake));
    } else if (kind == PlantKind::pine) {
        look.albedo = mix(
            look.albedo, Color(.27F, .13F, .07F), 0.6F * smooth_step(0.35F, 0.6F, at.local.z()));
    } else if (kind == PlantKind::cherry) {
        look.albedo *= Color(.9F, .7F, .7F);
    }
    look.normal = at.normal;
    return look;
}

}  // namespace reprise::render
