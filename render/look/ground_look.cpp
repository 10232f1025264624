#include <array>

#include "render/look/look.h"
#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

using Eigen::Vector3f;

/// How deep a crack is, [0, 1]: cracks are borders between plates a metre and a half wide, of which
/// the share `cracked` has broken apart. They wander, meet in threes, and never curl.
float crack(float x, float y, float cracked) {
    constexpr float plates = 0.65F;  // [1/m]
    constexpr float askew = 0.7F;    // of a plate, how far its middle is out of the lattice
    const float u = plates * x + 0.13F * value_noise(x * 2.1F, y * 2.1F, 20) +
                    0.035F * value_noise(x * 9, y * 9, 21);
    const float v = plates * y + 0.13F * value_noise(x * 2.1F, y * 2.1F, 22) +
                    0.035F * value_noise(x * 9, y * 9, 23);
    const int column = floor_int(u);
    const int row = floor_int(v);
    const std::uint64_t square = lattice_place(column, row);
    alignas(16) std::array<float, 4> aside;
    alignas(16) std::array<float, 4> ahead;
    _mm_store_ps(aside.data(), noise_corners(square, 24));
    _mm_store_ps(ahead.data(), noise_corners(square, 25));
    // The two nearest middles of plates, and whom they belong to.
    std::array<float, 2> nearest{9, 9};
    std::array<float, 2> plate{};
    for (std::size_t i = 0; i < 4; ++i) {
        const float dx = static_cast<float>(i % 2) + askew * (aside[i] - 0.5F) -
                         (u - static_cast<float>(column));
        const std::size_t above = i / 2;
        const float dy =
            static_cast<float>(above) + askew * (ahead[i] - 0.5F) - (v - static_cast<float>(row));
        const float distance = dx * dx + dy * dy;
        const float own = aside[i] + ahead[i];
        if (distance < nearest[0]) {
            nearest = {distance, nearest[0]};
            plate = {own, plate[0]};
        } else if (distance < nearest[1]) {
            nearest[1] = distance;
            plate[1] = own;
        }
    }
    if (fraction(37 * (plate[0] + plate[1])) > cracked)
        return 0;
    return smooth_step(0.015F, 0.004F, std::sqrt(nearest[1]) - std::sqrt(nearest[0]));
}

/// Small, repaired and cracked places: all from noise that is fixed to the world.
Look asphalt(const Surface& at, float lane_distance) {
    const float x = at.position.x();
    const float y = at.position.y();
    float tone = 0.082F;
    tone *= 0.80F + 0.40F * fractal_noise(x * 0.22F, y * 0.22F, 3, 1);
    const float coarse = detail(at, 0.5F);
    const float middle = detail(at, 0.16F);
    if (middle > 0) {
        const auto [wide, narrow] = two_fractal_noises(x, y, 2.3F, 9, 5);
        tone *= 1 + coarse * 0.28F * (wide - 0.5F);
        tone *= 1 + middle * 0.34F * (narrow - 0.5F);
    } else if (coarse > 0) {
        tone *= 1 + coarse * 0.28F * (fractal_noise(x * 2.3F, y * 2.3F, 2, 5) - 0.5F);
    }
    const float fine = detail(at, 0.035F);
    if (fine > 0) {
        // Stones in the binder.
        const float stone =
            value_noise(x * 62, y * 62, 9) * 0.6F + value_noise(x * 130, y * 130, 10) * 0.4F;
        tone *= 1 + fine * 0.7F * (stone - 0.5F);
        tone += fine * 0.045F * smooth_step(0.80F, 0.92F, stone);
    }
    // Tyres polish two tracks, oil drips between them, dust lies at the side.
    const float track = smooth_step(0.5F, 0.1F, std::abs(lane_distance - 0.78F));
    const float oil = smooth_step(0.45F, 0.1F, lane_distance);
    if (track > 0 || oil > 0) {
        const float wear = 0.5F + fractal_noise(x * 0.11F, y * 0.11F, 2, 12);
        tone *= 1 - 0.17F * track * wear - 0.14F * oil * wear;
    }
    tone *= 1 + 0.16F * smooth_step(1.2F, 1.75F, lane_distance);
    // Cracks are in some places only.
    const float crack_detail = detail(at, 0.06F);
    const float place = crack_detail > 0
                            ? smooth_step(0.58F, 0.70F, fractal_noise(x * 0.13F, y * 0.13F, 2, 30))
                            : 0.0F;
    if (place > 0)
        tone *= 1 - 0.6F * crack_detail * crack(x, y, place);
    Look look;
    look.albedo = Color(tone * 1.03F, tone, tone * 0.96F);
    look.roughness = 0.75F - 0.15F * track;
    return look;
}

