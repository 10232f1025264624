#include "render/scene/lane_raster.h"

#include <algorithm>
#include <array>

#include <emmintrin.h>

#include "render/shapes/fast_math.h"
#include "world/town.h"

namespace reprise::render {

namespace {

constexpr float units = 60;  // of a stored distance, in a metre
constexpr float margin = 2;  // [m] around the town

Eigen::Vector2f flat(const world::Vec3& position, const Eigen::Vector3d& origin) {
    return Eigen::Vector2d(position.x() - origin.x(), position.y() - origin.y()).cast<float>();
}

}  // namespace

LaneRaster::LaneRaster(const world::TownT& town, const Eigen::Vector3d& origin) {
    low_ = flat(town.low, origin) - Eigen::Vector2f::Constant(margin);
    const Eigen::Vector2f size = flat(town.high, origin) + Eigen::Vector2f::Constant(margin) - low_;
    // At most 64 million cells: 64 MB.
    while (size.x() * size.y() / (cell_ * cell_) > 64e6F)
        cell_ *= 2;
    columns_ = std::max(2, static_cast<int>(size.x() / cell_) + 2);
    rows_ = std::max(2, static_cast<int>(size.y() / cell_) + 2);
    distances_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 240);
    for (const world::LaneT& lane : town.lanes) {
        if (!world::is_for_cars(lane))
            continue;
        for (std::size_t i = 0; i + 1 < lane.centre.size(); ++i)
            stamp(flat(lane.centre[i], origin),
                  flat(lane.centre[i + 1], origin),
                  static_cast<float>(lane.width) * 0.5F);
    }
}

void LaneRaster::stamp(const Eigen::Vector2f& from, const Eigen::Vector2f& to, float half_width) {
    const float reach = half_width + 2 * cell_;
    const Eigen::Vector2f least = (from.cwiseMin(to) - low_).array() - reach;
    const Eigen::Vector2f most = (from.cwiseMax(to) - low_).array() + reach;
    const int first_row = std::max(0, floor_int(least.y() / cell_));
    const int last_row = std::min(rows_ - 1, floor_int(most.y() / cell_) + 1);
    const int first_column = std::max(0, floor_int(least.x() / cell_));
    const int last_column = std::min(columns_ - 1, floor_int(most.x() / cell_) + 1);
    const Eigen::Vector2f along = to - from;
    const float squared = std::max(along.squaredNorm(), 1e-6F);
    const __m128 ax = _mm_set1_ps(along.x());
    const __m128 ay = _mm_set1_ps(along.y());
    for (int row = first_row; row <= last_row; ++row) {
        const __m128 y =
            _mm_set1_ps(low_.y() + cell_ * static_cast<float>(row)) - _mm_set1_ps(from.y());
        // Four cells at once: most of a slanting lane's box is far from it.
        for (int column = first_column; column <= last_column; column += 4) {
            const __m128 columns =
                _mm_cvtepi32_ps(_mm_add_epi32(_mm_set1_epi32(column), _mm_setr_epi32(0, 1, 2, 3)));
            const __m128 x =
                _mm_set1_ps(low_.x()) + _mm_set1_ps(cell_) * columns - _mm_set1_ps(from.x());
            const __m128 share =
                _mm_min_ps(_mm_max_ps((x * ax + y * ay) / _mm_set1_ps(squared), _mm_setzero_ps()),
                           _mm_set1_ps(1));
            const __m128 aside = x - share * ax;
            const __m128 ahead = y - share * ay;
            const __m128 distance = _mm_sqrt_ps(aside * aside + ahead * ahead);
            const int near = _mm_movemask_ps(_mm_cmple_ps(distance, _mm_set1_ps(reach)));
            if (near == 0)
                continue;
            alignas(16) std::array<std::int32_t, 4> values;
            _mm_store_si128(
                reinterpret_cast<__m128i*>(values.data()),
                _mm_cvttps_epi32(_mm_min_ps(distance * _mm_set1_ps(units), _mm_set1_ps(239))));
            for (int i = 0; i < std::min(4, last_column - column + 1); ++i) {
                std::uint8_t& stored =
                    distances_[static_cast<std::size_t>(row * columns_ + column + i)];
                if ((near >> i & 1) != 0)
                    stored = std::min(
                        stored, static_cast<std::uint8_t>(values[static_cast<std::size_t>(i)]));
            }
        }
    }
}

float LaneRaster::distance(float x, float y) const {
    const float fx = (x - low_.x()) / cell_;
    const float fy = (y - low_.y()) / cell_;
    if (!(fx >= 0 && fy >= 0))
        return 4;
    const int column = floor_int(fx);
    const int row = floor_int(fy);
    if (column + 1 >= columns_ || row + 1 >= rows_)
        return 4;
    const auto at = [&](int i, int j) {
        return static_cast<float>(distances_[static_cast<std::size_t>(j * columns_ + i)]);
    };
    const float share_x = fx - static_cast<float>(column);
    const float share_y = fy - static_cast<float>(row);
    return mix(mix(at(column, row), at(column + 1, row), share_x),
               mix(at(column, row + 1), at(column + 1, row + 1), share_x),
               share_y) /
           units;
}

}  // namespace reprise::render
