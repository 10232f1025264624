#include "render/look/veil.h"

#include "world/weather/air.h"

namespace reprise::render {

namespace {

constexpr float thick_layer = 120;  // [m] of fog, rain or dust that hides the sky

/// Desert dust: what it does not scatter it takes from the blue.
const Color dusty(0.86F, 0.64F, 0.39F);

}  // namespace

Veil::Veil(const world::Weather& weather)
    : fog_(weather.fog_extinction()),
      base_(weather.fog_base()),
      falloff_(weather.fog_falloff()),
      even_(static_cast<float>(world::even_extinction(weather))) {
    // The haze of a clear day belongs to the sky already: only what is thicker hides it.
    const auto hiding = [](float extinction) {
        return extinction * extinction / (extinction + 1e-3F);
    };
    const float layer = base_ + 1 / (falloff_ + 1 / thick_layer);
    upwards_ = hiding(fog_) * layer + hiding(even_) * thick_layer;
    tint_ = mix(Color::Ones(), dusty, weather.dust() / (extinction() + 1e-6F));
}

float Veil::passes(float from, float rise, float distance) const {
    float fog = fog_ * distance;
    if (falloff_ > 0 && fog_ > 0) {
        // Below its base the fog is even; above, the integral of e^(-k h) has a closed form.
        const float start = from - ground_;
        const float end = start + rise * distance;
        const float low = std::min(start, end) - base_;
        const float high = std::max(start, end) - base_;
        const float climb = high - low;
        const float above_low = std::max(low, 0.0F);
        const float above_high = std::max(high, 0.0F);
        const float k = falloff_ * (above_high - above_low);
        // (1 - e^-k) / k by its series where k is small.
        const float mean = k < 1e-2F ? 1 - 0.5F * k + 0.16666667F * k * k : (1 - fast_exp(-k)) / k;
        const float column = fast_exp(-falloff_ * above_low) * mean * (above_high - above_low) +
                             std::max(0.0F, std::min(high, 0.0F) - low);
        fog *= climb > 1e-3F ? column / climb : fast_exp(-falloff_ * above_low);
    }
    return fast_exp(-(even_ * distance + fog));
}

}  // namespace reprise::render