Look paint(const Surface& at, float lane_distance) {
    Look look = asphalt(at, lane_distance);
    const float x = at.position.x();
    const float y = at.position.y();
    const float wear =
        fractal_noise(x * 1.7F, y * 1.7F, 3, 60) + 0.25F * fractal_noise(x * 0.2F, y * 0.2F, 2, 61);
    const float near = detail(at, 0.05F);
    const float fine = near > 0 ? value_noise(x * 45, y * 45, 62) * near : 0.0F;
    const float left = smooth_step(0.86F, 0.66F, wear + 0.18F * fine);
    look.albedo =
        mix(look.albedo, Color(.60F, .595F, .57F) * (0.86F + 0.14F * fine), 0.12F + 0.82F * left);
    look.roughness = 0.6F;
    return look;
}

Look pavement(const Surface& at) {
    const float x = at.position.x();
    const float y = at.position.y();
    constexpr float slab = 0.5F;
    const int column = floor_int(x / slab);
    const int row = floor_int(y / slab);
    const float fx = fraction(x / slab);
    const float fy = fraction(y / slab);
    const float edge = std::min(std::min(fx, 1 - fx), std::min(fy, 1 - fy)) * slab;
    const float slabs = detail(at, 0.5F);
    const float joints = detail(at, 0.06F);
    float tone = 0.285F + 0.07F * slabs * (cell_noise(column, row, 3) - 0.5F);
    tone *= 0.86F + 0.28F * fractal_noise(x * 0.35F, y * 0.35F, 3, 70);
    const float fine = detail(at, 0.04F);
    if (fine > 0)
        tone *= 1 + 0.22F * fine * (value_noise(x * 70, y * 70, 71) - 0.5F);
    tone *= 1 - 0.5F * joints * smooth_step(0.010F, 0.004F, edge) - 0.02F * slabs * (1 - joints);
    Look look;
    look.albedo = Color(tone * 1.03F, tone, tone * 0.94F);
    return look;
}

Look kerb(const Surface& at) {
    const float along =
        at.position.x() * std::abs(at.flat.y()) + at.position.y() * std::abs(at.flat.x());
    const float joint = std::min(fraction(along), 1 - fraction(along));
    Look look;
    const float tone = 0.36F * (0.85F + 0.3F * value_noise(along * 3, at.position.z() * 9, 80)) *
                       (1 - 0.45F * detail(at, 0.05F) * smooth_step(0.012F, 0.005F, joint));
    look.albedo = Color(tone, tone * 0.99F, tone * 0.95F);
    return look;
}

