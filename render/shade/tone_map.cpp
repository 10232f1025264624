#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "render/shade/frame.h"
#include "render/trace/default_float_mode.h"
#include "world/random.h"

namespace reprise::render {

namespace {

constexpr int table_size = 4096;

/// sRGB's curve over the root of the light: dark tones get their share of the entries.
struct SrgbTable {
    SrgbTable() {
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double root = static_cast<double>(i) / (table_size - 1);
            const double light = root * root;
            const double value =
                light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
            values[i] = static_cast<float>(255 * value);
        }
    }

    std::array<float, table_size> values;
};

const SrgbTable srgb;

/// Narkowicz's fit of the ACES film curve, 2015, with a flatter toe: shadows stay readable. Each
/// channel for itself.
Color curve(const Color& x) {
    return (x * (2.51F * x + 0.10F) / (x * (2.43F * x + 0.55F) + 0.16F)).max(0.0F).min(1.0F);
}

}  // namespace

/// Each channel by the curve, so that what is bright turns pale; but lamps of one colour keep it:
/// their brightest channel takes the curve, and the others their share of that.
Color film(const Color& light) {
    const Color curved = curve(light);
    const float most = light.maxCoeff();
    const float least = light.minCoeff();
    if (most < 0.5F || least > 0.15F * most)
        return curved;
    const float pure = smooth_step(0.15F, 0.06F, least / most) * smooth_step(0.5F, 1.2F, most);
    return mix(curved, light * (curve(Color::Constant(most)).x() / most), pure);
}

std::vector<std::uint8_t> tone_map(const Frame& frame, std::uint64_t tick) {
    std::vector<std::uint8_t> bytes(frame.colors.size() * 3);
    tbb::parallel_for(0, frame.height, [&](int y) {
        const DefaultFloatMode plain;
        for (int x = 0; x < frame.width; ++x) {
            const std::size_t index = frame.index(x, y);
            // Half a step of noise hides the steps of smooth skies.
            const auto grain = static_cast<float>(world::draw(
                0, tick, world::Purpose::camera_noise, static_cast<std::uint64_t>(index)));
            const Color light = film(frame.colors[index].max(0.0F));
            const Color roots = Color(_mm_sqrt_ps(light.lanes())) * (table_size - 1) + 0.5F;
            alignas(16) std::array<std::uint32_t, 4> entries;
            _mm_store_si128(reinterpret_cast<__m128i*>(entries.data()),
                            _mm_cvttps_epi32(roots.lanes()));
            const Color values =
                (Color(srgb.values[entries[0]], srgb.values[entries[1]], srgb.values[entries[2]]) +
                 grain)
                    .min(255.0F);
            alignas(16) std::array<std::uint32_t, 4> whole;
            _mm_store_si128(reinterpret_cast<__m128i*>(whole.data()),
                            _mm_cvttps_epi32(values.lanes()));
            for (std::size_t channel = 0; channel < 3; ++channel)
                bytes[3 * index + channel] = static_cast<std::uint8_t>(whole[channel]);
        }
    });
    return bytes;
}

}  // namespace reprise::render
