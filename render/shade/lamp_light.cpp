#include "render/shade/lamp_light.h"

#include <algorithm>

#include "render/shade/highlight.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr float beyond = 3000;  // [m] where the moon's rays end

/// Does a source shine past a place for sure? lobe_share() says so exactly, but asks for a root and
/// divisions first: most sources of a square are lamps that look elsewhere.
bool shines_past(const LightSource& source, const Vector3f& to_source, float squared) {
    const float ahead = -to_source.dot(source.axis);
    switch (source.lobe) {
        case LightSource::Lobe::street:  // from a tenth of a right angle's sine on
            return to_source.z() <= 0 || to_source.z() * to_source.z() < 0.0099F * squared;
        case LightSource::Lobe::low_beam:  // from a quarter on
            return ahead <= 0 || ahead * ahead < 0.062F * squared;
        case LightSource::Lobe::lens:
        case LightSource::Lobe::window:
            return ahead < 0 && ahead * ahead > 1e-6F * squared;
        default:
            return false;
    }
}

}  // namespace

LampSum::LampSum(const ShadingInput& input,
                 const SourceGrid& grid,
                 const Look& look,
                 const Vector3f& position,
                 const Vector3f& view)
    : moon_(input.sky.moon()) {
    for (const std::uint16_t index : grid.near(position))
        add_source(grid.source(index), look, position, view);
    add_moon(look);
}

void LampSum::add_source(const LightSource& source,
                         const Look& look,
                         const Vector3f& position,
                         const Vector3f& view) {
    const Vector3f to_source = source.position - position;
    const float squared = to_source.squaredNorm();
    const float reach = source.reach * source.reach;
    if (squared >= reach)
        return;
    const float towards = look.normal.dot(to_source);
    if (towards <= 0 && look.translucency <= 0)
        return;
    if (shines_past(source, to_source, squared))
        return;
    const float away = std::sqrt(std::max(squared, 0.04F));
    const Vector3f way = to_source / away;
    const float facing = towards / away;
    const float incidence = std::max(facing, -facing * look.translucency);
    const float share = lobe_share(source, -way);
    if (share <= 0)
        return;
    const float fade = 1 - squared / reach;
    const float falls = share * fade * fade / std::max(squared, 0.3F);
    const Color arrives = source.intensity * (falls * incidence);
    const float gives = luminance(arrives);
    light_.arriving += arrives;
    parts_[count_++] = {to_source, gives, source.radius};
    sum_ += gives;
    // Panes and paint show lamps as a picture, see the mirror rays; dull ground does not shine.
    if (look.roughness > 0.5F || look.roughness < 0.1F || facing <= 0)
        return;
    const Vector3f half = (way - view).normalized();
    const float shine = fresnel(look.f0, half.dot(way)) *
                        highlight(look.roughness, std::max(0.0F, half.dot(look.normal)));
    // A head lamp's mirror is wide: just before the car its highlight is a pale spot, not a point.
    const float point = source.lobe == LightSource::Lobe::low_beam ? 0.35F : 1.0F;
    light_.shine += arrives * (pi * point * std::min(shine, 20.0F));
}

void LampSum::add_moon(const Look& look) {
    const float facing = look.normal.dot(moon_.to_moon);
    const float incidence = std::max(facing, -facing * look.translucency);
    const Color arrives = moon_.light * (std::max(incidence, 0.0F) / pi);
    const float gives = luminance(arrives);
    if (gives <= 0)
        return;
    light_.arriving += arrives;
    parts_[count_++] = {moon_.to_moon * beyond, gives, 14};
    sum_ += gives;
}

Vector3f LampSum::towards(float place, const Eigen::Vector2f& spot) const {
    float left = place * sum_;
    std::size_t chosen = 0;
    while (chosen + 1 < count_ && left >= parts_[chosen].gives)
        left -= parts_[chosen++].gives;
    const Part& part = parts_[chosen];
    const Vector3f across = part.to_source.unitOrthogonal();
    const Vector3f up = across.cross(part.to_source).normalized();
    return part.to_source + part.radius * (spot.x() * across + spot.y() * up);
}

}  // namespace reprise::render
