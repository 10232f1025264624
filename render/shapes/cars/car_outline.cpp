#include "render/shapes/cars/car_outline.h"

#include <array>

namespace reprise::render {

namespace {

// Drawn after typical vehicles of each kind, none in particular.
// clang-format off
constexpr Knot sedan_top[]{{0, .4F}, {.004F, .6F}, {.02F, .705F}, {.06F, .72F}, {.155F, .745F},
    {.3F, .955F}, {.38F, .993F}, {.46F, 1}, {.55F, .985F}, {.6F, .95F}, {.765F, .69F},
    {.8F, .668F}, {.9F, .63F}, {.96F, .575F}, {.985F, .525F}, {.997F, .47F}, {1, .42F}};
constexpr Knot sedan_belt[]{{0, .38F}, {.02F, .66F}, {.06F, .675F}, {.45F, .655F}, {.77F, .635F},
    {.9F, .6F}, {.965F, .545F}, {.99F, .49F}, {1, .4F}};
constexpr Knot sedan_plan[]{{0, .82F}, {.015F, .9F}, {.06F, .955F}, {.16F, .985F}, {.35F, 1},
    {.7F, 1}, {.86F, .985F}, {.93F, .95F}, {.97F, .89F}, {.99F, .82F}, {1, .74F}};
constexpr Knot hatch_top[]{{0, .4F}, {.004F, .58F}, {.02F, .7F}, {.045F, .74F}, {.12F, .93F},
    {.17F, .965F}, {.3F, 1}, {.47F, .995F}, {.55F, .955F}, {.735F, .705F}, {.77F, .685F},
    {.88F, .65F}, {.95F, .595F}, {.982F, .535F}, {.996F, .47F}, {1, .42F}};
constexpr Knot hatch_belt[]{{0, .38F}, {.02F, .64F}, {.05F, .68F}, {.3F, .665F}, {.74F, .645F},
    {.88F, .615F}, {.955F, .56F}, {.987F, .5F}, {1, .4F}};
constexpr Knot hatch_plan[]{{0, .84F}, {.015F, .91F}, {.07F, .96F}, {.18F, .99F}, {.35F, 1},
    {.7F, 1}, {.86F, .98F}, {.93F, .945F}, {.97F, .88F}, {.99F, .81F}, {1, .74F}};
constexpr Knot suv_top[]{{0, .4F}, {.004F, .58F}, {.015F, .69F}, {.03F, .73F}, {.085F, .93F},
    {.13F, .965F}, {.26F, 1}, {.46F, .998F}, {.545F, .955F}, {.71F, .715F}, {.75F, .7F},
    {.89F, .672F}, {.955F, .625F}, {.985F, .565F}, {.997F, .49F}, {1, .43F}};
constexpr Knot suv_belt[]{{0, .38F}, {.015F, .63F}, {.04F, .665F}, {.3F, .655F}, {.72F, .648F},
    {.89F, .63F}, {.96F, .585F}, {.99F, .525F}, {1, .41F}};
constexpr Knot suv_plan[]{{0, .84F}, {.015F, .92F}, {.06F, .965F}, {.16F, .99F}, {.35F, 1},
    {.72F, 1}, {.88F, .985F}, {.94F, .95F}, {.975F, .89F}, {.99F, .83F}, {1, .76F}};
constexpr Knot van_top[]{{0, .22F}, {.004F, .7F}, {.012F, .94F}, {.04F, .985F}, {.2F, 1},
    {.62F, 1}, {.7F, .965F}, {.845F, .66F}, {.875F, .625F}, {.95F, .565F}, {.985F, .49F},
    {.997F, .4F}, {1, .34F}};
constexpr Knot van_belt[]{{0, .2F}, {.012F, .54F}, {.3F, .55F}, {.82F, .555F}, {.9F, .55F},
    {.965F, .515F}, {.99F, .45F}, {1, .32F}};
constexpr Knot van_plan[]{{0, .92F}, {.01F, .96F}, {.04F, .985F}, {.15F, 1}, {.75F, 1},
    {.88F, .98F}, {.94F, .945F}, {.975F, .885F}, {.99F, .82F}, {1, .75F}};
constexpr Knot lorry_top[]{{.735F, .30F}, {.738F, .82F}, {.745F, .88F}, {.78F, .905F},
    {.90F, .90F}, {.945F, .875F}, {.985F, .52F}, {.995F, .35F}, {1, .20F}};
constexpr Knot lorry_belt[]{{.735F, .28F}, {.738F, .50F}, {.98F, .50F}, {.993F, .33F}, {1, .18F}};
constexpr Knot lorry_plan[]{{.735F, .95F}, {.745F, .98F}, {.80F, .985F}, {.955F, .975F},
    {.985F, .95F}, {1, .88F}};
constexpr Knot bus_top[]{{0, .14F}, {.002F, .55F}, {.005F, .94F}, {.014F, .985F}, {.06F, 1},
    {.93F, 1}, {.972F, .985F}, {.984F, .95F}, {.996F, .40F}, {1, .17F}};
constexpr Knot bus_belt[]{{0, .12F}, {.005F, .33F}, {.98F, .33F}, {.995F, .30F}, {1, .15F}};
constexpr Knot bus_plan[]{{0, .93F}, {.004F, .965F}, {.02F, .99F}, {.05F, 1}, {.95F, 1},
    {.982F, .98F}, {.994F, .93F}, {1, .86F}};
constexpr Knot wagon_top[]{{0, .4F}, {.004F, .58F}, {.018F, .69F}, {.035F, .73F}, {.085F, .92F},
    {.12F, .955F}, {.22F, .985F}, {.4F, 1}, {.5F, .993F}, {.575F, .957F}, {.745F, .7F},
    {.78F, .678F}, {.89F, .638F}, {.955F, .58F}, {.984F, .525F}, {.997F, .47F}, {1, .42F}};
constexpr Knot wagon_belt[]{{0, .38F}, {.02F, .65F}, {.05F, .68F}, {.3F, .668F}, {.745F, .642F},
    {.89F, .608F}, {.96F, .55F}, {.99F, .49F}, {1, .4F}};
constexpr Knot wagon_plan[]{{0, .83F}, {.015F, .91F}, {.06F, .96F}, {.16F, .988F}, {.35F, 1},
    {.7F, 1}, {.86F, .985F}, {.93F, .95F}, {.97F, .89F}, {.99F, .82F}, {1, .74F}};
constexpr Knot coupe_top[]{{0, .42F}, {.004F, .62F}, {.015F, .735F}, {.04F, .77F}, {.1F, .79F},
    {.17F, .83F}, {.3F, .955F}, {.38F, .995F}, {.44F, 1}, {.51F, .975F}, {.56F, .93F},
    {.69F, .735F}, {.73F, .705F}, {.85F, .665F}, {.93F, .6F}, {.975F, .52F}, {.996F, .45F},
    {1, .40F}};
constexpr Knot coupe_belt[]{{0, .4F}, {.02F, .69F}, {.06F, .72F}, {.2F, .725F}, {.45F, .69F},
    {.69F, .665F}, {.85F, .635F}, {.94F, .575F}, {.985F, .49F}, {1, .38F}};
constexpr Knot coupe_plan[]{{0, .84F}, {.015F, .92F}, {.06F, .97F}, {.18F, 1}, {.33F, .995F},
    {.5F, .965F}, {.66F, .97F}, {.8F, .99F}, {.9F, .965F}, {.95F, .91F}, {.985F, .81F}, {1, .70F}};
constexpr Knot pickup_top[]{{0, .30F}, {.003F, .50F}, {.008F, .575F}, {.02F, .58F}, {.37F, .582F},
    {.374F, .60F}, {.378F, .88F}, {.39F, .955F}, {.44F, .99F}, {.52F, 1}, {.6F, .985F},
    {.645F, .945F}, {.735F, .70F}, {.76F, .675F}, {.88F, .655F}, {.95F, .615F}, {.982F, .55F},
    {.996F, .46F}, {1, .40F}};
constexpr Knot pickup_belt[]{{0, .28F}, {.008F, .555F}, {.1F, .565F}, {.37F, .57F}, {.4F, .645F},
    {.735F, .645F}, {.88F, .62F}, {.955F, .575F}, {.988F, .5F}, {1, .38F}};
constexpr Knot pickup_plan[]{{0, .93F}, {.008F, .965F}, {.04F, .98F}, {.2F, 1}, {.7F, 1},
    {.86F, .985F}, {.93F, .955F}, {.97F, .90F}, {.99F, .84F}, {1, .78F}};
constexpr Knot minibus_top[]{{0, .2F}, {.004F, .6F}, {.012F, .93F}, {.03F, .98F}, {.1F, 1},
    {.72F, 1}, {.78F, .975F}, {.885F, .62F}, {.905F, .585F}, {.96F, .53F}, {.985F, .47F},
    {.997F, .38F}, {1, .32F}};
constexpr Knot minibus_belt[]{{0, .18F}, {.012F, .48F}, {.3F, .485F}, {.86F, .5F}, {.92F, .51F},
    {.968F, .48F}, {.99F, .42F}, {1, .3F}};
constexpr Knot minibus_plan[]{{0, .93F}, {.01F, .965F}, {.03F, .985F}, {.1F, 1}, {.8F, 1},
    {.9F, .98F}, {.95F, .945F}, {.978F, .885F}, {.992F, .82F}, {1, .75F}};
constexpr Knot plain[]{{0, 1}, {1, 1}};

/// In the order of BodyStyle.
constexpr std::array<Outline, 12> outlines{{
    {hatch_top,   hatch_belt,   hatch_plan,   0,     .115F, .40F, .0F},
    {sedan_top,   sedan_belt,   sedan_plan,   0,     .115F, .42F, .0F},
    {suv_top,     suv_belt,     suv_plan,     0,     .135F, .32F, .15F},
    {van_top,     van_belt,     van_plan,     0,     .115F, .14F, .6F},
    {lorry_top,   lorry_belt,   lorry_plan,   .735F, .14F,  .05F, .8F},
    {bus_top,     bus_belt,     bus_plan,     0,     .09F,  .05F, .9F},
    {wagon_top,   wagon_belt,   wagon_plan,   0,     .115F, .40F, .05F},
    {coupe_top,   coupe_belt,   coupe_plan,   0,     .10F,  .50F, .0F},
    {pickup_top,  pickup_belt,  pickup_plan,  0,     .15F,  .30F, .25F},
    {minibus_top, minibus_belt, minibus_plan, 0,     .09F,  .09F, .7F},
    {plain,       plain,        plain,        0,     .2F,   .0F,  .0F},
    {plain,       plain,        plain,        0,     .2F,   .0F,  .0F},
}};
// clang-format on

}  // namespace

const Outline& outline_of(world::BodyStyle style) {
    return outlines[static_cast<std::size_t>(style)];
}

float interpolate(std::span<const Knot> knots, float x) {
    if (x <= knots.front().x)
        return knots.front().value;
    if (x >= knots.back().x)
        return knots.back().value;
    std::size_t i = 0;
    while (knots[i + 1].x < x)
        ++i;
    const auto slope = [&](std::size_t from) {
        return (knots[from + 1].value - knots[from].value) / (knots[from + 1].x - knots[from].x);
    };
    const auto tangent = [&](std::size_t at) {
        if (at == 0 || at + 1 == knots.size())
            return slope(at == 0 ? 0 : at - 1);
        const float before = slope(at - 1);
        const float after = slope(at);
        return before * after <= 0 ? 0 : 2 * before * after / (before + after);
    };
    const float step = knots[i + 1].x - knots[i].x;
    const float share = (x - knots[i].x) / step;
    const float rest = 1 - share;
    return rest * rest * (1 + 2 * share) * knots[i].value +
           share * rest * rest * step * tangent(i) +
           share * share * (3 - 2 * share) * knots[i + 1].value -
           share * share * rest * step * tangent(i + 1);
}

}  // namespace reprise::render
