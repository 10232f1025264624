#include "render/scene/land.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/shapes/noise.h"

namespace reprise::render {

namespace {

// [m] from the town's border: where the land is cut, closer where it begins to rise. Up to the
// horizon of an eye 300 m high in the haze.
constexpr std::array<float, 14> cuts{
    0, 60, 120, 190, 270, 360, 460, 570, 700, 850, 1030, 1260, 1580, 2000};
constexpr float below = 0.35F;   // [m] that the land lies below the town's lowest ground
constexpr float level = 60;      // [m] from the border; from here on it rises
constexpr float hills_at = 900;  // [m] from the border; from here on hills are as high as anywhere
constexpr float highest = 95;    // [m] of a hill; most are half as high

/// Where the land is cut along an axis on which the town lies from `low` to `high`.
std::vector<float> cuts_of(float low, float high) {
    std::vector<float> at;
    for (std::size_t i = cuts.size(); i-- > 0;)
        at.push_back(low - cuts[i]);
    const int inside = std::clamp(static_cast<int>((high - low) / 200), 1, 12);
    for (int i = 1; i < inside; ++i)
        at.push_back(low + (high - low) * static_cast<float>(i) / static_cast<float>(inside));
    for (const float away : cuts)
        at.push_back(high + away);
    return at;
}

/// `away`: [m] from the town's border, 0 inside; x and y of the world.
float height(float away, float x, float y) {
    const float share = fractal_noise(x / 520, y / 520, 3, 31);
    return highest * smooth_step(level, hills_at, away) * smooth_step(0.36F, 0.84F, share);
}

}  // namespace

Mesh land_mesh(const world::TownT& town, const Eigen::Vector3d& origin) {
    const Eigen::Vector3d low = Eigen::Vector3d(town.low.x(), town.low.y(), town.low.z()) - origin;
    const Eigen::Vector3d high =
        Eigen::Vector3d(town.high.x(), town.high.y(), town.high.z()) - origin;
    const Eigen::Vector3f from = low.cast<float>();
    const Eigen::Vector3f to = high.cast<float>();
    const std::vector<float> xs = cuts_of(from.x(), to.x());
    const std::vector<float> ys = cuts_of(from.y(), to.y());
    const auto outside = [](float at, float least, float most) {
        return std::max({0.0F, least - at, at - most});
    };
    Mesh mesh;
    for (const float y : ys) {
        for (const float x : xs) {
            const float dx = outside(x, from.x(), to.x());
            const float dy = outside(y, from.y(), to.y());
            const float rise = height(std::sqrt(dx * dx + dy * dy),
                                      x + static_cast<float>(origin.x()),
                                      y + static_cast<float>(origin.y()));
            add_vertex(mesh, {x, y, from.z() - below + rise});
        }
    }
    // Meadows lie around the town, fields behind them.
    const auto is_far = [&](const std::vector<float>& at, std::size_t i, float least, float most) {
        return outside(0.5F * (at[i] + at[i + 1]), least, most) > level;
    };
    const auto columns = static_cast<std::uint32_t>(xs.size());
    for (std::uint32_t row = 0; row + 1 < ys.size(); ++row) {
        for (std::uint32_t column = 0; column + 1 < columns; ++column) {
            const std::uint32_t corner = row * columns + column;
            const bool far =
                is_far(xs, column, from.x(), to.x()) || is_far(ys, row, from.y(), to.y());
            const Finish grass{Material::grass, far ? land_far_off : 0};
            add_triangle(mesh, corner, corner + 1, corner + columns + 1, grass);
            add_triangle(mesh, corner, corner + columns + 1, corner + columns, grass);
        }
    }
    drop_degenerate(mesh);
    smooth(mesh, 1.2);
    return mesh;
}

}  // namespace reprise::render
