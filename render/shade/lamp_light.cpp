#include "render/shade/lamp_light.h"

#include <algorithm>
#include <bit>

#include "render/shade/highlight.h"
#include "render/shade/lobes.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

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

/// Of all four.
float sum_of(__m128 four) {
    const __m128 pairs = _mm_add_ps(four, _mm_movehl_ps(four, four));
    return _mm_cvtss_f32(_mm_add_ss(pairs, _mm_shuffle_ps(pairs, pairs, 1)));
}

constexpr float dull = 0.5F;  ///< roughness from which on nothing shines

/// Panes and paint show lamps as a picture, see the mirror rays; dull ground does not shine.
bool shines(const Look& look) {
    return look.roughness <= dull && look.roughness >= 0.1F;
}

}  // namespace

LampSum::LampSum(const ShadingInput& input,
                 NearSources& near,
                 const Look& look,
                 const Vector3f& position,
                 const Vector3f& view)
    : near_(near),
      moon_(input.sky.moon()),
      position_(position),
      arriving_(Vector3f::Zero()) {
    near.gather(position);
    const bool shining = shines(look);
    if (shining)
        shines_.fill(0);
    const Lanes3 place(position);
    for (; count_ < near.size(); count_ += 4) {
        add_four(count_, look, place);
        if (shining)
            add_shine(count_, look, view);
    }
    light_.arriving = Color(sum_of(arriving_.x), sum_of(arriving_.y), sum_of(arriving_.z));
    find_strongest();
    add_moon(look);
    part();
    const float white = 1 / input.sky.exposure();
    light_.arriving = held_back(light_.arriving, brightest * white);
    // A lobe that ended all at once would leave an outline where ground gets dull.
    if (shining)
        light_.shine *= smooth_step(dull, 0.36F, look.roughness);
    light_.shine = held_back(light_.shine, brightest_shine * white);
}

/// What lobe_share() and the distance leave of each source, lane by lane: a picture asks for 5
/// million of them.
void LampSum::add_four(std::size_t first, const Look& look, const Lanes3& position) {
    const FourSources& four = near_.four(first);
    const Lanes3 to_source = four.position - position;
    const __m128 squared = to_source.dot(to_source);
    const __m128 near =
        _mm_set1_ps(1) / _mm_sqrt_ps(_mm_max_ps(squared, _mm_set1_ps(0.04F)));  // 1 / distance
    const __m128 facing = to_source.dot(Lanes3(look.normal)) * near;
    const __m128 incidence = _mm_max_ps(facing, -facing * _mm_set1_ps(look.translucency));
    const __m128 fade = _mm_set1_ps(1) - squared * four.narrows;
    const __m128 none = _mm_setzero_ps();
    const __m128 reached =
        _mm_and_ps(among_first(near_.size() - first),
                   _mm_and_ps(_mm_cmpgt_ps(fade, none), _mm_cmpgt_ps(incidence, none)));
    __m128 factor = none;
    if (_mm_movemask_ps(reached) != 0) {
        const __m128 share = lobe_shares(four, -(to_source * near));
        const __m128 falls = share * fade * fade / _mm_max_ps(squared, _mm_set1_ps(0.3F));
        factor = _mm_and_ps(_mm_and_ps(reached, _mm_cmpgt_ps(share, none)), falls * incidence);
        arriving_ = arriving_ + four.intensity * factor;
    }
    _mm_store_ps(&factor_[first], factor);
    _mm_store_ps(&gives_[first], factor * four.luminance);
}

/// The highlights of the four that were just added.
void LampSum::add_shine(std::size_t first, const Look& look, const Vector3f& view) {
    for (std::size_t i = first; i < first + 4; ++i) {
        if (factor_[i] <= 0)
            continue;
        const Vector3f to_source = this->to_source(i);
        if (look.normal.dot(to_source) <= 0)
            continue;
        const LightSource& source = near_.source(i);
        const Vector3f way = to_source / std::sqrt(std::max(to_source.squaredNorm(), 0.04F));
        const Vector3f half = (way - view).normalized();
        const float shine = fresnel(look.f0, half.dot(way)) *
                            highlight(look.roughness, std::max(0.0F, half.dot(look.normal)));
        // A head lamp's mirror is wide: just before the car its highlight is a pale spot, not a
        // point.
        const float point = source.lobe == LightSource::Lobe::low_beam ? 0.35F : 1.0F;
        const Color mirrored =
            source.intensity * factor_[i] * (pi * point * std::min(shine, 20.0F));
        light_.shine += mirrored;
        shines_[i] = luminance(mirrored);
        shine_ += shines_[i];
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
    shines_[count_] = 0;
    gives_[count_] = gives;
    if (count_ == 0 || gives > gives_[strongest_])
        strongest_ = count_;
    ++count_;
    sum_ += gives;
}

/// Of several the first.
void LampSum::find_strongest() {
    __m128 sums = _mm_setzero_ps();
    __m128 most = _mm_setzero_ps();
    for (std::size_t i = 0; i < count_; i += 4) {
        const __m128 gives = _mm_load_ps(&gives_[i]);
        sums += gives;
        most = _mm_max_ps(most, gives);
    }
    sum_ = sum_of(sums);
    const __m128 two = _mm_max_ps(most, _mm_movehl_ps(most, most));
    const __m128 one = _mm_max_ss(two, _mm_shuffle_ps(two, two, 1));
    const __m128 strongest = _mm_shuffle_ps(one, one, 0);
    for (std::size_t i = 0; i < count_; i += 4) {
        const int there = _mm_movemask_ps(_mm_cmpeq_ps(_mm_load_ps(&gives_[i]), strongest));
        if (there != 0) {
            strongest_ =
                i + static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(there)));
            return;
        }
    }
}

/// Says what share the strongest source has: of what arrives, which changes little from pixel to
/// pixel, so that neighbours ask the same one; highlights dance with each ripple.
void LampSum::part() {
    if (sum_ <= 0)
        return;
    rest_ = sum_ - gives_[strongest_];
    light_.strongest = gives_[strongest_] / sum_;
    light_.strongest_shine = shine_ > 0 ? shines_[strongest_] / shine_ : light_.strongest;
}

}  // namespace reprise::render
