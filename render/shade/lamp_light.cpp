#include "render/shade/lamp_light.h"

#include <algorithm>

#include "render/shade/highlight.h"
#include "render/shade/lobes.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

constexpr float beyond = 3000;  // [m] where the moon's rays end

/// What a white surface, and a wet one's highlights, send back at most, white in the picture being
/// 1: lamps near by outshine a street by a hundred times, and film would show all of it white.
constexpr float brightest = 3.0F;
constexpr float brightest_shine = 2.0F;

/// Nears `most` instead of growing beyond it; in what is dim hardly anything changes.
Color held_back(const Color& light, float most) {
    return light * (most / (most + light.maxCoeff()));
}

/// Which of four are among the first so many.
__m128 among_first(std::size_t count) {
    const __m128i places = _mm_setr_epi32(0, 1, 2, 3);
    return _mm_castsi128_ps(_mm_cmplt_epi32(places, _mm_set1_epi32(static_cast<int>(count))));
}

/// Panes and paint show lamps as a picture, see the mirror rays; dull ground does not shine.
bool shines(const Look& look) {
    return look.roughness <= 0.5F && look.roughness >= 0.1F;
}

}  // namespace

LampSum::LampSum(const ShadingInput& input,
                 const SourceGrid& grid,
                 const Look& look,
                 const Vector3f& position,
                 const Vector3f& view)
    : moon_(input.sky.moon()) {
    const std::span<const std::uint16_t> near = grid.near(position);
    const bool shining = shines(look);
    if (shining)
        shines_.fill(0);
    for (; count_ < near.size(); count_ += 4) {
        add_four(grid, &near[count_], near.size() - count_, look, position);
        if (shining)
            add_shine(grid, &near[count_], look, view);
    }
    add_moon(look);
    part(shining);
    const float white = 1 / input.sky.exposure();
    light_.arriving = held_back(light_.arriving, brightest * white);
    light_.shine = held_back(light_.shine, brightest_shine * white);
}

/// What lobe_share() and the distance leave of each source, lane by lane: a picture asks for 5
/// million of them.
void LampSum::add_four(const SourceGrid& grid,
                       const std::uint16_t* sources,
                       std::size_t count,
                       const Look& look,
                       const Vector3f& position) {
    const FourSources four(
        grid.row(sources[0]), grid.row(sources[1]), grid.row(sources[2]), grid.row(sources[3]));
    const Lanes3 to_source = four.position - Lanes3(position);
    const __m128 squared = to_source.dot(to_source);
    const __m128 near =
        _mm_set1_ps(1) / _mm_sqrt_ps(_mm_max_ps(squared, _mm_set1_ps(0.04F)));  // 1 / distance
    const __m128 facing = to_source.dot(Lanes3(look.normal)) * near;
    const __m128 incidence = _mm_max_ps(facing, -facing * _mm_set1_ps(look.translucency));
    const __m128 share = lobe_shares(four, -(to_source * near));
    const __m128 fade = _mm_set1_ps(1) - squared * four.narrows;
    const __m128 none = _mm_setzero_ps();
    const __m128 reached =
        _mm_and_ps(_mm_and_ps(among_first(count), _mm_cmpgt_ps(fade, none)),
                   _mm_and_ps(_mm_cmpgt_ps(share, none), _mm_cmpgt_ps(incidence, none)));
    const __m128 falls = share * fade * fade / _mm_max_ps(squared, _mm_set1_ps(0.3F));
    const __m128 factor = _mm_and_ps(reached, falls * incidence);
    const __m128 gives = factor * four.luminance;
    _mm_store_ps(&to_source_x_[count_], to_source.x);
    _mm_store_ps(&to_source_y_[count_], to_source.y);
    _mm_store_ps(&to_source_z_[count_], to_source.z);
    _mm_store_ps(&radius_[count_], four.radius);
    _mm_store_ps(&factor_[count_], factor);
    _mm_store_ps(&gives_[count_], gives);
    // What gives nothing adds nothing.
    for (std::size_t i = 0; i < 4; ++i)
        light_.arriving += grid.source(sources[i]).intensity * factor_[count_ + i];
    const __m128 pairs = _mm_add_ps(gives, _mm_movehl_ps(gives, gives));
    sum_ += _mm_cvtss_f32(_mm_add_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
}

/// The highlights of the four that were just added.
void LampSum::add_shine(const SourceGrid& grid,
                        const std::uint16_t* sources,
                        const Look& look,
                        const Vector3f& view) {
    for (std::size_t i = 0; i < 4; ++i) {
        const Vector3f to_source = this->to_source(count_ + i);
        if (factor_[count_ + i] <= 0 || look.normal.dot(to_source) <= 0)
            continue;
        const LightSource& source = grid.source(sources[i]);
        const Vector3f way = to_source / std::sqrt(std::max(to_source.squaredNorm(), 0.04F));
        const Vector3f half = (way - view).normalized();
        const float shine = fresnel(look.f0, half.dot(way)) *
                            highlight(look.roughness, std::max(0.0F, half.dot(look.normal)));
        // A head lamp's mirror is wide: just before the car its highlight is a pale spot, not a
        // point.
        const float point = source.lobe == LightSource::Lobe::low_beam ? 0.35F : 1.0F;
        const Color mirrored =
            source.intensity * factor_[count_ + i] * (pi * point * std::min(shine, 20.0F));
        light_.shine += mirrored;
        shines_[count_ + i] = luminance(mirrored);
    }
}

void LampSum::add_moon(const Look& look) {
    const float facing = look.normal.dot(moon_.to_moon);
    const float incidence = std::max(facing, -facing * look.translucency);
    const Color arrives = moon_.light * (std::max(incidence, 0.0F) / pi);
    const float gives = luminance(arrives);
    if (gives <= 0)
        return;
    light_.arriving += arrives;
    const Vector3f to_moon = moon_.to_moon * beyond;
    to_source_x_[count_] = to_moon.x();
    to_source_y_[count_] = to_moon.y();
    to_source_z_[count_] = to_moon.z();
    radius_[count_] = 14;
    gives_[count_++] = gives;
    sum_ += gives;
}

/// Says what share the strongest source has: of what arrives, which changes little from pixel to
/// pixel, so that neighbours ask the same one; highlights dance with each ripple.
void LampSum::part(bool shining) {
    float shine = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        shine += shining ? shines_[i] : 0.0F;
        if (gives_[i] > gives_[strongest_])
            strongest_ = i;
    }
    if (sum_ <= 0)
        return;
    rest_ = sum_ - gives_[strongest_];
    if (is_one())
        return;
    light_.strongest = gives_[strongest_] / sum_;
    light_.strongest_shine = shine > 0 ? shines_[strongest_] / shine : light_.strongest;
}

}  // namespace reprise::render
