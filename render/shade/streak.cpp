#include "render/shade/streak.h"

#include <algorithm>
#include <cmath>

namespace reprise::render {

void draw_streak(const Streak& streak,
                 const Color& light,
                 const std::vector<Hit>& hits,
                 Frame& frame) {
    const Eigen::Vector2f from = streak.from.head<2>().cast<float>();
    const Eigen::Vector2f along = (streak.to - streak.from).head<2>().cast<float>();
    const float squared = std::max(along.squaredNorm(), 1e-4F);
    const float reach = streak.half_width + 1;
    // One over the depth is even along a line on the picture.
    const auto near = static_cast<float>(1 / streak.from.z());
    const auto far = static_cast<float>(1 / streak.to.z());
    const int left = std::max(0, floor_int(std::min(from.x(), from.x() + along.x()) - reach));
    const int right =
        std::min(frame.width - 1, floor_int(std::max(from.x(), from.x() + along.x()) + reach));
    const int top = std::max(0, floor_int(std::min(from.y(), from.y() + along.y()) - reach));
    const int bottom =
        std::min(frame.height - 1, floor_int(std::max(from.y(), from.y() + along.y()) + reach));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const std::size_t index = frame.index(x, y);
            const Hit& hit = hits[index];
            const Eigen::Vector2f pixel(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
            const float share = clamp01((pixel - from).dot(along) / squared);
            if (hit.instance != no_instance && hit.distance * (near + share * (far - near)) < 1)
                continue;
            const float away = (pixel - from - share * along).norm();
            const float cover =
                clamp01(streak.half_width + 0.5F - away) * std::min(1.0F, 2 * streak.half_width);
            // Drops fade in and out of the exposure at the ends.
            const float fade = 4 * share * (1 - share) * 0.6F + 0.4F;
            Color& behind = frame.colors[index];
            const Color own = light.max((streak.lit * behind).min(1.0F));
            behind = mix(behind, own, cover * fade * streak.strength);
        }
    }
}

}  // namespace reprise::render
