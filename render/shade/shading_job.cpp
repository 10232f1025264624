#include "render/shade/shading_job.h"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <tbb/parallel_for.h>

#include "render/trace/default_float_mode.h"

namespace reprise::render {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int strip_width = 8;  // [tiles]

/// Roberts' R2 sequence: evenly spread points of the unit square.
Vector2f spread(int i) {
    const auto n = static_cast<float>(i) + 0.5F;
    return {fraction(n * 0.7548777F), fraction(n * 0.5698403F)};
}

struct Tables {
    Tables() {
        for (int i = 0; i < 32; ++i) {
            const Vector2f at = spread(i);
            const double angle = 2 * std::numbers::pi * static_cast<double>(at.x());
            const Vector2f way(static_cast<float>(std::cos(angle)),
                               static_cast<float>(std::sin(angle)));
            const float wide = std::sqrt(at.y());
            sky[static_cast<std::size_t>(i)] = {
                wide * way.x(), wide * way.y(), std::sqrt(1 - at.y())};
            disc[static_cast<std::size_t>(i)] = wide * way;
        }
    }

    std::array<Vector3f, 32> sky;   // cosine-weighted over the half sphere
    std::array<Vector2f, 32> disc;  // evenly over the unit disc
};

const Tables tables;

}  // namespace

void for_tiles(const Camera& camera,
               const std::function<void(const Eigen::Vector2i& corner)>& work) {
    const int columns = (camera.width() + tile - 1) / tile;
    const int rows = (camera.height() + tile - 1) / tile;
    tbb::parallel_for(0, columns * rows, [&](int index) {
        const DefaultFloatMode plain;
        // Down one strip after the other: what a tile's next stages need of those above it is still
        // in the second cache, where two whole rows are not.
        const int strip = index / (strip_width * rows);
        const int inside = index - strip * strip_width * rows;
        const int wide = std::min(strip_width, columns - strip * strip_width);
        work({(strip * strip_width + inside % wide) * tile, inside / wide * tile});
    });
}

TileStage::TileStage(const Camera& camera)
    : columns_((camera.width() + tile - 1) / tile),
      rows_((camera.height() + tile - 1) / tile),
      waited_for_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    // Of itself and its neighbours along one way, at the picture's edge fewer.
    const auto near = [](int place, int count) {
        return 1 + static_cast<int>(place > 0) + static_cast<int>(place + 1 < count);
    };
    for (int y = 0; y < rows_; ++y)
        for (int x = 0; x < columns_; ++x)
            waited_for_[static_cast<std::size_t>(y * columns_ + x)] =
                near(x, columns_) * near(y, rows_);
}

const Vector2f& disc_point(int place) {
    return tables.disc[static_cast<std::size_t>(place)];
}

const Vector3f& sky_direction(int place) {
    return tables.sky[static_cast<std::size_t>(place)];
}

std::array<Vector3f, 16> sun_directions(const Sky& sky) {
    const OrthonormalBasis axes(sky.to_sun());
    std::array<Vector3f, 16> all;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Vector2f spot = disc_point(static_cast<int>(i)) * sky.sun_radius();
        all[i] = axes.apply({spot.x(), spot.y(), 1});
    }
    return all;
}

Color sky_color(const ShadingJob& job, const Vector3f& direction) {
    return job.input.sky.radiance(direction.normalized(), true);
}

}  // namespace reprise::render