/// A field beyond the town, or the wood that stands there, seen from far.
Color field(const Surface& at) {
    const float x = at.position.x();
    const float y = at.position.y();
    // Bent borders: what was a grid looks parcelled out.
    const float bend = value_noise(x * 0.006F, y * 0.006F, 96);
    const float u = (x + 0.35F * y) * 0.0072F + 0.9F * bend;
    const float v = (y - 0.30F * x) * 0.0110F - 0.9F * bend;
    const int column = floor_int(u);
    const int row = floor_int(v);
    static const std::array<Color, 6> crops{Color(.085F, .118F, .034F),
                                            Color(.062F, .100F, .030F),
                                            Color(.120F, .130F, .046F),
                                            Color(.205F, .168F, .078F),
                                            Color(.098F, .112F, .048F),
                                            Color(.135F, .102F, .066F)};
    const float lot = cell_noise(column, row, 97);
    const Color crop = crops[static_cast<std::size_t>(lot * 5.999F)];
    const float fu = fraction(u);
    const float fv = fraction(v);
    // A hedge of some 5 m along two sides, with gaps.
    const float aside = std::min(std::min(fu, 1 - fu) * 130, std::min(fv, 1 - fv) * 86);
    const float hedge = smooth_step(4.5F, 2, aside) * detail(at, 16) *
                        smooth_step(0.35F, 0.5F, value_noise(x * 0.03F, y * 0.03F, 98));
    const float woods = smooth_step(0.56F, 0.60F, fractal_noise(x * 0.0035F, y * 0.0035F, 3, 99));
    const float crowns = 1 + 0.8F * detail(at, 16) * (value_noise(x * 0.11F, y * 0.11F, 94) - 0.5F);
    return mix(crop, Color(.036F, .058F, .022F) * crowns, std::max(hedge, woods));
}

Look grass(const Surface& at) {
    const float x = at.position.x();
    const float y = at.position.y();
    const float wide = fractal_noise(x * 0.045F, y * 0.045F, 3, 90);
    const float patch = fractal_noise(x * 0.6F, y * 0.6F, 3, 91);
    Color color = mix(Color(.058F, .094F, .026F),
                      Color(.138F, .134F, .054F),
                      smooth_step(.25F, .8F, 0.6F * wide + 0.4F * patch));
    const float blades = detail(at, 0.12F);
    float tone = 0.55F + 0.9F * patch;
    Look look;
    look.normal = at.normal;
    if (blades > 0) {
        const float blade =
            value_noise(x * 26, y * 26, 92) * 0.55F + value_noise(x * 61, y * 61, 93) * 0.45F;
        tone *= 1 + blades * 1.25F * (blade - 0.5F);
    }
    const float earth = smooth_step(0.63F, 0.74F, fractal_noise(x * 0.3F, y * 0.3F, 3, 95));
    color = mix(color, Color(.17F, .13F, .085F), 0.7F * earth);
    look.albedo = color * tone;
    look.translucency = 0.12F;
    return look;
}

/// Rings around the places where drops fell on water; tilts the normal. The more it rains, the more
/// places are hit.
Vector3f ripples(const Surface& at, std::uint64_t tick, float rain) {
    constexpr float cell = 0.10F;    // [m]
    constexpr float widest = 0.07F;  // [m] a drop of 2 to 4 mm makes no wider ring that is seen
    constexpr float crest = 0.010F;  // [m]
    const float share = rain / (rain + 6);
    const int column = floor_int(at.position.x() / cell);
    const int row = floor_int(at.position.y() / cell);
    Vector3f tilt = Vector3f::Zero();
    // A ring lives for 8 ticks; each cell starts its own at its own time and place.
    constexpr std::uint32_t life = 8;
    for (int i = 0; i < 9; ++i) {
        const int cx = column + i % 3 - 1;
        const int cy = row + i / 3 - 1;
        const auto start = static_cast<std::uint32_t>(cell_noise(cx, cy, 101) * life);
        const auto now = static_cast<std::uint32_t>(tick & 0xffffffffu) + start;
        const std::uint32_t turn = now / life;
        const float strength = smooth_step(0, 0.1F, share - 0.9F * cell_noise(cx, cy, 400 + turn));
        if (strength <= 0)
            continue;
        const float age = static_cast<float>(now % life) / life;
        const float px = (static_cast<float>(cx) + cell_noise(cx, cy, 200 + turn)) * cell;
        const float py = (static_cast<float>(cy) + cell_noise(cx, cy, 300 + turn)) * cell;
        const float dx = at.position.x() - px;
        const float dy = at.position.y() - py;
        const float distance = std::sqrt(dx * dx + dy * dy) + 1e-4F;
        const float ring = (distance - widest * age) / crest;
        if (std::abs(ring) < 2) {
            const float height =
                (ring < 0 ? ring + 1 : 1 - ring) * (1 - 0.25F * ring * ring) * (1 - age);
            tilt += Vector3f(dx, dy, 0) * (0.22F * strength * height / distance);
        }
    }
    return tilt;
}

