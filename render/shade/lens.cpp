#include <algorithm>
#include <cmath>

#include "render/shade/frame.h"
#include "world/hash.h"

namespace reprise::render {

namespace {

constexpr int small_shrink = 8;          // the picture that drops show is so much smaller
constexpr float most_drops = 46;         // at once, in a cloudburst that has no end
constexpr std::uint32_t drop_life = 70;  // [ticks] until a drop has run off or has been wiped
constexpr float largest_drop = 0.016F;   // radius of a drop, as a share of the picture's width
constexpr float drop_bend = 9;           // a drop shows so much wider a view than it hides

/// The picture, small and smooth: what is seen through water this near is far out of focus.
struct SmallPicture {
    explicit SmallPicture(const Frame& frame)
        : width((frame.width + small_shrink - 1) / small_shrink),
          height((frame.height + small_shrink - 1) / small_shrink),
          colors(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                 Color::Zero()) {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                Color sum = Color::Zero();
                float count = 0;
                for (int i = 0; i < small_shrink * small_shrink; i += 3) {
                    const int column = x * small_shrink + i % small_shrink;
                    const int row = y * small_shrink + i / small_shrink;
                    if (column >= frame.width || row >= frame.height)
                        continue;
                    sum += frame.colors[frame.index(column, row)];
                    count += 1;
                }
                colors[static_cast<std::size_t>(y * width + x)] = sum / count;
            }
    }

    /// At a place in pixels of the whole picture; beyond its border as at the border.
    Color at(float x, float y) const {
        const float u =
            std::min(std::max(x / small_shrink - 0.5F, 0.0F), static_cast<float>(width - 1));
        const float v =
            std::min(std::max(y / small_shrink - 0.5F, 0.0F), static_cast<float>(height - 1));
        const int column = std::min(static_cast<int>(u), std::max(width - 2, 0));
        const int row = std::min(static_cast<int>(v), std::max(height - 2, 0));
        const int right = std::min(column + 1, width - 1);
        const int below = std::min(row + 1, height - 1);
        const float fx = u - static_cast<float>(column);
        const float fy = v - static_cast<float>(row);
        return mix(mix(color(column, row), color(right, row), fx),
                   mix(color(column, below), color(right, below), fx),
                   fy);
    }

    Color color(int column, int row) const {
        return colors[static_cast<std::size_t>(row * width + column)];
    }

    int width;
    int height;
    std::vector<Color> colors;
};

struct Drop {
    Eigen::Vector2f centre;  // [px]
    float radius;            // [px]
    float strength;
};

void draw_drop(const Drop& drop, const SmallPicture& behind, Frame& frame) {
    const int left = std::max(0, floor_int(drop.centre.x() - drop.radius));
    const int right = std::min(frame.width - 1, floor_int(drop.centre.x() + drop.radius));
    const int top = std::max(0, floor_int(drop.centre.y() - drop.radius));
    const int bottom = std::min(frame.height - 1, floor_int(drop.centre.y() + drop.radius));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const Eigen::Vector2f off =
                Eigen::Vector2f(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F) -
                drop.centre;
            const float share = off.squaredNorm() / (drop.radius * drop.radius);
            if (share >= 1)
                continue;
            // Upside down and wide, as through a ball; the rim, too steep to look through, is dark.
            const Eigen::Vector2f seen = drop.centre - drop_bend * off;
            const Color light = behind.at(seen.x(), seen.y()) * (1 - 0.35F * share * share);
            Color& color = frame.colors[frame.index(x, y)];
            color = mix(color, light, drop.strength * smooth_step(1, 0.45F, share));
        }
    }
}

}  // namespace

void wet_lens(const ShadingInput& input, Frame& frame) {
    const float rain = input.sky.weather().rain();
    if (rain <= 0)
        return;
    const float number = most_drops * rain / (rain + 12);
    const SmallPicture behind(frame);
    for (std::uint32_t slot = 0; static_cast<float>(slot) < number; ++slot) {
        // Each place has drops one after another; which one it is depends on the tick alone.
        const auto tick = static_cast<std::uint32_t>(input.tick & 0xffffffffU);
        const std::uint32_t now = tick + world::hash(slot * 7 + 1) % drop_life;
        const std::uint32_t turn = world::hash(slot) ^ world::hash(now / drop_life + 0x3c6ef372U);
        const auto draw = [&](std::uint32_t k) { return world::unit(world::hash(turn + k)); };
        const float age = static_cast<float>(now % drop_life) / drop_life;
        const float size = 0.25F + 0.75F * draw(2) * draw(2);
        // It spreads as it lands, hangs, and at last runs down and thins.
        const float gone = smooth_step(0.75F, 1.0F, age);
        const Eigen::Vector2f centre(
            draw(0) * static_cast<float>(frame.width),
            (draw(1) + 0.10F * gone * gone * size) * static_cast<float>(frame.height));
        const float fresh = smooth_step(0, 0.03F, age + 0.01F);
        draw_drop({centre,
                   largest_drop * size * (0.8F + 0.2F * fresh) * static_cast<float>(frame.width),
                   0.85F * std::min(1.0F, number - static_cast<float>(slot)) * fresh * (1 - gone)},
                  behind,
                  frame);
    }
}

}  // namespace reprise::render
