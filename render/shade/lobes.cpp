#include "render/shade/lobes.h"

#include "render/shapes/fast_math.h"

namespace reprise::render {

namespace {

using Lobe = LightSource::Lobe;

__m128 four(float value) {
    return _mm_set1_ps(value);
}

__m128 at_least(float least, __m128 x) {
    return _mm_max_ps(x, four(least));
}

/// (1 + x^2)^2
__m128 bell(__m128 x) {
    const __m128 root = four(1) + x * x;
    return root * root;
}

/// One over what is left so far below the brightest place: 1 + x^2 + 0.35 x^3.
__m128 falling(__m128 x) {
    return four(1) + x * x * (four(1) + four(0.35F) * x);
}

/// After ECE R112: a hot spot just below a line half a degree under the horizon, which on the
/// kerb's side rises by 15 degrees, and a wide carpet before the car; a little is let through
/// above, for signs. The line alone is an edge: to the sides and downwards both end softly.
__m128 low_beam_shares(const FourSources& sources, const Lanes3& way, __m128 ahead) {
    const __m128 narrowest = four(0.25F);
    const __m128 lit = _mm_cmpge_ps(ahead, narrowest);
    if (_mm_movemask_ps(lit) == 0)
        return _mm_setzero_ps();
    const __m128 scale = four(1) / _mm_max_ps(ahead, narrowest);
    const __m128 side = way.dot(sources.left) * scale;
    const __m128 rise = way.dot(sources.up) * scale;
    const __m128 line = four(0.26F) * _mm_min_ps(at_least(0, -side), four(0.12F)) - four(0.010F);
    const __m128 below = line - rise;
    // Sharp ahead, for who comes; to the sides mirrors blur it, and facades show no edge.
    const __m128 aside = at_least(0, _mm_max_ps(side, -side) - four(0.10F));
    const __m128 cut = smooth_step(-1, 1, below / (four(0.010F) + four(0.06F) * aside));
    const __m128 drop = at_least(0, below);
    const __m128 spot = bell(side * four(1 / 0.20F)) * falling(drop * four(1 / 0.028F));
    const __m128 carpet = bell(side) * falling(drop * four(1 / 0.070F));
    // 0.77 / spot + 0.23 / carpet, by one division.
    const __m128 share = (four(0.77F) * carpet + four(0.23F) * spot) / (spot * carpet);
    return _mm_and_ps(
        lit, share * (four(0.012F) + four(0.988F) * cut) * smooth_step(0.25F, 0.5F, ahead));
}

}  // namespace

SourceRow::SourceRow(const LightSource& source)
    : position(source.position),
      narrows(1 / (source.reach * source.reach)),
      axis(source.axis),
      lobe(static_cast<float>(source.lobe)),
      left(source.left),
      luminance(render::luminance(source.intensity)),
      up(source.axis.cross(source.left)),
      radius(source.radius),
      intensity(source.intensity.x(), source.intensity.y(), source.intensity.z()) {}

__m128 lobe_shares(const FourSources& sources, const Lanes3& way) {
    __m128 shares = _mm_setzero_ps();
    const auto add = [&](Lobe lobe, __m128 share) {
        const __m128 is = _mm_cmpeq_ps(sources.lobe, four(static_cast<float>(lobe)));
        shares = _mm_or_ps(shares, _mm_and_ps(is, share));
    };
    const __m128 ahead = way.dot(sources.axis);
    const __m128 forward = at_least(0, ahead);
    // Lamps that are alike stand together, see SourceGrid: most fours have one kind or two.
    if (sources.any(Lobe::low_beam)) {
        const __m128 is = _mm_cmpeq_ps(sources.lobe, four(static_cast<float>(Lobe::low_beam)));
        shares = low_beam_shares(sources, way, _mm_and_ps(is, ahead));
    }
    if (sources.any(Lobe::street))
        add(Lobe::street, smooth_step(0.10F, 0.42F, -way.z) * (four(1.3F) + four(0.6F) * way.z));
    if (sources.any(Lobe::lantern))
        add(Lobe::lantern, smooth_step(0.75F, 0.2F, way.z));
    if (sources.any(Lobe::lens) || sources.any(Lobe::signal)) {
        const __m128 fourth = forward * forward * forward * forward;
        const __m128 lens = fourth * fourth;
        add(Lobe::lens, lens);  // ECE R6, R7: a half or less 25 degrees off
        // EN 12368, wide: about a half 12 degrees off, a hundredth at 30.
        add(Lobe::signal, (lens * lens) * (lens * lens));
    }
    if (sources.any(Lobe::window))
        add(Lobe::window, forward);
    return shares;
}

}  // namespace reprise::render