/// How much of a place is under water: where a noise that is fixed to the world is low, first in
/// gutters and ruts. `filled` is Weather.puddles: 0 leaves none, 1 half of the road.
float puddle_at(const Surface& at, float lane_distance, float filled) {
    if (at.material == Material::kerb || at.material == Material::deck)
        return 0;
    const float x = at.position.x();
    const float y = at.position.y();
    const float gutter = 0.10F * smooth_step(1.1F, 1.8F, lane_distance);
    const float rut = 0.06F * smooth_step(0.45F, 0.1F, std::abs(lane_distance - 0.78F));
    const float low = fractal_noise(x * 0.28F, y * 0.28F, 3, 110) + gutter + rut -
                      (at.material == Material::pavement ? 0.07F : 0.0F);
    const float level = 0.46F + 0.74F * (1 - filled) * (1 - filled);
    return smooth_step(level, level + 0.07F, low);
}

/// Water darkens, fills pores, and stands in puddles.
void soak(Look& look, const ShadingInput& input, const Surface& at, float lane_distance) {
    const world::Weather& weather = input.sky.weather();
    const float wetness = at.wetness;
    if (at.flat.z() < 0.7F || at.material == Material::grass) {
        look.albedo = soaked(look.albedo, 0.8F * wetness);
        return;
    }
    look.albedo = soaked(look.albedo, wetness);
    const float x = at.position.x();
    const float y = at.position.y();
    const float water =
        weather.puddles() > 0 ? puddle_at(at, lane_distance, weather.puddles()) * wetness : 0.0F;
    look.f0 = mix(0.04F, 0.022F, wetness);
    look.roughness = mix(mix(look.roughness, 0.30F, wetness), 0.03F, water);
    look.gloss = wetness * mix(0.62F, 1.0F, water);
    look.albedo *= 1 - 0.35F * water;
    // The film follows the stones; standing water is level, but for rings.
    const float rough = (1 - water) * detail(at, 0.4F) * wetness;
    Vector3f tilt((value_noise(x * 19, y * 19, 120) - 0.5F +
                   0.6F * (value_noise(x * 47, y * 47, 122) - 0.5F)) *
                      0.06F * rough,
                  (value_noise(x * 19, y * 19, 121) - 0.5F +
                   0.6F * (value_noise(x * 47, y * 47, 123) - 0.5F)) *
                      0.06F * rough,
                  0);
    const float near = detail(at, 0.09F) * wetness;
    // Rings run on water that stands; in a film they hardly rise.
    if (weather.rain() > 0 && near > 0)
        tilt += ripples(at, input.tick, weather.rain()) * (near * (0.08F + 0.92F * water));
    look.normal = (look.normal + tilt).normalized();
}

}  // namespace

namespace {

Look far_field(const Surface& at) {
    Look look;
    look.albedo = field(at);
    return look;
}

Look dry_ground(const Surface& at, float lane_distance) {
    switch (at.material) {
        case Material::asphalt:
            return asphalt(at, lane_distance);
        case Material::marking:
            return paint(at, lane_distance);
        case Material::pavement:
            return pavement(at);
        case Material::kerb:
        case Material::deck:
            return kerb(at);
        default:
            return at.tag == land_far_off ? far_field(at) : grass(at);
    }
}

}  // namespace

Look ground_look(const ShadingInput& input, const Surface& at) {
    const bool road = at.material == Material::asphalt || at.material == Material::marking;
    const float lane_distance =
        road ? input.scene.lanes().distance(at.position.x(), at.position.y()) : 4;
    Look look = dry_ground(at, lane_distance);
    look.normal = at.normal;
    if (at.wetness > 0)
        soak(look, input, at, lane_distance);
    return look;
}

}  // namespace reprise::render
