#include "render/car_shape.h"

#include <algorithm>
#include <array>
#include <span>

#include "render/fast_math.h"

namespace reprise::render {

namespace {

/// A point of a side or plan view: share of the length from the rear, share of height or half
/// width.
struct Knot {
    float x;
    float value;
};

struct Outline {
    std::span<const Knot> top;
    std::span<const Knot> belt;
    std::span<const Knot> plan;
    float body_start;
    float sill;
    float tumble_home;
    float boxiness;
};

// Drawn after typical cars of each kind, none in particular.
constexpr Knot sedan_top[]{{0, .4F},
                           {.004F, .6F},
                           {.02F, .705F},
                           {.06F, .72F},
                           {.155F, .745F},
                           {.3F, .955F},
                           {.38F, .993F},
                           {.46F, 1},
                           {.55F, .985F},
                           {.6F, .95F},
                           {.765F, .69F},
                           {.8F, .668F},
                           {.9F, .63F},
                           {.96F, .575F},
                           {.985F, .525F},
                           {.997F, .47F},
                           {1, .42F}};
constexpr Knot sedan_belt[]{{0, .38F},
                            {.02F, .66F},
                            {.06F, .675F},
                            {.45F, .655F},
                            {.77F, .635F},
                            {.9F, .6F},
                            {.965F, .545F},
                            {.99F, .49F},
                            {1, .4F}};
constexpr Knot sedan_plan[]{{0, .82F},
                            {.015F, .9F},
                            {.06F, .955F},
                            {.16F, .985F},
                            {.35F, 1},
                            {.7F, 1},
                            {.86F, .985F},
                            {.93F, .95F},
                            {.97F, .89F},
                            {.99F, .82F},
                            {1, .74F}};
constexpr Knot hatch_top[]{{0, .4F},
                           {.004F, .58F},
                           {.02F, .7F},
                           {.045F, .74F},
                           {.12F, .93F},
                           {.17F, .965F},
                           {.3F, 1},
                           {.47F, .995F},
                           {.55F, .955F},
                           {.735F, .705F},
                           {.77F, .685F},
                           {.88F, .65F},
                           {.95F, .595F},
                           {.982F, .535F},
                           {.996F, .47F},
                           {1, .42F}};
constexpr Knot hatch_belt[]{{0, .38F},
                            {.02F, .64F},
                            {.05F, .68F},
                            {.3F, .665F},
                            {.74F, .645F},
                            {.88F, .615F},
                            {.955F, .56F},
                            {.987F, .5F},
                            {1, .4F}};
constexpr Knot hatch_plan[]{{0, .84F},
                            {.015F, .91F},
                            {.07F, .96F},
                            {.18F, .99F},
                            {.35F, 1},
                            {.7F, 1},
                            {.86F, .98F},
                            {.93F, .945F},
                            {.97F, .88F},
                            {.99F, .81F},
                            {1, .74F}};
constexpr Knot suv_top[]{{0, .4F},
                         {.004F, .58F},
                         {.015F, .69F},
                         {.03F, .73F},
                         {.085F, .93F},
                         {.13F, .965F},
                         {.26F, 1},
                         {.46F, .998F},
                         {.545F, .955F},
                         {.71F, .715F},
                         {.75F, .7F},
                         {.89F, .672F},
                         {.955F, .625F},
                         {.985F, .565F},
                         {.997F, .49F},
                         {1, .43F}};
constexpr Knot suv_belt[]{{0, .38F},
                          {.015F, .63F},
                          {.04F, .665F},
                          {.3F, .655F},
                          {.72F, .648F},
                          {.89F, .63F},
                          {.96F, .585F},
                          {.99F, .525F},
                          {1, .41F}};
constexpr Knot suv_plan[]{{0, .84F},
                          {.015F, .92F},
                          {.06F, .965F},
                          {.16F, .99F},
                          {.35F, 1},
                          {.72F, 1},
                          {.88F, .985F},
                          {.94F, .95F},
                          {.975F, .89F},
                          {.99F, .83F},
                          {1, .76F}};
constexpr Knot van_top[]{{0, .22F},
                         {.004F, .7F},
                         {.012F, .94F},
                         {.04F, .985F},
                         {.2F, 1},
                         {.62F, 1},
                         {.7F, .965F},
                         {.845F, .66F},
                         {.875F, .625F},
                         {.95F, .565F},
                         {.985F, .49F},
                         {.997F, .4F},
                         {1, .34F}};
constexpr Knot van_belt[]{{0, .2F},
                          {.012F, .54F},
                          {.3F, .55F},
                          {.82F, .555F},
                          {.9F, .55F},
                          {.965F, .515F},
                          {.99F, .45F},
                          {1, .32F}};
constexpr Knot van_plan[]{{0, .92F},
                          {.01F, .96F},
                          {.04F, .985F},
                          {.15F, 1},
                          {.75F, 1},
                          {.88F, .98F},
                          {.94F, .945F},
                          {.975F, .885F},
                          {.99F, .82F},
                          {1, .75F}};
constexpr Knot lorry_top[]{{.735F, .30F},
                           {.738F, .82F},
                           {.745F, .88F},
                           {.78F, .905F},
                           {.90F, .90F},
                           {.945F, .875F},
                           {.985F, .52F},
                           {.995F, .35F},
                           {1, .20F}};
constexpr Knot lorry_belt[]{{.735F, .28F}, {.738F, .50F}, {.98F, .50F}, {.993F, .33F}, {1, .18F}};
constexpr Knot lorry_plan[]{
    {.735F, .95F}, {.745F, .98F}, {.80F, .985F}, {.955F, .975F}, {.985F, .95F}, {1, .88F}};
constexpr Knot bus_top[]{{0, .14F},
                         {.002F, .55F},
                         {.005F, .94F},
                         {.014F, .985F},
                         {.06F, 1},
                         {.93F, 1},
                         {.972F, .985F},
                         {.984F, .95F},
                         {.996F, .40F},
                         {1, .17F}};
constexpr Knot bus_belt[]{{0, .12F}, {.005F, .33F}, {.98F, .33F}, {.995F, .30F}, {1, .15F}};
constexpr Knot bus_plan[]{{0, .93F},
                          {.004F, .965F},
                          {.02F, .99F},
                          {.05F, 1},
                          {.95F, 1},
                          {.982F, .98F},
                          {.994F, .93F},
                          {1, .86F}};

/// In the order of BodyStyle.
constexpr std::array<Outline, 6> outlines{{
    {hatch_top, hatch_belt, hatch_plan, 0, .115F, .40F, .0F},
    {sedan_top, sedan_belt, sedan_plan, 0, .115F, .42F, .0F},
    {suv_top, suv_belt, suv_plan, 0, .135F, .32F, .15F},
    {van_top, van_belt, van_plan, 0, .115F, .14F, .6F},
    {lorry_top, lorry_belt, lorry_plan, .735F, .14F, .05F, .8F},
    {bus_top, bus_belt, bus_plan, 0, .09F, .05F, .9F},
}};

const Outline& outline(world::BodyStyle style) {
    return outlines[static_cast<std::size_t>(style)];
}

/// A cubic through the knots whose slopes never overshoot (harmonic mean: Fritsch and Butland, "A
/// method for constructing local monotone piecewise cubic interpolants", 1984).
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

}  // namespace

CarShape::CarShape(const world::VehicleModel& of)
    : model(&of),
      style(of.body),
      rear(static_cast<float>(-of.rear_overhang)),
      front(static_cast<float>(of.length - of.rear_overhang)) {
    const Outline& lines = outline(style);
    body_rear = rear + lines.body_start * length();
    sill = lines.sill * height();
    tumble_home = lines.tumble_home;
    boxiness = lines.boxiness;
}

float CarShape::top(float x) const {
    return interpolate(outline(style).top, along(x)) * height();
}

float CarShape::belt(float x) const {
    return std::min(interpolate(outline(style).belt, along(x)) * height(), top(x) - 0.012F);
}

float CarShape::half_width(float x) const {
    return interpolate(outline(style).plan, along(x)) * static_cast<float>(model->width) * 0.5F;
}

}  // namespace reprise::render
